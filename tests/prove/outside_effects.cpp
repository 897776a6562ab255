#include "tests/prove/outside_effects.h"

#include <cmath>
#include <map>

#include "core/sim/effect.h"

namespace btr::prove {
namespace {

// Those that are nearly a law of the library in some recordings (grease that hardly warms up, a cable that is always
// taut) name it in contains(): where it does as well, nothing from outside has to be there.

/// A worn place of a bearing: |τ| ≤ T·exp(−((q − q0)/w)²).
class FrictionBand final : public Effect {
  std::vector<Parameter> parameters() const override {
    return {{"torque_nm", "N·m", "dry friction in the middle of the band", 0, 1, 0.05, 0.0},
            {"middle_rad", "rad", "where it is", -1, 1, 0.1},
            {"width_rad", "rad", "how far it reaches", 0.05, 0.5, 0.12}};
  }
  std::vector<std::string> contains() const override { return {"coulomb_friction"}; }
  Place place() const override { return Place::joint; }
  bool dissipative() const override { return true; }
  double frictionLimit(const JointState& joint, std::span<const double> v) const override {
    return v[0] * std::exp(-std::pow((joint.position - v[1]) / v[2], 2));
  }
};

/// τ = −k·(q − q0)³.
class CubicSpring final : public Effect {
  std::vector<Parameter> parameters() const override {
    return {{"stiffness_nm_rad3", "N·m/rad³", "torque per cubed turn", 0, 20, 0.5, 0.0},
            {"rest_rad", "rad", "position without torque", -0.5, 0.5, 0}};
  }
  std::vector<std::string> contains() const override { return {"joint_spring"}; }
  Place place() const override { return Place::joint; }
  double torque(const JointState& joint, std::span<const double> v) const override {
    return v[0] == 0 ? 0 : -v[0] * std::pow(joint.position - v[1], 3);
  }
};

/// A machine next door: τ = A·sin(2π·f·t).
class PeriodicTorque final : public Effect {
  std::vector<Parameter> parameters() const override {
    return {{"torque_nm", "N·m", "amplitude", 0, 1, 0.03, 0.0},
            {"frequency_hz", "Hz", "of the disturbance", 0.5, 8, 2}};
  }
  Place place() const override { return Place::joint; }
  double torque(const JointState& joint, std::span<const double> v) const override {
    return v[0] == 0 ? 0 : v[0] * std::sin(2 * M_PI * v[1] * joint.time);
  }
};

/// Cold grease: |τ| ≤ T·exp(−t/t0).
class WarmingFriction final : public Effect {
  std::vector<Parameter> parameters() const override {
    return {{"torque_nm", "N·m", "dry friction when cold", 0, 1, 0.05, 0.0},
            {"time_s", "s", "in which it fades", 0.5, 4, 1.8}};
  }
  std::vector<std::string> contains() const override { return {"coulomb_friction"}; }
  Place place() const override { return Place::joint; }
  bool dissipative() const override { return true; }
  double frictionLimit(const JointState& joint, std::span<const double> v) const override {
    return v[0] * std::exp(-joint.time / v[1]);
  }
};

/// A cable that is slack on one side: τ = −k·max(0, q − q0).
class LooseCable final : public Effect {
  std::vector<Parameter> parameters() const override {
    return {{"stiffness_nm_rad", "N·m/rad", "torque per turn when taut", 0, 10, 0.3, 0.0},
            {"taut_rad", "rad", "from here on", -0.5, 0.8, 0.1}};
  }
  std::vector<std::string> contains() const override { return {"joint_spring"}; }
  Place place() const override { return Place::joint; }
  double torque(const JointState& joint, std::span<const double> v) const override {
    return v[0] == 0 ? 0 : -v[0] * std::max(0.0, joint.position - v[1]);
  }
};

/// A seam of the carpet along y: it takes speed away where the ball crosses it.
class CarpetSeam final : public Effect {
  std::vector<Parameter> parameters() const override {
    return {{"deceleration_m_s2", "m/s²", "in the middle of the seam", 0, 5, 0.6, 0.0},
            {"x_m", "m", "where it lies", -0.5, 0.5, 0},
            {"width_m", "m", "how wide it is", 0.02, 0.3, 0.08}};
  }
  Place place() const override { return Place::ball; }
  bool dissipative() const override { return true; }
  Eigen::Vector3d ballForce(const BallState& ball, std::span<const double> v) const override {
    const double speed = ball.velocity_m_s.norm();
    if (v[0] == 0 || !ball.onFloor || speed < 1e-9) return Eigen::Vector3d::Zero();
    const double share = std::exp(-std::pow((ball.position_m.x() - v[1]) / v[2], 2));
    return -v[0] * ball.mass_kg * share / speed * ball.velocity_m_s;
  }
};

/// A fan at the side whose stream widens: the acceleration along y grows with x.
class SideForce final : public Effect {
  std::vector<Parameter> parameters() const override {
    return {{"gradient_s2", "1/s²", "acceleration along y per x", -5, 5, 0, 0.0}};
  }
  Place place() const override { return Place::ball; }
  Eigen::Vector3d ballForce(const BallState& ball, std::span<const double> v) const override {
    return {0, v[0] * ball.mass_kg * ball.position_m.x(), 0};
  }
};

template <class Kind>
std::shared_ptr<const Effect> make() {
  return std::make_shared<const Kind>();
}

using Makers = std::map<std::string, std::shared_ptr<const Effect> (*)()>;
const Makers& makers() {
  static const Makers all{{"outside_friction_band", make<FrictionBand>},
                          {"outside_cubic_spring", make<CubicSpring>},
                          {"outside_periodic_torque", make<PeriodicTorque>},
                          {"outside_warming_friction", make<WarmingFriction>},
                          {"outside_loose_cable", make<LooseCable>},
                          {"outside_carpet_seam", make<CarpetSeam>},
                          {"outside_side_force", make<SideForce>}};
  return all;
}

}  // namespace

const std::vector<std::string>& outsideNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& [name, maker] : makers()) list.push_back(name);
    return list;
  }();
  return names;
}

EffectFactory withOutside(const EffectFactory& library) {
  return [library](const std::string& name) {
    const auto found = makers().find(name);
    return found == makers().end() ? library(name) : found->second();
  };
}

}  // namespace btr::prove
