/// A steady wind u pushes balls: the drag of the air relative to them, less what they would feel in still air (that is
/// the effect air_drag's business):
///   F = D(u − v) − D(−v),   D(w) = ½·ρ·c·π·r²·|w|·w      ρ = 1.2 kg/m³, c = 0.47 (smooth sphere)
/// unless the simulator has an air_drag that says another: then c is that number, the mean of several balls'. Newton's
/// drag at the speed relative to the air (Hoerner 1965, Fluid-Dynamic Drag). Together with air_drag it is exactly the
/// drag in the wind. Robots feel none. Neutral: u = 0.
#include <memory>
#include <numbers>

#include "core/plugin/plugin.h"

namespace {

class ConstantWind final : public btr::Effect {
  std::vector<btr::Parameter> parameters() const override {
    return {{"x_m_s", "m/s", "speed of the wind along x", -20, 20, 2, 0.0},
            {"y_m_s", "m/s", "speed of the wind along y", -20, 20, 2, 0.0}};
  }
  btr::EffectLaw law() const override {
    return {btr::EffectLaw::Acts::air, "a steady wind", "F = D(u − v) − D(−v),  D(w) = ½·ρ·c·π·r^2·|w|·w",
            "u: x_m_s, y_m_s; c: drag number of air_drag, 0.47 without; ρ = 1.2 kg/m³", "Hoerner 1965"};
  }
  Place place() const override { return Place::world; }
  /// Its own numbers, along x and y, are followed by the drag number.
  void changeScene(btr::Scene& scene, const std::string&, std::span<const double>) const override {
    double sum = 0, count = 0;
    for (const btr::SceneEffect& placed : scene.effects)
      if (placed.name == "air_drag" && placed.values[0] > 0) sum += placed.values[0], ++count;
    for (btr::SceneEffect& placed : scene.effects)
      if (placed.effect.get() == this && count > 0) placed.values = {placed.values[0], placed.values[1], sum / count};
  }
  /// By itself it would drive a ball on that flies before the wind: air that does so slows one that flies against it.
  std::vector<std::string> needs() const override { return {"air_drag", "viscous_drag"}; }

  Eigen::Vector3d ballForce(const btr::BallState& ball, std::span<const double> values) const override {
    constexpr double air_kg_m3 = 1.2;
    const double dragNumber = values.size() > 2 ? values[2] : 0.47;
    const Eigen::Vector3d wind(values[0], values[1], 0);
    if (wind.isZero(0)) return Eigen::Vector3d::Zero();
    const Eigen::Vector3d relative = wind - ball.velocity_m_s;
    const double area = std::numbers::pi * ball.radius_m * ball.radius_m;
    return 0.5 * air_kg_m3 * dragNumber * area *
           (relative.norm() * relative + ball.velocity_m_s.norm() * ball.velocity_m_s);
  }
};

}  // namespace

BTR_EFFECT(ConstantWind, "constant_wind")
