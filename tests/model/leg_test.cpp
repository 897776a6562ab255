// The inverse kinematics of the three-joint leg, against forward kinematics and the drawing.
#include <gtest/gtest.h>

#include <cmath>

#include "core/model/four_legs.h"
#include "core/model/kinematics.h"
#include "core/model/load_model.h"
#include "core/spec/error.h"
#include "core/spec/random.h"

namespace btr {
namespace {

const RobotModel& dog() {
  static const RobotModel model = loadModel(SOURCE_DIR "/resources/robots/ers7.wrl");
  return model;
}

const FourLegs& legs() {
  static const FourLegs four = FourLegs::of(dog(), "test");
  return four;
}

// The ERS-7's drawing: hip, knee and the foot's contact point at zero.
const LegGeometry front{{0.009, 0.0047, -0.0695}, {-0.01124, 0, -0.07607}, 1};
const LegGeometry rear{{-0.009, 0.0047, -0.0695}, {0.0198, 0, -0.0769}, -1};

LegAngles drawn(const LegLimits& limits, Random& random) {
  LegAngles angles;
  for (std::size_t j = 0; j < 3; ++j) angles[j] = random.uniform(limits.lower[j], limits.upper[j]);
  return angles;
}

TEST(Leg, FindsAnglesWithinTheLimitsForAnyPoseWithinThem) {
  Random random(5);
  for (const FourLegs::Leg& leg : legs().legs)
    for (int i = 0; i < 5000; ++i) {
      const Eigen::Vector3d foot = leg.geometry.foot(drawn(leg.limits, random));
      const LegSolution found = leg.geometry.solve(foot, drawn(leg.limits, random), leg.limits);
      ASSERT_TRUE(found.feasible());
      EXPECT_TRUE(leg.limits.allow(found.angles));
      EXPECT_LT((leg.geometry.foot(found.angles) - foot).norm(), 1e-9);
    }
}

TEST(Leg, FindsTheVeryAnglesThatItComesFrom) {
  Random random(6);
  for (const FourLegs::Leg& leg : legs().legs)
    for (int i = 0; i < 2000; ++i) {
      const LegAngles angles = drawn(leg.limits, random);
      const LegSolution found = leg.geometry.solve(leg.geometry.foot(angles), angles, leg.limits);
      // Where both roots of a joint meet (the leg stretched), the nearest is found to the root of the rounding.
      for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(angles[j], found.angles[j], 1e-6);
    }
}

TEST(Leg, HasAFootWhereTheModelHasIt) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    std::vector<double> positions = restPositions(dog());
    std::array<LegAngles, 4> angles;
    for (std::size_t n = 0; n < 4; ++n) {
      angles[n] = drawn(legs().legs[n].limits, random);
      for (std::size_t j = 0; j < 3; ++j) positions[legs().legs[n].joints[j]] = angles[n][j];
    }
    const auto poses = forwardKinematics(dog(), Eigen::Isometry3d::Identity(), positions);
    for (std::size_t n = 0; n < 4; ++n) {
      const FourLegs::Leg& leg = legs().legs[n];
      const Eigen::Vector3d foot = leg.hip_m + leg.turned(leg.geometry.foot(angles[n]));
      EXPECT_LT((foot - footOf(dog(), poses, FourLegs::names[n], "test").centre_m).norm(), 1e-9);
    }
  }
}

