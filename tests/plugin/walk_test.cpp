// The 20-parameter walk: which paths its feet take and when.
#include <gtest/gtest.h>

#include <cmath>

#include "core/spec/error.h"
#include "core/spec/random.h"
#include "tests/plugin/walk_scene.h"

namespace btr {
namespace {

using test::host;
using test::Walking;
using test::walkScene;

// Operating points of the start gait.
const Eigen::Vector3d front(0.055, 0.007, -0.105), rear(-0.050, 0.005, -0.115);

/// Place of a foot of the start gait in the ground's axes, from its operating point.
Eigen::Vector3d placeOf(const Walking& walking, std::size_t leg, long frame) {
  return walking.onGround(leg, frame, front, rear);
}

/// Periods of a cycle in which the foot is on the ground.
long groundFrames(const Walking& walking, std::size_t leg) {
  long frames = 0;
  for (long frame = 0, cycle = walking.cycle(); frame < cycle; ++frame)
    frames += std::abs(placeOf(walking, leg, frame).z()) < 1e-9;
  return frames;
}

TEST(WalkGenotype, HasTheTwentyParametersOfThePaper) {
  const auto genotype = host().controller("walk")->genotype();
  ASSERT_EQ(20u, genotype.size());
  for (const Parameter& parameter : genotype) EXPECT_NO_THROW(check(parameter, parameter.byDefault, parameter.name));
}

TEST(WalkStart, StandsOnFourFeetWithItsOtherJointsAtRest) {
  const Scene scene = walkScene("walk");
  const SceneRobot& robot = scene.robots[0];
  const auto poses = forwardKinematics(robot.model, robot.start, robot.jointStart);
  for (const char* leg : FourLegs::names) {
    const FootBall foot = footOf(robot.model, poses, leg, "test");
    EXPECT_NEAR(foot.radius_m, foot.centre_m.z(), 1e-4) << leg;
  }
  EXPECT_GT(robot.start.linear()(2, 2), std::cos(0.1));
  EXPECT_EQ(0, robot.jointStart[static_cast<std::size_t>(robot.model.findJoint("HEAD_PAN"))]);
}

TEST(WalkStart, RefusesWhatItCannotUse) {
  const auto walk = host().controller("walk");
  Scene none;
  EXPECT_THROW(walk->arrange(none, {}), InputError);
  Scene scene = walkScene("walk");
  EXPECT_THROW(walk->arrange(scene, {{"duration_s", -1}}), InputError);
  EXPECT_THROW(walk->arrange(scene, {{"duration_s", 2}, {"lead_in_s", 3}}), InputError);
  EXPECT_THROW(walk->arrange(scene, {{"no_such_setting", 1}}), InputError);
  scene.robots[0].model.joints[3].name = "other";
  scene.robots[0].model.joints[4].name = "another";
  EXPECT_THROW(walk->arrange(scene, {}), InputError);
}

TEST(WalkGait, TheStartGaitIsFeasible) {
  EXPECT_EQ(0, Walking("walk", {}).infeasible());
  EXPECT_EQ(0, Walking("half_ellipse", {}).infeasible());
}

TEST(WalkGait, ItsTimesAddUpToTheCycle) {
  // L/v = 0.070/0.175 = 0.4 s = 50 periods on the ground; f = 0.5: 100 in all; 4 to lift, 4 to descend.
  const Walking walking("walk", {{"ground_speed_m_s", 0.175}, {"air_fraction", 0.5}, {"lift_time_s", 0.032}});
  EXPECT_EQ(100, walking.cycle());
  // Touch-down to lift-off: 50 steps between 51 places on the ground.
  EXPECT_EQ(51, groundFrames(walking, 0));
  EXPECT_EQ(51, groundFrames(walking, 3));
  EXPECT_NEAR(0.012, placeOf(walking, 0, 54).z(), 1e-9);  // lifted
  EXPECT_NEAR(0.012, placeOf(walking, 0, 96).z(), 1e-9);  // about to descend
  EXPECT_NEAR(0.025, placeOf(walking, 0, 75).z(), 1e-9);  // in the middle
}

TEST(WalkGait, TheCycleIsTheGroundTimeDividedByItsShare) {
  for (const double v : {0.1, 0.2, 0.3, 0.4})
    for (const double f : {0.3, 0.5, 0.6})
      for (const double length : {0.03, 0.06, 0.1}) {
        const Walking walking("walk", {{"ground_speed_m_s", v}, {"air_fraction", f}, {"length_m", length}});
        const long cycle = walking.cycle();
        EXPECT_EQ(0, cycle % 2);
        EXPECT_NEAR(length / v / (1 - f) / 0.008, static_cast<double>(cycle), 1.5) << v << ' ' << f << ' ' << length;
      }
}

TEST(WalkGait, TheFeetGoStraightBackAtTheGroundSpeed) {
  const Walking walking("walk", {{"ground_speed_m_s", 0.175}});
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const long late = leg == 1 || leg == 2 ? 50 : 0;
    for (long frame = 0; frame <= 50; ++frame) {
      const Eigen::Vector3d expected(0.035 - 0.175 * 0.008 * static_cast<double>(frame), 0, 0);
      EXPECT_LT((placeOf(walking, leg, late + frame) - expected).norm(), 1e-9) << leg << ' ' << frame;
    }
  }
}

TEST(WalkGait, TheFootPathClosesAndNeverJumps) {
  const Walking walking("walk", {});
  const long cycle = walking.cycle();
  for (std::size_t leg = 0; leg < 4; ++leg) {
    EXPECT_LT((walking.contact(leg, 0) - walking.contact(leg, cycle)).norm(), 1e-12);
    for (long frame = 0; frame < cycle; ++frame)
      EXPECT_LT((walking.contact(leg, frame + 1) - walking.contact(leg, frame)).norm(), 0.008);
  }
}

TEST(WalkGait, TheAirStageHasItsShape) {
  // Half an ellipse for p = 2, straight lines for p = 1, nearly a box for p = 6; at a quarter of the length.
  const auto height = [](double shape) {
    // The stage takes 42 periods; x = −L/4 at a third of it.
    const Walking walking("walk",
                          {{"ground_speed_m_s", 0.175}, {"shape", shape}, {"air_points", 3}, {"front_air_m", 0.020}});
    return placeOf(walking, 0, 54 + 14).z();
  };
  EXPECT_NEAR(0.012 + 0.008 * std::sqrt(0.75), height(2), 1e-9);
  EXPECT_NEAR(0.012 + 0.008 * 0.5, height(1), 1e-9);
  EXPECT_NEAR(0.012 + 0.008 * std::pow(1 - std::pow(0.5, 6), 1.0 / 6), height(6), 1e-9);
}

TEST(WalkGait, LeftAndRightAreMirrorImagesHalfACycleApart) {
  const Walking walking("walk", {});
  const long cycle = walking.cycle();
  for (long frame = 0; frame < cycle; ++frame)
    for (const std::size_t left : {0u, 2u})
      for (std::size_t j = 0; j < 3; ++j)
        EXPECT_NEAR(walking.angles(left, frame)[j], walking.angles(left + 1, frame + cycle / 2)[j], 1e-12);
}

TEST(WalkGait, FeetGoInThePlaneThroughTheirOperatingPoints) {
  // Front legs 20 mm shorter than rear ones: seen from the root, all four feet on the ground lie in one plane.
  const Walking walking("walk", {{"front_z_m", -0.095}});
  const double slope = (-0.095 + 0.115) / (0.130 + 0.055 + 0.050);
  for (std::size_t leg = 0; leg < 4; ++leg)
    for (const long frame : {2L, 20L, 40L}) {
      const long late = leg == 1 || leg == 2 ? walking.cycle() / 2 : 0;
      const Eigen::Vector3d place = walking.legs.legs[leg].hip_m + walking.contact(leg, late + frame);
      EXPECT_NEAR(-0.115 + slope * (place.x() + 0.065 + 0.050), place.z(), 1e-9) << leg << ' ' << frame;
    }
}

TEST(WalkGait, SkewMirroredIsTheOtherSkew) {
  const Walking one("walk", {{"skew_rad", 0.2}}), other("walk", {{"skew_rad", -0.2}});
  const long cycle = one.cycle();
  double apart = 0;
  for (long frame = 0; frame < cycle; ++frame)
    for (const std::size_t left : {0u, 2u})
      for (std::size_t j = 0; j < 3; ++j) {
        EXPECT_NEAR(one.angles(left, frame)[j], other.angles(left + 1, frame + cycle / 2)[j], 1e-12);
        apart = std::max(apart, std::abs(one.angles(left, frame)[j] - other.angles(left, frame)[j]));
      }
  EXPECT_GT(apart, 0.05);
}

TEST(WalkGait, TheStrokeTurnsWithItsDirection) {
  for (const std::string controller : {"walk", "half_ellipse"}) {
    const Walking sideways(controller, {}, {{"direction_rad", M_PI / 2}});
    const Eigen::Vector3d begin = sideways.contact(0, 0), later = sideways.contact(0, 10);
    EXPECT_NEAR(begin.x(), later.x(), 1e-9);
    EXPECT_LT(later.y(), begin.y() - 0.005);  // a left foot goes to the right, which is inward
  }
}

TEST(WalkGait, TurningFeetGoAroundTheMiddleOfTheBody) {
  const Walking turning("half_ellipse", {{"length_m", 0}}, {{"turn_rad_s", 1}});
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const long late = leg == 1 || leg == 2 ? turning.cycle() / 2 : 0;
    const auto& geometry = turning.legs.legs[leg];
    const auto place = [&](long frame) -> Eigen::Vector3d {
      return geometry.hip_m + geometry.turned(turning.contact(leg, late + frame));
    };
    const Eigen::Vector3d step = place(11) - place(10), r = (place(11) + place(10)) / 2;
    // Clockwise seen from above, so that the body turns to the left; straight, so tangential only near the middle.
    EXPECT_LT(r.x() * step.y() - r.y() * step.x(), -1e-6);
  }
}

