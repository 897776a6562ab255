// The kick: where robot and ball begin, and which commands the motion gives.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/model/kinematics.h"
#include "core/model/load_model.h"
#include "core/spec/error.h"
#include "tests/plugin/built_plugins.h"

namespace btr {
namespace {

using test::host;

const RobotModel& dog() {
  static const RobotModel model = loadModel(SOURCE_DIR "/resources/robots/ers7.wrl");
  return model;
}

Scene kickScene(const Values& task) {
  Scene scene;
  scene.floor = FloorSpec{};
  scene.balls.push_back({.name = "ball"});
  SceneRobot robot;
  robot.name = "ers7";
  robot.model = dog();
  robot.start.translation() = Eigen::Vector3d(3, 4, 5);
  robot.drives.resize(dog().joints.size());
  scene.robots.push_back(robot);
  host().controller("kick")->arrange(scene, task);
  return scene;
}

std::vector<Eigen::Isometry3d> startPoses(const Scene& scene) {
  return forwardKinematics(dog(), scene.robots[0].start, scene.robots[0].jointStart);
}

std::size_t joint(const std::string& name) { return static_cast<std::size_t>(dog().findJoint(name)); }

/// Lowest point of the spheres of a leg's last link.
double lowestOf(const Scene& scene, const std::string& leg) {
  const auto poses = startPoses(scene);
  const std::size_t link = joint(leg + "_J3") + 1;
  double lowest = HUGE_VAL;
  for (const Shape& shape : dog().links[link].shapes)
    if (shape.kind == Shape::Kind::sphere && shape.collides)
      lowest = std::min(lowest, (poses[link] * shape.pose.translation()).z() - shape.size_m.x());
  return lowest;
}

TEST(KickStart, AllPawsJustTouchTheFloorAndTheBodyIsNearlyLevel) {
  const Scene scene = kickScene({});
  double lowest = HUGE_VAL;
  for (const char* leg : {"LF", "RF", "LR", "RR"}) {
    EXPECT_NEAR(0, lowestOf(scene, leg), 1e-4) << leg;
    lowest = std::min(lowest, lowestOf(scene, leg));
  }
  EXPECT_NEAR(0, lowest, 1e-12);
  EXPECT_GT(scene.robots[0].start.linear()(2, 2), std::cos(3 * std::numbers::pi / 180));
}

TEST(KickStart, NothingButThePawsReachesTheFloor) {
  const Scene scene = kickScene({});
  const auto poses = startPoses(scene);
  for (std::size_t link = 0; link < poses.size(); ++link)
    for (const Shape& shape : dog().links[link].shapes) {
      if (!shape.collides) continue;
      // A box or cylinder reaches down by its half sizes along the vertical.
      const Eigen::Isometry3d pose = poses[link] * shape.pose;
      const Eigen::Vector3d down = pose.linear().row(2).cwiseAbs();
      double depth = 0;
      if (shape.kind == Shape::Kind::sphere) depth = shape.size_m.x();
      if (shape.kind == Shape::Kind::box) depth = down.dot(shape.size_m) / 2;
      if (shape.kind == Shape::Kind::cylinder)
        depth = down.y() * shape.size_m.y() / 2 + std::hypot(down.x(), down.z()) * shape.size_m.x();
      EXPECT_GT(pose.translation().z() - depth, -1e-6) << dog().links[link].name;
    }
}

TEST(KickStart, StandsOverItsPaws) {
  const Scene scene = kickScene({});
  const auto poses = startPoses(scene);
  const double centre = (scene.robots[0].start * massProperties(dog(), scene.robots[0].jointStart).centreOfMass_m).x();
  EXPECT_LT(centre, poses[joint("LF_J3") + 1].translation().x() + 0.03);
  EXPECT_GT(centre, poses[joint("LR_J3") + 1].translation().x());
}

TEST(KickStart, TheBallLiesAtItsDistanceAndBearingFromTheNeck) {
  for (const double d : {0.14, 0.16, 0.18})
    for (const double bearing : {-0.6, 0.0, 0.6}) {
      const Scene scene = kickScene({{"distance_m", d}, {"bearing_rad", bearing}});
      const Eigen::Vector3d neck = startPoses(scene)[joint("NECK_TILT") + 1].translation();
      const auto& ball = scene.balls[0].position_m;
      EXPECT_NEAR(d, std::hypot(ball[0] - neck.x(), ball[1] - neck.y()), 1e-12);
      EXPECT_NEAR(bearing, std::atan2(ball[1] - neck.y(), ball[0] - neck.x()), 1e-12);
      EXPECT_EQ(scene.balls[0].radius_m, ball[2]);
    }
}

TEST(KickStart, IsMirroredWithItsBearing) {
  const Scene left = kickScene({{"bearing_rad", 0.4}}), right = kickScene({{"bearing_rad", -0.4}});
  EXPECT_DOUBLE_EQ(left.balls[0].position_m[0], right.balls[0].position_m[0]);
  EXPECT_DOUBLE_EQ(left.balls[0].position_m[1], -right.balls[0].position_m[1]);
  for (const char* number : {"1", "2", "3"})
    for (const char* pair : {"F", "R"})
      EXPECT_EQ(left.robots[0].jointStart[joint(std::string("L") + pair + "_J" + number)],
                left.robots[0].jointStart[joint(std::string("R") + pair + "_J" + number)]);
}

TEST(KickStart, RefusesASceneThatItCannotUse) {
  const auto kick = host().controller("kick");
  Scene scene;
  EXPECT_THROW(kick->arrange(scene, {}), InputError);
  scene = kickScene({});
  EXPECT_THROW(kick->arrange(scene, {{"distance_m", 2}}), InputError);
  scene.balls.clear();
  EXPECT_THROW(kick->arrange(scene, {}), InputError);
  scene = kickScene({});
  scene.robots[0].model.joints[joint("LF_J2")].name = "other";
  EXPECT_THROW(kick->arrange(scene, {}), InputError);
}

TEST(KickReach, AFrontPawCanTouchTheBallWithinTheGenotype) {
  // The body may lunge: by the length by which the rear paws can be put further behind, and down to lying. The ball's
  // centre must come within foot radius + ball radius of the foot.
  const auto genotype = host().controller("kick")->genotype();
  const auto rangeOf = [&](const std::string& name) { return *find(genotype, "release_" + name + "_rad"); };
  for (const double bearing : {-0.6, 0.0, 0.6}) {
    const Scene scene = kickScene({{"distance_m", 0.18}, {"bearing_rad", bearing}});
    const Eigen::Vector3d ball(scene.balls[0].position_m[0], scene.balls[0].position_m[1], scene.balls[0].radius_m);
    double nearest = HUGE_VAL;
    for (const std::string leg : {"LF", "RF"})
      for (int a = 0; a <= 20; ++a)
        for (int b = 0; b <= 20; ++b)
          for (int c = 0; c <= 20; ++c) {
            auto positions = scene.robots[0].jointStart;
            const int share[] = {a, b, c};
            for (int n = 0; n < 3; ++n) {
              const std::string name = leg + "_J" + std::to_string(n + 1);
              const Parameter range = rangeOf(name);
              positions[joint(name)] = range.minimum + (range.maximum - range.minimum) * share[n] / 20;
            }
            Eigen::Isometry3d lunge = scene.robots[0].start;
            lunge.translation() += Eigen::Vector3d(0.04, 0, -0.04);
            const auto poses = forwardKinematics(dog(), lunge, positions);
            for (const Shape& shape : dog().links[joint(leg + "_J3") + 1].shapes)
              if (shape.kind == Shape::Kind::sphere)
                nearest = std::min(nearest, (poses[joint(leg + "_J3") + 1] * shape.pose.translation() - ball).norm() -
                                                shape.size_m.x() - scene.balls[0].radius_m);
          }
    EXPECT_LT(nearest, 0) << bearing;
  }
}

TEST(KickGenotype, HasTheTwentyFiveParametersOfThePaper) {
  const auto genotype = host().controller("kick")->genotype();
  ASSERT_EQ(25u, genotype.size());
  for (const Parameter& parameter : genotype) EXPECT_NO_THROW(check(parameter, parameter.byDefault, parameter.name));
  EXPECT_TRUE(genotype[24].integer);
  // Angles stay within the software limits of the robot's file.
  for (std::size_t i = 0; i < 24; ++i) {
    const std::string name = genotype[i].name.substr(genotype[i].name.find('_') + 1, 5);
    const Joint& limits = dog().joints[joint(name)];
    EXPECT_GE(genotype[i].minimum, limits.lower) << name;
    EXPECT_LE(genotype[i].maximum, limits.upper) << name;
  }
}

/// A motion whose joint LF_J1 is at `accumulation`, then `release`, everything else as it stands.
struct Kicked {
  Scene scene = kickScene({});
  std::unique_ptr<Motion> motion;
  explicit Kicked(double accumulation, double release, double points) {
    std::vector<double> parameters;
    for (const Parameter& parameter : host().controller("kick")->genotype()) parameters.push_back(parameter.byDefault);
    parameters[0] = accumulation;
    parameters[12] = release;
    parameters[24] = points;
    motion = host().controller("kick")->begin(scene, {{"accumulate_s", 0.4}, {"hold_s", 0.08}, {"return_s", 0.8}},
                                              parameters);
  }
  /// Command of a joint in the control period that begins at period `frame`.
  double command(int frame, const std::string& name = "LF_J1") const {
    std::vector<JointInput> inputs(dog().joints.size());
    motion->command(frame * 0.008, {}, inputs);
    return inputs[joint(name)].command;
  }
};

TEST(KickMotion, RunsThroughItsFourPhases) {
  const double stance = kickScene({}).robots[0].jointStart[joint("LF_J1")];
  const Kicked kick(1.0, 0.5, 5);
  // 50 periods to the accumulation, 10 there, 5 to the release, 100 back.
  EXPECT_DOUBLE_EQ(stance + (1.0 - stance) / 50, kick.command(0));
  EXPECT_DOUBLE_EQ(stance + (1.0 - stance) / 2, kick.command(24));
  for (int frame = 49; frame < 60; ++frame) EXPECT_EQ(1.0, kick.command(frame));
  EXPECT_DOUBLE_EQ(0.9, kick.command(60));
  EXPECT_DOUBLE_EQ(0.7, kick.command(62));
  EXPECT_EQ(0.5, kick.command(64));
  EXPECT_DOUBLE_EQ(0.5 + (stance - 0.5) / 2, kick.command(114));
  EXPECT_EQ(stance, kick.command(164));
  EXPECT_EQ(stance, kick.command(1000));
  EXPECT_DOUBLE_EQ(165 * 0.008, kick.motion->duration());
}

TEST(KickMotion, FewerPointsKickFaster) {
  EXPECT_DOUBLE_EQ(0.75, Kicked(1.0, 0.5, 2).command(60));
  EXPECT_DOUBLE_EQ(0.975, Kicked(1.0, 0.5, 20).command(60));
}

TEST(KickMotion, HeadAndTailKeepStill) {
  const Kicked kick(1.0, 0.5, 5);
  for (const char* name : {"NECK_TILT", "HEAD_PAN", "HEAD_TILT"})
    for (int frame = 0; frame < 200; frame += 7) EXPECT_EQ(0, kick.command(frame, name)) << name;
  for (std::size_t j = 0; j < dog().joints.size(); ++j) {
    const Joint& limits = dog().joints[j];
    for (int frame = 0; frame < 200; frame += 7) {
      EXPECT_GE(kick.command(frame, limits.name), limits.lower) << limits.name;
      EXPECT_LE(kick.command(frame, limits.name), limits.upper) << limits.name;
    }
  }
}

}  // namespace
}  // namespace btr
