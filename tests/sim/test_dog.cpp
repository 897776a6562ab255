// The ERS-7 from its file: standing, kicking left and right, many workers' determinism.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/model/kinematics.h"
#include "core/sim/bench/bench.h"
#include "core/sim/trial.h"
#include "core/spec/random.h"
#include "tests/plugin/built_plugins.h"
#include "tests/refusal.h"
#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

Scene dogScene(double step, const Values& task = {}) {
  static const SceneSpec spec = loadScene(SOURCE_DIR "/resources/scenes/kick.json");
  static const ModelSet models = loadModels(spec);
  SceneSpec stepped = spec;
  stepped.step_s = step;
  Scene scene = makeScene(stepped, models, {}, host().effectFactory());
  host().controller("kick")->arrange(scene, task);
  return scene;
}

std::vector<std::vector<JointInput>> hold(const Scene& scene) {
  std::vector<std::vector<JointInput>> inputs(1);
  for (const double position : scene.robots[0].jointStart) inputs[0].push_back({position});
  return inputs;
}

TEST(Dog, StandsOnFourFeetAndTheFloorCarriesItsWeight) {
  for (const double step : {0.001, 0.008}) {
    Scene scene = dogScene(step);
    scene.balls.clear();
    World world(scene, 1);
    world.measureForces();
    world.advance(hold(scene), 4);
    const auto readings = world.robot(0);
    const double weight = massProperties(scene.robots[0].model, scene.robots[0].jointStart).mass_kg * g;
    EXPECT_NEAR(weight, world.floorForce_n().z(), 1e-6 * weight);
    EXPECT_NEAR(0, world.floorForce_n().head<2>().norm(), 1e-6 * weight);
    EXPECT_NEAR(g, readings.accelerometer_m_s2.norm(), 1e-6);
    EXPECT_LT(readings.baseVelocity_m_s.norm(), 1e-6);
    EXPECT_GT(readings.base.linear()(2, 2), 0.99);
    for (std::size_t link = 0; link < readings.contact.size(); ++link) {
      const std::string& name = scene.robots[0].model.links[link].name;
      EXPECT_EQ(name.find("LOWER") != std::string::npos, readings.contact[link] != 0) << name;
    }
  }
}

TEST(Dog, AtRestItGainsNoEnergy) {
  Scene scene = dogScene(0.008);
  World world(scene, 1);
  world.advance(hold(scene), 4);
  const double before = world.energy();
  world.advance(hold(scene), 8);
  EXPECT_NEAR(before, world.energy(), 1e-6);
}

TEST(Dog, IsBuiltOfFewBodiesAndItsLinksAreWhereKinematicsPutsThem) {
  const Scene scene = dogScene(0.001);
  World world(scene, 1);
  const auto expected = forwardKinematics(scene.robots[0].model, scene.robots[0].start, scene.robots[0].jointStart);
  const auto poses = world.linkPoses(0);
  for (std::size_t link = 0; link < poses.size(); ++link)
    EXPECT_LT((poses[link].matrix() - expected[link].matrix()).norm(), 1e-9) << scene.robots[0].model.links[link].name;
}

// A kick's parameters with left and right legs exchanged: LF, RF, LR, RR of three joints each, twice, and the points.
std::vector<double> mirrored(std::vector<double> p) {
  for (const std::size_t phase : {0, 12})
    for (const std::size_t pair : {0, 6})
      for (std::size_t i = 0; i < 3; ++i) std::swap(p[phase + pair + i], p[phase + pair + 3 + i]);
  return p;
}

std::vector<double> someKick(std::uint64_t seed, double strength) {
  Random random(seed);
  std::vector<double> parameters;
  for (const auto& parameter : host().controller("kick")->genotype()) {
    const double value =
        parameter.byDefault + strength * (random.uniform() - 0.5) * (parameter.maximum - parameter.minimum);
    parameters.push_back(
        std::clamp(parameter.integer ? std::round(value) : value, parameter.minimum, parameter.maximum));
  }
  return parameters;
}

TEST(Dog, LeftAndRightKicksAreMirrorImages) {
  const auto kick = host().controller("kick");
  int moved = 0;
  for (const std::uint64_t seed : {2, 3, 10, 12, 15, 20}) {
    const auto parameters = someKick(seed, 1);
    const TrialOptions options{.recordTrace = true};
    const auto left = runTrial(dogScene(0.001, {{"bearing_rad", 0.4}}), *kick, {}, parameters, 1, options);
    const auto right = runTrial(dogScene(0.001, {{"bearing_rad", -0.4}}), *kick, {}, mirrored(parameters), 1, options);
    ASSERT_EQ(left.trace.rows(), right.trace.rows());
    const auto x = static_cast<std::size_t>(left.trace.column("ball.x_m"));
    double worst = 0;
    for (std::size_t row = 0; row < left.trace.rows(); ++row) {
      worst = std::max(worst, std::abs(left.trace.at(row, x) - right.trace.at(row, x)));
      worst = std::max(worst, std::abs(left.trace.at(row, x + 1) + right.trace.at(row, x + 1)));
    }
    // The solver's rounding (1e-16) grows through the hits; 1e-13 is what it reached.
    EXPECT_LT(worst, 1e-10) << seed;
    moved += (left.balls[0].rest_m - left.balls[0].start_m).norm() > 0.02;
  }
  EXPECT_GE(moved, 3);
}

