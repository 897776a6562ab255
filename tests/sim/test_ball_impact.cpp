// A ball that flies and hits the floor: the instant and the place of a bounce, whatever the step.
#include "core/sim/contact/ball_impact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/sim/world.h"

namespace btr {
namespace {

constexpr double fallsBy_m_s2 = 9.81, bouncingRadius_m = 0.04, bouncingMass_kg = 0.05;

Scene floorWith(double restitution, double friction, double step_s) {
  Scene scene;
  scene.step_s = step_s;
  scene.gravity_m_s2 = {0, 0, -fallsBy_m_s2};
  scene.floor.emplace();
  scene.floor->restitution = restitution;
  scene.floor->friction = friction;
  BallSpec ball;
  ball.name = "ball";
  ball.radius_m = bouncingRadius_m;
  ball.mass_kg = bouncingMass_kg;
  ball.inertiaFactor = 0.4;
  scene.balls.push_back(ball);
  return scene;
}

BallState afterFlight(const Scene& scene, const BallState& start, double length_s) {
  World world(scene, 1);
  world.setBall(0, start);
  world.advance({}, length_s);
  return world.ball(0);
}

TEST(BallImpact, ABallThatIsDroppedReboundsAsTheParabolaSaysWhateverTheStep) {
  constexpr double restitution = 0.7, height_m = 0.5, length_s = 0.5;
  BallState start;
  start.position_m << 0, 0, bouncingRadius_m + height_m;
  const double fall_s = std::sqrt(2 * height_m / fallsBy_m_s2), rise_s = length_s - fall_s;
  const double up_m_s = restitution * fallsBy_m_s2 * fall_s;
  const double height = bouncingRadius_m + up_m_s * rise_s - fallsBy_m_s2 * rise_s * rise_s / 2;
  for (const double step_s : {0.0005, 0.001, 0.004, 0.01}) {
    const BallState end = afterFlight(floorWith(restitution, 0.5, step_s), start, length_s);
    EXPECT_NEAR(end.position_m.z(), height, 1e-9) << step_s;
    EXPECT_NEAR(end.velocity_m_s.z(), up_m_s - fallsBy_m_s2 * rise_s, 1e-9) << step_s;
  }
}

// Sticks: the lowest point comes to rest, J = u·m·f/(1 + f) with f = I/(m·r²). Slides: J = μ·(1 + e)·m·v.
TEST(BallImpact, FrictionEndsTheSlidingOfTheLowestPointOrIsCoulombs) {
  constexpr double restitution = 0.6, down_m_s = 2, along_m_s = 1, spin_rad_s = 10, factor = 0.4;
  const double sliding = along_m_s - bouncingRadius_m * spin_rad_s;
  for (const double friction : {1.0, 0.02}) {
    BallMotion ball;
    ball.velocity_m_s << along_m_s, 0, -down_m_s;
    ball.spin_rad_s << 0, spin_rad_s, 0;
    ContactSurface surface;
    surface.friction = friction;
    surface.restitution = restitution;
    hitFloor(ball, {bouncingRadius_m, bouncingMass_kg, factor}, surface);
    const double lost = std::min(sliding * factor / (1 + factor), friction * (1 + restitution) * down_m_s);
    EXPECT_NEAR(ball.velocity_m_s.z(), restitution * down_m_s, 1e-12);
    EXPECT_NEAR(ball.velocity_m_s.x(), along_m_s - lost, 1e-12) << friction;
    EXPECT_NEAR(ball.spin_rad_s.y(), spin_rad_s + lost / (factor * bouncingRadius_m), 1e-9) << friction;
  }
}

// The engine's contact, into which a ball runs that begins in the floor, is the same law.
TEST(BallImpact, IsTheLawOfTheEnginesContact) {
  for (const double slip : {0.0, 0.05}) {
    Scene scene = floorWith(0.6, 0.3, 0.001);
    scene.gravity_m_s2.setZero();
    scene.floor->slip1_m_s_n = scene.floor->slip2_m_s_n = slip;
    scene.floor->bounceLoss_s_m = 0.2;
    BallState start;
    start.position_m << 0, 0, bouncingRadius_m - 1e-6;
    start.velocity_m_s << 0.8, -0.5, -2;
    start.spin_rad_s << 5, -9, 3;
    const BallState engine = afterFlight(scene, start, 0.001);
    BallMotion own{start.position_m, start.velocity_m_s, start.spin_rad_s};
    hitFloor(own, {bouncingRadius_m, bouncingMass_kg, 0.4}, floorSurface(*scene.floor, scene.floor->restitution));
    EXPECT_NEAR((engine.velocity_m_s - own.velocity_m_s).norm(), 0, 1e-6) << slip;
    EXPECT_NEAR((engine.spin_rad_s - own.spin_rad_s).norm(), 0, 1e-4) << slip;
  }
}

TEST(BallImpact, MeetsNothingOnTheWayUp) {
  BallMotion ball;
  ball.position_m << 0, 0, bouncingRadius_m;
  ball.velocity_m_s << 0, 0, 1;
  const BallMotion before = ball;
  EXPECT_FALSE(flyAndHit(ball, {0, 0, -fallsBy_m_s2}, {bouncingRadius_m, bouncingMass_kg, 0.4}, {}, 0.02, 0.01));
  EXPECT_EQ(ball.position_m, before.position_m);
  EXPECT_EQ(ball.velocity_m_s, before.velocity_m_s);
}

}  // namespace
}  // namespace btr
