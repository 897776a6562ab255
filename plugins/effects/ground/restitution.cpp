/// What hits the floor bounces back (Newton's law of impact): v' = −e·v along the normal, with
///   e = e0 + (1 − e0)·r      e0: what the scene gives for the pair (of floor and ball the larger), r: the parameter
/// so that it can only add and stays within 1. For balls and for every part of a robot. Neutral: r = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class Restitution final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"share", "", "share of the speed that the scene loses in a hit and that comes back", 0, 1, 0.3, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::contact, "a floor that throws back more of what hits it", "e = e_0 + (1 − e_0)·r",
            "r: share; e_0: of the scene", "Newton"};
  }
  Place place() const override { return Place::floor; }

  void changeScene(btr::Scene& scene, const std::string& at, std::span<const double> values) const override {
    if (!scene.floor) throw btr::InputError("restitution: the scene has no \"" + at + "\"");
    double& bounce = scene.floor->bounce;
    bounce += (1 - bounce) * values[0];
  }
};

}  // namespace

BTR_EFFECT(Restitution, "restitution")
