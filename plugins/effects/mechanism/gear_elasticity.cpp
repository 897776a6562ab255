/// The gear between rotor and joint gives way: a spring of compliance c and a damper d carry the drive's torque to the
/// joint, and the rotor moves on its own.
///   J·θ̈ = τ − s,   s = (θ − q)/c + d·(θ̇ − q̇)      s: torque at the joint; J: the rotor's inertia seen at the joint
/// J is the parameter and what the scene's drive already has. A DC motor's back electromotive force follows the rotor.
/// (Spong 1987, Modeling and control of elastic joint robots.) `sensors` says what the servo's loop follows and what is
/// recorded: 0 the joint, the joint (as an AIBO's potentiometers do), 1 the motor, the joint, 2 the joint, the motor,
/// 3 the motor, the motor. Solved inside the step, stable for any c. With c = 0 the rotor is rigidly geared: the effect
/// rotor_inertia. Without a rotor's inertia the torque passes unchanged. Neutral: c = J = 0; d then says nothing.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class GearElasticity final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"compliance_rad_nm", "rad/(N·m)", "turn per torque, m/N on a slide joint", 0, 2, 0.05, 0.0},
            {"rotor_inertia_kg_m2", "kg·m²", "inertia of the rotor seen at the joint, kg on a slide joint", 0, 200,
             1e-3, 0.0},
            {"damping_nm_s_rad", "N·m·s/rad", "torque per speed of the spring, N·s/m on a slide joint", 0, 2000, 0.05},
            btr::sensorsParameter()};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::gear, "a gear that gives way, with the rotor’s inertia behind it",
            "J·θ̈ = τ − s,  s = (θ − q)/c + d·(θ̇ − q̇)",
            "c: compliance_rad_nm; J: rotor_inertia_kg_m2; d: damping_nm_s_rad; q: joint, θ: rotor", "Spong 1987"};
  }
  Place place() const override { return Place::joint; }
  std::vector<std::string> contains() const override { return {"rotor_inertia"}; }

  void changeScene(btr::Scene& scene, const std::string& at, std::span<const double> values) const override {
    btr::Drive& drive = btr::driveAt(scene, at, "gear_elasticity");
    drive.gearCompliance += values[0];
    drive.rotorInertia_kg_m2 += values[1];
    if (values[0] == 0) return;
    drive.gearDamping += values[2];
    btr::placeSensors(drive, values[3]);
  }
};

}  // namespace

BTR_EFFECT(GearElasticity, "gear_elasticity")
