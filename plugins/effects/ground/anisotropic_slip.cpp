/// What pushes along the floor creeps, but only along one direction u (a carpet's pile, a grooved board):
///   v = s·u·uᵀ·F      s in m/(s·N), u: the floor's x turned by α about z; added to what the scene has
/// The engine's force-dependent slip (Smith, Open Dynamics Engine User Guide: slip1) along one direction. With the
/// effect slip beside it, any two speeds of creep along any two crossed axes. Neutral: s = 0; α then says nothing.
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class AnisotropicSlip final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"slip_m_s_n", "m/(s·N)", "speed of creep per force along the direction", 0, 10, 0.03, 0.0},
            {"direction_rad", "rad", "turn of the direction about z from x", -1.5708, 1.5708, 0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::contact, "creep along one direction of the floor, in proportion to the force",
            "v = s·u·(u·F)", "s: slip_m_s_n; u: the floor’s x turned by direction_rad",
            "Smith, Open Dynamics Engine User Guide"};
  }
  Place place() const override { return Place::floor; }
  std::vector<std::string> contains() const override { return {"slip"}; }
  bool dissipative() const override { return true; }

  void changeScene(btr::Scene& scene, const std::string& at, std::span<const double> values) const override {
    if (!scene.floor) throw btr::InputError("anisotropic_slip: the scene has no \"" + at + "\"");
    const double c = std::cos(values[1]), s = std::sin(values[1]);
    scene.floor->slip1_m_s_n += values[0] * c * c;
    scene.floor->slip2_m_s_n += values[0] * s * s;
    scene.floor->slipXY_m_s_n += values[0] * c * s;
  }
};

}  // namespace

BTR_EFFECT(AnisotropicSlip, "anisotropic_slip")
