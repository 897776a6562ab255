/// The motor's rotor turns with the joint, n times as fast: as inertia at the joint J = n²·J_rotor, added to what the
/// scene's drive already has.
///   kinetic energy ½·J·ω²      J in kg·m² (kg on a slide joint)
/// (Spong, Hutchinson and Vidyasagar 2006, Robot Modeling and Control: the actuator's inertia times the gear ratio
/// squared.) Shows up as slower accelerations that gravity does not know of. Neutral: J = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class RotorInertia final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {
        {"inertia_kg_m2", "kg·m²", "inertia of the rotor seen at the joint, kg on a slide joint", 0, 200, 1e-3, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::gear, "inertia of the motor’s rotor, seen at the joint", "E = ½·J·ω^2",
            "J: inertia_kg_m2; ω: joint speed", "Spong, Hutchinson and Vidyasagar 2006"};
  }
  Place place() const override { return Place::joint; }

  void changeScene(btr::Scene& scene, const std::string& at, std::span<const double> values) const override {
    for (btr::SceneRobot& robot : scene.robots)
      for (std::size_t j = 0; j < robot.model.joints.size(); ++j)
        if (at == robot.name + "." + robot.model.joints[j].name) {
          robot.drives[j].rotorInertia_kg_m2 += values[0];
          return;
        }
    throw btr::InputError("rotor_inertia: the scene has no joint \"" + at + "\"; write ROBOT.JOINT");
  }
};

}  // namespace

BTR_EFFECT(RotorInertia, "rotor_inertia")