TEST(Dog, ATrialRepeatsBitForBit) {
  const auto kick = host().controller("kick");
  const Scene scene = dogScene(0.002);
  const auto parameters = someKick(3, 1);
  const TrialOptions options{.recordTrace = true};
  const auto first = runTrial(scene, *kick, {}, parameters, 9, options);
  runTrial(scene, *kick, {}, someKick(4, 1), 10, options);
  EXPECT_EQ(first.trace.sha256(), runTrial(scene, *kick, {}, parameters, 9, options).trace.sha256());
}

/// Ways of the ten learned kicks of `btr bench` at one step [m].
std::vector<double> learnedWays(const BenchTask& task, double step) {
  Scene scene = task.scene;
  scene.step_s = step;
  scene.nearSubsteps = 1;
  std::vector<double> ways;
  for (const auto& parameters : task.parameters) {
    const auto result = runTrial(scene, *task.controller, task.settings, parameters, 1);
    ways.push_back((result.balls[0].rest_m - result.balls[0].start_m).head<2>().norm());
  }
  return ways;
}

// Legs that press the ball to the floor while they kick it: with isotropic friction the way is a matter of the motion,
// not of the step, and a step half as large is about half as far off.
TEST(Dog, AKicksWayConvergesWithTheStep) {
  const auto kick = host().controller("kick");
  const SceneSpec spec = loadScene(SOURCE_DIR "/resources/scenes/kick.json");
  ASSERT_EQ(spec.slidingFriction, SlidingFriction::isotropic);
  const BenchTask task = kickTask(spec, loadModels(spec), *kick);
  const auto converged = learnedWays(task, 0.000125);
  const double coarse = deviationOf(learnedWays(task, 0.001), converged).rms;
  const double fine = deviationOf(learnedWays(task, 0.0005), converged).rms;
  EXPECT_LT(coarse, 0.1);
  EXPECT_LT(fine, 0.7 * coarse);
}

// Head, mouth and tail of this scene are locked: bodies where they begin, and nothing of them can be driven or read.
TEST(Dog, LockedJointsAreRigidWhereTheyBegin) {
  const SceneSpec locked = loadScene(SOURCE_DIR "/resources/scenes/kick.json");
  SceneSpec free = locked;
  free.robots[0].servos.clear();
  const ModelSet models = loadModels(locked);
  const Scene scene = makeScene(locked, models, {}, host().effectFactory());
  const Scene other = makeScene(free, models, {}, host().effectFactory());
  World world(scene, 1);
  const auto poses = world.linkPoses(0);
  const auto expected = forwardKinematics(other.robots[0].model, other.robots[0].start, other.robots[0].jointStart);
  for (std::size_t link = 0; link < poses.size(); ++link)
    EXPECT_TRUE(poses[link].isApprox(expected[link], 1e-9)) << scene.robots[0].model.links[link].name;
  const auto channels = world.channels();
  for (const char* joint : {"NECK_TILT", "HEAD_PAN", "HEAD_TILT", "MOUTH", "TAIL_TILT", "TAIL_PAN"})
    EXPECT_EQ(std::find(channels.begin(), channels.end(), std::string("ers7.") + joint + ".position_rad"),
              channels.end());
  world.advance(hold(scene), 0.4);
  const auto jaw = static_cast<std::size_t>(scene.robots[0].model.findJoint("MOUTH")) + 1;
  const auto head = static_cast<std::size_t>(scene.robots[0].model.joints[jaw - 1].parentLink);
  const auto later = world.linkPoses(0);
  EXPECT_TRUE((later[head].inverse() * later[jaw]).isApprox(poses[head].inverse() * poses[jaw], 1e-9));
  EXPECT_NEAR(massProperties(other.robots[0].model, other.robots[0].jointStart).mass_kg,
              massProperties(scene.robots[0].model, scene.robots[0].jointStart).mass_kg, 1e-12);
}

TEST(Dog, ALockedJointHasNoNumbersAndNoVelocity) {
  const SceneSpec spec = loadScene(SOURCE_DIR "/resources/scenes/kick.json");
  const ModelSet models = loadModels(spec);
  const auto said = [&](const SceneSpec& scene) {
    return refusal([&] { makeScene(scene, models, {}, host().effectFactory()); });
  };
  SceneSpec wrong = spec;
  wrong.robots[0].servos["MOUTH"].numbers["p"] = 3;
  EXPECT_THAT(said(wrong), testing::HasSubstr("robots.ers7.servos.MOUTH"));
  wrong = spec;
  wrong.robots[0].jointRate["TAIL_PAN"] = 1;
  EXPECT_THAT(said(wrong), testing::HasSubstr("joint_velocity.TAIL_PAN"));
}

TEST(Dog, AMeshAsCollisionModelStandsToo) {
  Scene scene = dogScene(0.002);
  scene.robots[0].collision = "mesh";
  scene.balls.clear();
  World world(scene, 1);
  world.advance(hold(scene), 4);
  EXPECT_GT(world.robot(0).base.linear()(2, 2), 0.99);
  EXPECT_LT(world.robot(0).baseVelocity_m_s.norm(), 1e-3);
  EXPECT_NEAR(scene.robots[0].start.translation().z(), world.robot(0).base.translation().z(), 0.015);
}

}  // namespace
}  // namespace btr::test
