/// A ball that rolls loses speed at a constant rate: v' = −a·v/|v|      a in m/s², carpet 0.3 … 0.6
/// The same as a rolling friction coefficient of a/g; comes from the carpet's and the shell's deformation. It acts as a
/// moment against the ball's spin while the ball lies on the floor, added to what the scene already has. Neutral: a =
/// 0.
#include <memory>

#include "core/plugin/plugin.h"

namespace {

class RollingResistance final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"deceleration_m_s2", "m/s²", "speed that a rolling ball loses per second", 0, 3, 0.4, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::contact, "a constant loss of speed while rolling", "v̇ = −a·v/|v|",
            "a: deceleration_m_s2", "a definition"};
  }
  Place place() const override { return Place::ball; }
  bool dissipative() const override { return true; }

  void changeScene(btr::Scene& scene, const std::string& at, std::span<const double> values) const override {
    for (btr::BallSpec& ball : scene.balls)
      if (ball.name == at) {
        ball.rollingDeceleration_m_s2 += values[0];
        return;
      }
    throw btr::InputError("rolling_resistance: the scene has no ball \"" + at + "\"");
  }
};

}  // namespace

BTR_EFFECT(RollingResistance, "rolling_resistance")