TEST(WalkGait, ALeadInBringsTheStanceToTheFirstFrame) {
  const Walking walking("walk", {}, {{"lead_in_s", 0.4}});
  const auto& start = walking.scene.robots[0].jointStart;
  const auto first = walking.commands(49), half = walking.commands(24);
  for (std::size_t j = 0; j < start.size(); ++j) EXPECT_NEAR((start[j] + first[j]) / 2, half[j], 1e-12);
  EXPECT_DOUBLE_EQ(20, walking.motion->duration());
}

TEST(WalkGait, InfeasiblePointsAreCountedAndNeverFatal) {
  // 130 mm below the hip and 80 mm ± 55 mm ahead is further than the leg is long.
  const Walking far("walk", {{"front_z_m", -0.130}, {"front_x_m", 0.080}, {"length_m", 0.110}});
  EXPECT_GT(far.infeasible(), 0);
  EXPECT_LT(far.infeasible(), far.motion->remarks().at("points"));
}

TEST(WalkGait, AnyVectorWithinTheBoundsMovesTheLegsWithinTheirLimits) {
  Random random(11);
  for (const std::string controller : {"walk", "half_ellipse"})
    for (int i = 0; i < 60; ++i) {
      Values drawn;
      for (const Parameter& p : host().controller(controller)->genotype()) {
        const double value = random.uniform(p.minimum, p.maximum);
        drawn[p.name] = p.integer ? std::round(value) : value;
      }
      const Walking walking(controller, drawn);
      for (long frame = 0; frame < 150; ++frame)
        for (std::size_t leg = 0; leg < 4; ++leg)
          ASSERT_TRUE(walking.legs.legs[leg].limits.allow(walking.angles(leg, frame))) << controller << ' ' << i;
    }
}

TEST(HalfEllipse, HasKohlAndStonesTwelveParametersAndTheirTimes) {
  ASSERT_EQ(12u, host().controller("half_ellipse")->genotype().size());
  const Walking walking("half_ellipse", {{"cycle_s", 0.704}, {"ground_fraction", 0.5}});
  EXPECT_EQ(88, walking.cycle());
  EXPECT_EQ(45, groundFrames(walking, 0));
  EXPECT_NEAR(0.025, placeOf(walking, 0, 66).z(), 1e-9);
  EXPECT_LT((placeOf(walking, 0, 0) - Eigen::Vector3d(0.035, 0, 0)).norm(), 1e-9);
}

}  // namespace
}  // namespace btr
