/// A carpet whose pile lies in one direction slows a ball more along one axis than along the other:
///   v' = −A²·v/|A·v|,   A = a·1 + ax·u·uᵀ + ay·w·wᵀ      [m/s²]
/// u is the floor's x turned by α about z, w the same of y; a is the resistance that the ball already has. Along u the
/// ball loses a + ax, along w a + ay; between them it also turns aside, to where it rolls more easily (the ellipse of
/// greatest dissipation). Acts while the ball lies on the floor. The elliptic limit with greatest dissipation is that
/// of sliding friction (Goyal, Ruina and Papadopoulos 1991, Planar sliding with dry friction), carried over to rolling
/// by definition. Neutral: ax = ay = 0; α then says nothing. α stays within an eighth of a turn: beyond, the axes would
/// only change places.
#include <cmath>
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class AnisotropicRollingResistance final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"along_x_m_s2", "m/s²", "speed lost per second when rolling along the pile's x", 0, 3, 0.4, 0.0},
            {"along_y_m_s2", "m/s²", "speed lost per second when rolling along the pile's y", 0, 3, 0.2, 0.0},
            {"pile_rad", "rad", "turn of the pile about z", -0.7854, 0.7854, 0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::contact, "rolling resistance that is larger along one direction of the floor",
            "v̇ = −A^2·v/|A·v|", "A: along_x_m_s2 and along_y_m_s2 along axes turned by pile_rad",
            "Goyal, Ruina and Papadopoulos 1991"};
  }
  Place place() const override { return Place::ball; }
  std::vector<std::string> contains() const override { return {"rolling_resistance"}; }
  bool dissipative() const override { return true; }

  void changeScene(btr::Scene& scene, const std::string& at, std::span<const double> values) const override {
    const double c = std::cos(values[2]), s = std::sin(values[2]);
    for (btr::BallSpec& ball : scene.balls)
      if (ball.name == at) {
        auto& [xx, xy, yy] = ball.directedRolling_m_s2;
        xx += values[0] * c * c + values[1] * s * s;
        xy += (values[0] - values[1]) * c * s;
        yy += values[0] * s * s + values[1] * c * c;
        return;
      }
    throw btr::InputError("anisotropic_rolling_resistance: the scene has no ball \"" + at + "\"");
  }
};

}  // namespace

BTR_EFFECT(AnisotropicRollingResistance, "anisotropic_rolling_resistance")
