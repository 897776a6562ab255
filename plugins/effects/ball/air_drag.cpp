/// Air slows a ball (Newton's drag):
///   F = −½·ρ·c·π·r²·|v|·v      ρ = 1.2 kg/m³ (dry air at 20 °C), c: drag number, 0.47 of a smooth sphere at Reynolds
/// numbers from 1e3 to 2e5. Neutral: c = 0.
#include <memory>
#include <numbers>

#include "core/plugin/plugin.h"

namespace {

class AirDrag final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"drag_number", "", "drag coefficient on the ball's cross-section", 0, 5, 0.47, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::air, "air drag, in proportion to the square of the speed", "F = −½·ρ·c·π·r^2·|v|·v",
            "c: drag_number; ρ = 1.2 kg/m³", "Newton; Hoerner 1965"};
  }
  Place place() const override { return Place::ball; }
  bool dissipative() const override { return true; }

  Eigen::Vector3d ballForce(const btr::BallState& ball, std::span<const double> values) const override {
    constexpr double air_kg_m3 = 1.2;
    const double area = std::numbers::pi * ball.radius_m * ball.radius_m;
    return -0.5 * air_kg_m3 * values[0] * area * ball.velocity_m_s.norm() * ball.velocity_m_s;
  }
};

}  // namespace

BTR_EFFECT(AirDrag, "air_drag")
