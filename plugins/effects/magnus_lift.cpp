/// A spinning ball in the air is pushed aside (Robins 1742, Magnus 1852):
///   F = ½·ρ·π·r³·l·(ω × v)      ρ = 1.2 kg/m³, ω: spin [rad/s]
/// l is the lift coefficient per spin ratio r·ω/v: about 1 for sports balls, 16/3 in an ideal fluid (Rubinow and Keller
/// 1961: 2 at very small Reynolds numbers). Across the velocity, so without work. Neutral: l = 0.
#include <memory>
#include <numbers>

#include "core/plugin/plugin.h"

namespace {

class MagnusLift final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"lift_number", "", "lift coefficient per ratio of spin to speed", -2, 6, 1, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::air, "lift of a spinning ball", "F = ½·ρ·π·r^3·l·(ω × v)",
            "l: lift_number; ω: spin; ρ = 1.2 kg/m³", "Robins 1742; Magnus 1852; Rubinow and Keller 1961"};
  }
  Place place() const override { return Place::ball; }

  Eigen::Vector3d ballForce(const btr::BallState& ball, std::span<const double> values) const override {
    constexpr double air_kg_m3 = 1.2;
    const double cube = ball.radius_m * ball.radius_m * ball.radius_m;
    return 0.5 * air_kg_m3 * std::numbers::pi * cube * values[0] * ball.spin_rad_s.cross(ball.velocity_m_s);
  }
};

}  // namespace

BTR_EFFECT(MagnusLift, "magnus_lift")
