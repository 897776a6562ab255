/// What pushes along the floor creeps: sliding speed per tangential force, the same in every direction, below the limit
/// of dry friction:
///   v = s·F      s in m/(s·N), added to what the scene has
/// The engine's force-dependent slip (Smith, Open Dynamics Engine User Guide: slip1, slip2). Rubber feet on a carpet,
/// tyres. Neutral: s = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class Slip final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"slip_m_s_n", "m/(s·N)", "speed of creep per tangential force", 0, 10, 0.02, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::contact, "creep of what pushes along the floor, in proportion to the force",
            "v = s·F", "s: slip_m_s_n", "Smith, Open Dynamics Engine User Guide"};
  }
  Place place() const override { return Place::floor; }
  bool dissipative() const override { return true; }

  void changeScene(btr::Scene& scene, const std::string& at, std::span<const double> values) const override {
    if (!scene.floor) throw btr::InputError("slip: the scene has no \"" + at + "\"");
    scene.floor->slip1_m_s_n += values[0];
    scene.floor->slip2_m_s_n += values[0];
  }
};

}  // namespace

BTR_EFFECT(Slip, "slip")