TEST(Leg, GivesTheDrawingsFeet) {
  // ERS-7 at (0, 0, 30°): foot 37.3 mm ahead (30.3 behind) and 141.0 (146.0) below the hip.
  const LegAngles standing{0, 0, M_PI / 6};
  EXPECT_LT((front.foot(standing) - Eigen::Vector3d(0.0373, 0.0047, -0.141)).norm(), 1e-4);
  EXPECT_LT((rear.foot(standing) - Eigen::Vector3d(-0.0303, 0.0047, -0.146)).norm(), 1e-4);
  // The model's feet are balls; their lowest points stand on the drawing's contact points.
  for (const FourLegs::Leg& leg : legs().legs) {
    const Eigen::Vector3d contact = leg.geometry.foot(standing) - Eigen::Vector3d(0, 0, leg.footRadius_m);
    const Eigen::Vector3d expected =
        leg.front ? Eigen::Vector3d(0.0373, 0.0047, -0.141) : Eigen::Vector3d(-0.0303, 0.0047, -0.146);
    EXPECT_LT((contact - expected).norm(), 1e-5);  // the model's file keeps hundredths of millimetres
  }
}

TEST(Leg, HasTheHipsOfTheDrawing) {
  for (const FourLegs::Leg& leg : legs().legs)
    EXPECT_LT((leg.hip_m - Eigen::Vector3d(leg.front ? 0.065 : -0.065, leg.left ? 0.0625 : -0.0625, 0)).norm(), 1e-9);
}

TEST(Leg, TakesTheKneeThatIsNearerToTheLastCommand) {
  // Both ways to fold the knee reach a foot 130 mm below the hip.
  const Eigen::Vector3d foot(0.01, 0.0047, -0.130);
  const LegSolution one = front.solve(foot, {0, 0, 1}), other = front.solve(foot, {0, 0, -1});
  EXPECT_GT(one.angles[2], 0.3);
  EXPECT_LT(other.angles[2], -0.1);
  for (const auto& solution : {one, other}) EXPECT_LT((front.foot(solution.angles) - foot).norm(), 1e-12);
}

TEST(Leg, TakesTheKneeThatKeepsTheLimitsEvenIfTheOtherIsNearer) {
  LegLimits limits;
  limits.lower[2] = 0;
  const Eigen::Vector3d foot(0.01, 0.0047, -0.130);
  const LegSolution found = front.solve(foot, {0, 0, -1}, limits);
  EXPECT_TRUE(found.feasible());
  EXPECT_GT(found.angles[2], 0);
}

TEST(Leg, SaysWhenAFootIsOutOfReachAndStretchesTowardsIt) {
  const LegSolution found = front.solve({0, 0.0047, -0.2}, {0, 0, 0.3});
  EXPECT_FALSE(found.reached);
  EXPECT_FALSE(found.feasible());
  const Eigen::Vector3d reached = front.foot(found.angles);
  EXPECT_LT(std::abs(reached.x()), 1e-9);
  EXPECT_NEAR(-(front.knee.norm() + front.shank.norm()), reached.z(), 1e-3);
}

TEST(Leg, SaysWhenALimitIsBrokenAndStopsThere) {
  LegLimits limits;
  limits.upper[0] = 0.2;
  limits.lower[0] = -0.2;
  const LegSolution found = front.solve(front.foot({0.5, 0.1, 0.6}), {0.5, 0.1, 0.6}, limits);
  EXPECT_TRUE(found.reached);
  EXPECT_FALSE(found.withinLimits);
  EXPECT_TRUE(limits.allow(found.angles));
}

TEST(FourLegs, RefusesARobotWithoutSuchLegs) {
  RobotModel model = dog();
  model.joints[legs().legs[2].joints[1]].name = "other";
  EXPECT_THROW(FourLegs::of(model, "test"), InputError);
  model = dog();
  model.joints[legs().legs[1].joints[0]].axis = Eigen::Vector3d::UnitZ();
  EXPECT_THROW(FourLegs::of(model, "test"), InputError);
  model = dog();
  model.joints[legs().legs[1].joints[2]].axis *= -1;  // the knee folds the other way
  EXPECT_THROW(FourLegs::of(model, "test"), InputError);
  model = dog();
  model.links[legs().legs[0].joints[2] + 1].shapes.clear();
  EXPECT_THROW(FourLegs::of(model, "test"), InputError);
}

}  // namespace
}  // namespace btr
