/// A ball loses speed in proportion to its speed, wherever it is:
///   F = −b·m·v      b in 1/s; v̇ = −b·v in flight, −b·v/(1 + k) where it rolls, with I = k·m·r²
/// The part of rolling resistance that grows with speed (a foam or a carpet that is pressed in faster), the drag of
/// small spheres in air or of larger ones in water (Stokes 1851), and what other simulators call linear damping.
/// Neutral: b = 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class ViscousDrag final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"loss_1_s", "1/s", "share of the speed that is lost per second in flight", 0, 5, 0.2, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::air, "a loss of speed in proportion to the speed, in flight and rolling",
            "F = −b·m·v", "b: loss_1_s; m: the ball's mass", "Stokes 1851"};
  }
  Place place() const override { return Place::ball; }
  bool dissipative() const override { return true; }

  Eigen::Vector3d ballForce(const btr::BallState& ball, std::span<const double> values) const override {
    return -values[0] * ball.mass_kg * ball.velocity_m_s;
  }
};

}  // namespace

BTR_EFFECT(ViscousDrag, "viscous_drag")
