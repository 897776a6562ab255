// Firmware may change a servo's gains while it runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

constexpr double armMass = 0.5, armLength = 0.1, armInertia = 0.002, gainP = 4, gainI = 3, gainD = 0.05;

Scene servoArm(double pTimes, double iTimes, double dTimes) {
  Drive drive;
  drive.p = gainP * pTimes;
  drive.i = gainI * iTimes;
  drive.d = gainD * dTimes;
  drive.maxTorque = 2;
  return sceneOf(robot(pendulumModel(armMass, armLength, armInertia), false, drive), 0.001);
}

/// Where it is after each period; gains are times those of the scene from one period on.
std::vector<double> placesOf(const Scene& scene, const JointInput& input, int from = 0, int periods = 200) {
  World world(scene, 1);
  std::vector<double> places;
  for (int n = 0; n < periods; ++n) {
    world.advance({{n < from ? JointInput{input.command} : input}}, scene.controlPeriod_s);
    places.push_back(world.robot(0).position[0]);
  }
  return places;
}

JointInput withGains(double pTimes, double iTimes, double dTimes) {
  JointInput input{0.6};
  input.pTimes = pTimes;
  input.iTimes = iTimes;
  input.dTimes = dTimes;
  return input;
}

TEST(Gains, TimesThoseOfTheSceneIsAServoWithTheseGains) {
  EXPECT_EQ(placesOf(servoArm(1, 1, 1), withGains(2, 0.5, 4)), placesOf(servoArm(2, 0.5, 4), withGains(1, 1, 1)));
  EXPECT_NE(placesOf(servoArm(1, 1, 1), withGains(2, 0.5, 4)), placesOf(servoArm(1, 1, 1), withGains(1, 1, 1)));
}

// At rest p·(command − q) = m·g·l·sin q.
TEST(Gains, AChangedOneCarriesTheWeightWithAnotherError) {
  const Scene scene = servoArm(1, 0, 1);
  for (const double factor : {0.5, 3.0}) {
    const double q = placesOf(scene, withGains(factor, 1, 1), 50, 1500).back();
    EXPECT_NEAR(factor * gainP * (0.6 - q), armMass * g * armLength * std::sin(q), 1e-6);
  }
}

TEST(Gains, WithoutAnyTheJointSwings) {
  // Nothing holds it: it falls back from where it was, as one that is switched off does.
  const std::vector<double> places = placesOf(servoArm(1, 1, 1), withGains(0, 0, 0), 100, 200);
  EXPECT_LT(*std::min_element(places.begin() + 100, places.end()), 0.2);
}

}  // namespace
}  // namespace btr::test
