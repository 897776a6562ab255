/// A spinning ball in the air is pushed aside (Robins 1742, Magnus 1852):
///   F = ½·ρ·π·r²·C·|v|·(ω × v)/|ω|      ρ = 1.2 kg/m³, ω: spin [rad/s], S = r·|ω|/|v|: spin ratio
///   saturates 0   C = l·S                 the force is ½·ρ·π·r³·l·(ω × v)
///   saturates 1   C = l·S/(1 + 2.32·l·S)  fast spins lift less than in proportion: with l = 2.5 the curve of Nathan
///   2008
///                                         (The effect of spin on the flight of a baseball), S/(0.4 + 2.32·S)
/// l is the lift coefficient per spin ratio: about 1 for sports balls, 16/3 in an ideal fluid (Rubinow and Keller 1961:
/// 2 at very small Reynolds numbers). Across the velocity, so without work. Neutral: l = 0.
#include <cmath>
#include <memory>
#include <numbers>

#include "core/plugin/plugin.h"

namespace {

class MagnusLift final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    btr::Parameter saturates{"saturates", "", "0: lift in proportion to spin, 1: less than that at fast spin", 0, 1, 0};
    saturates.integer = true;
    return {{"lift_number", "", "lift coefficient per ratio of spin to speed", -2, 6, 1, 0.0}, saturates};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::air, "lift of a spinning ball",
            "F = ½·ρ·π·r^3·l·(ω × v), divided by 1 + 2.32·l·S where it saturates",
            "l: lift_number; ω: spin; S = r·|ω|/|v|; ρ = 1.2 kg/m³", "Robins 1742; Magnus 1852; Nathan 2008"};
  }
  Place place() const override { return Place::ball; }

  Eigen::Vector3d ballForce(const btr::BallState& ball, std::span<const double> values) const override {
    constexpr double air_kg_m3 = 1.2, nathan = 2.32;
    const double cube = ball.radius_m * ball.radius_m * ball.radius_m;
    const Eigen::Vector3d across = ball.spin_rad_s.cross(ball.velocity_m_s);
    const double speed = ball.velocity_m_s.norm();
    double fading = 1;
    if (values[1] != 0 && speed > 0)
      fading += nathan * std::abs(values[0]) * ball.radius_m * ball.spin_rad_s.norm() / speed;
    return 0.5 * air_kg_m3 * std::numbers::pi * cube * values[0] / fading * across;
  }
};

}  // namespace

BTR_EFFECT(MagnusLift, "magnus_lift")
