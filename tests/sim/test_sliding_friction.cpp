// Friction of what slides while something pushes across it, against Coulomb's law.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace sliding {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double friction = 0.5, slope_rad = 0.3, speed_m_s = 2, after_s = 0.32;

/// A flat plate that slides across a slope, seen in the slope's own frame: it falls along y.
Scene plate(SlidingFriction law, double step) {
  SceneRobot body = robot(bodyModel(1, Vector3d(3.4e-3, 3.4e-3, 6.7e-3), {box({0.2, 0.2, 0.02})}), true);
  body.start.translation() = Vector3d(0, 0, 0.0099);
  body.startVelocity_m_s = Vector3d(speed_m_s, 0, 0);
  Scene scene = sceneOf(std::move(body), step);
  scene.gravity_m_s2 = Vector3d(0, g * std::sin(slope_rad), -g * std::cos(slope_rad));
  scene.floor = FloorSpec{};
  scene.floor->friction = friction;
  scene.slidingFriction = law;
  return scene;
}

Vector2d wayOf(const Scene& scene) {
  World world(scene, 1);
  world.advance(commands(scene, 0), after_s);
  return world.robot(0).base.translation().head<2>();
}

/// v' = g·sin·y − μ·g·cos·v/|v|, by the midpoint rule with 10 µs.
Vector2d coulomb() {
  Vector2d at(0, 0), v(speed_m_s, 0);
  const auto rate = [](const Vector2d& now) -> Vector2d {
    return Vector2d(0, g * std::sin(slope_rad)) - friction * g * std::cos(slope_rad) * now.normalized();
  };
  const double h = 1e-5;
  for (double t = 0; t < after_s - h / 2; t += h) {
    const Vector2d middle = v + h / 2 * rate(v);
    at += h * middle;
    v += h * rate(middle);
  }
  return at;
}

// tan 0.3 < 0.5: at rest the plate would stay, but while it slides nothing holds it across its way.
TEST(SlidingFriction, IsotropicIsCoulombsLaw) {
  const Vector2d wanted = coulomb();
  ASSERT_GT(wanted.y(), 0.05);
  double before = 1;
  for (const double step : {0.004, 0.001, 0.00025}) {
    const double off = (wayOf(plate(SlidingFriction::isotropic, step)) - wanted).norm() / wanted.norm();
    EXPECT_LT(off, 0.1) << step;
    EXPECT_LT(off, before) << step;
    before = off;
  }
  EXPECT_LT(before, 0.01);
}

// What scenes of before mean: it keeps its direction.
TEST(SlidingFriction, BoxHoldsTheDirection) {
  EXPECT_LT(wayOf(plate(SlidingFriction::box, 0.001)).y(), 0.2 * coulomb().y());
}

}  // namespace sliding
}  // namespace btr::test
