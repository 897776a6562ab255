// Firmware may change a servo's gains while it runs.
#include <gtest/gtest.h>

#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

constexpr double mass = 0.5, length = 0.1, inertia = 0.002, p = 4, i = 3, d = 0.05;

Scene pendulum(double pTimes, double iTimes, double dTimes) {
  Drive drive;
  drive.p = p * pTimes;
  drive.i = i * iTimes;
  drive.d = d * dTimes;
  drive.maxTorque = 2;
  return sceneOf(robot(pendulumModel(mass, length, inertia), false, drive), 0.001);
}

/// Where it is after each period; gains are times those of the scene from one period on.
std::vector<double> swing(const Scene& scene, const JointInput& input, int from = 0, int periods = 200) {
  World world(scene, 1);
  std::vector<double> places;
  for (int n = 0; n < periods; ++n) {
    world.advance({{n < from ? JointInput{input.command} : input}}, scene.controlPeriod_s);
    places.push_back(world.robot(0).position[0]);
  }
  return places;
}

JointInput times(double pTimes, double iTimes, double dTimes) {
  JointInput input{0.6};
  input.pTimes = pTimes;
  input.iTimes = iTimes;
  input.dTimes = dTimes;
  return input;
}

TEST(Gains, TimesThoseOfTheSceneIsAServoWithTheseGains) {
  EXPECT_EQ(swing(pendulum(1, 1, 1), times(2, 0.5, 4)), swing(pendulum(2, 0.5, 4), times(1, 1, 1)));
  EXPECT_NE(swing(pendulum(1, 1, 1), times(2, 0.5, 4)), swing(pendulum(1, 1, 1), times(1, 1, 1)));
}

// At rest p·(command − q) = m·g·l·sin q.
TEST(Gains, AChangedOneCarriesTheWeightWithAnotherError) {
  const Scene scene = pendulum(1, 0, 1);
  for (const double factor : {0.5, 3.0}) {
    const double q = swing(scene, times(factor, 1, 1), 50, 1500).back();
    EXPECT_NEAR(factor * p * (0.6 - q), mass * g * length * std::sin(q), 1e-6);
  }
}

TEST(Gains, WithoutAnyTheJointSwings) {
  // Nothing holds it: it falls back from where it was, as one that is switched off does.
  const std::vector<double> places = swing(pendulum(1, 1, 1), times(0, 0, 0), 100, 200);
  EXPECT_LT(*std::min_element(places.begin() + 100, places.end()), 0.2);
}

}  // namespace
}  // namespace btr::test
