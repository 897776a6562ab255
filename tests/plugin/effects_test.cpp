// What every effect promises, checked over all effect plugins: sane declarations, silent at neutral, finite at the
// bounds, repeatable, and no energy from what calls itself dissipative.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <set>

#include "core/sim/tracked_frame.h"
#include "tests/plugin/built_plugins.h"

namespace btr {
namespace {

using test::host;

class Effects : public testing::TestWithParam<std::string> {
 protected:
  std::shared_ptr<const Effect> effect = host().effect(GetParam());
  std::vector<Parameter> parameters = effect->parameters();

  std::vector<double> neutral() const {
    std::vector<double> values;
    for (const Parameter& parameter : parameters) values.push_back(parameter.neutral.value_or(parameter.byDefault));
    return values;
  }

  /// All corners of the parameters' box, and the defaults.
  std::vector<std::vector<double>> corners() const {
    std::vector<std::vector<double>> corners(1);
    for (const Parameter& parameter : parameters) corners[0].push_back(parameter.byDefault);
    for (std::size_t corner = 0; corner < std::size_t{1} << parameters.size(); ++corner) {
      std::vector<double> values;
      for (std::size_t i = 0; i < parameters.size(); ++i)
        values.push_back(corner >> i & 1 ? parameters[i].maximum : parameters[i].minimum);
      corners.push_back(values);
    }
    return corners;
  }

  std::vector<double> freshState() const {
    return std::vector<double>(static_cast<std::size_t>(effect->stateSize()), 0.0);
  }
};

/// A joint's life of 400 steps of 1 ms: swinging, reversing, at rest, fast, commands held for 8 ms.
std::vector<JointState> life(std::uint64_t seed) {
  Random random(seed);
  std::vector<JointState> states;
  double command = 0;
  for (int step = 0; step < 400; ++step) {
    if (step % 8 == 0) command = random.uniform(-2, 2);
    JointState state;
    state.time = step * 1e-3;
    state.position = random.uniform(-3, 3);
    state.rate = step % 5 == 0 ? 0 : random.normal() * 10;
    state.command = command;
    state.drive = random.uniform(-1, 1);
    state.limit = 1.2;
    state.load = random.uniform(-0.5, 0.5);
    state.allDrives = std::abs(state.drive) + random.uniform(0, 2);
    states.push_back(state);
  }
  return states;
}

BallState ballAt(Random& random) {
  BallState ball;
  ball.time = random.uniform();
  ball.position_m = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0, 1)};
  ball.velocity_m_s = {random.normal(), random.normal(), random.normal()};
  ball.spin_rad_s = {random.normal() * 20, random.normal() * 20, random.normal() * 20};
  ball.radius_m = 0.0425;
  ball.mass_kg = 0.055;
  ball.onFloor = random.chance(0.5);
  return ball;
}

/// Everything that the hooks answer over that life, in order.
std::vector<double> answers(const Effect& effect, const std::vector<double>& values, std::vector<double> state) {
  std::vector<double> answers;
  for (const JointState& joint : life(7)) {
    const CommandAround followed = effect.command({joint.command, joint.command}, joint, values, state, 1e-3);
    answers.insert(answers.end(), {followed.before, followed.after});
    answers.push_back(effect.driveTorque(joint.drive, joint, values, state, 1e-3));
    answers.push_back(effect.torque(joint, values));
    answers.push_back(effect.frictionLimit(joint, values));
    answers.push_back(effect.damping(joint, values));
    answers.push_back(effect.measured(joint.position, joint, values, state, 8e-3));
  }
  Random random(8);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d force = effect.ballForce(ballAt(random), values);
    answers.insert(answers.end(), {force.x(), force.y(), force.z()});
  }
  answers.insert(answers.end(), state.begin(), state.end());
  return answers;
}

/// A scene with one of everything that an effect can sit on.
Scene smallScene() {
  Scene scene;
  scene.floor = FloorSpec{};
  scene.balls.push_back({.name = "ball"});
  SceneRobot robot;
  robot.name = "leg";
  for (const char* name : {"base", "lower"}) {
    Link link;
    link.name = name;
    link.inertial = {0.2, {0.01, 0, -0.05}, Eigen::Vector3d(2e-4, 2e-4, 3e-5).asDiagonal()};
    robot.model.links.push_back(link);
  }
  Joint joint;
  joint.name = "knee";
  robot.model.joints.push_back(joint);
  robot.jointStart = robot.jointStartRate = {0};
  robot.drives.resize(1);
  scene.robots.push_back(robot);
  return scene;
}

std::string placeOf(const Effect& effect) { return test::placeFor(effect.place(), "leg.knee", "leg.lower"); }

/// Every number of a scene that an effect may change.
std::vector<double> numbersOf(const Scene& scene) {
  std::vector<double> numbers(scene.gravity_m_s2.begin(), scene.gravity_m_s2.end());
  const FloorSpec& floor = *scene.floor;
  numbers.insert(numbers.end(),
                 {floor.friction, floor.restitution, floor.slip1_m_s_n, floor.slip2_m_s_n, floor.stiffness_n_m,
                  floor.damping_n_s_m, floor.slipXY_m_s_n, floor.bounce, floor.bounceLoss_s_m});
  const BallSpec& ball = scene.balls[0];
  numbers.insert(numbers.end(), {ball.radius_m, ball.mass_kg, ball.inertiaFactor, ball.rollingDeceleration_m_s2,
                                 ball.restitution, ball.position_m[2]});
  numbers.insert(numbers.end(), ball.directedRolling_m_s2.begin(), ball.directedRolling_m_s2.end());
  for (const Link& link : scene.robots[0].model.links) {
    numbers.push_back(link.inertial.mass_kg);
    const Eigen::Vector3d& centre = link.inertial.centreOfMass_m;
    numbers.insert(numbers.end(), centre.begin(), centre.end());
    const Eigen::Matrix3d& inertia = link.inertial.inertia_kg_m2;
    numbers.insert(numbers.end(), inertia.data(), inertia.data() + 9);
  }
  const Drive& drive = scene.robots[0].drives[0];
  numbers.insert(
      numbers.end(),
      {drive.p, drive.i, drive.d, drive.maxTorque, drive.firmwareGain_v_rad, drive.supply_v, drive.torqueConstant_nm_a,
       drive.resistance_ohm, drive.maxDuty, drive.rotorInertia_kg_m2, drive.coulombFriction, drive.viscousFriction,
       drive.offBraking, drive.gearCompliance, drive.gearDamping, drive.gearPlay, drive.gearDrag});
  const Eigen::Matrix4d frame = trackedFrame(scene).matrix();
  numbers.insert(numbers.end(), frame.data(), frame.data() + frame.size());
  return numbers;
}

TEST_P(Effects, DeclareNamesUnitsAndBoundsThatHoldDefaultAndNeutral) {
  std::set<std::string> names;
  bool canBeSilent = false;
  ASSERT_FALSE(parameters.empty());
  for (const Parameter& parameter : parameters) {
    EXPECT_FALSE(parameter.name.empty());
    EXPECT_EQ(std::string::npos, parameter.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"));
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name << " twice";
    EXPECT_FALSE(parameter.meaning.empty()) << parameter.name;
    EXPECT_LT(parameter.minimum, parameter.maximum) << parameter.name;
    EXPECT_NO_THROW(check(parameter, parameter.byDefault, parameter.name));
    if (parameter.neutral) {
      EXPECT_NO_THROW(check(parameter, *parameter.neutral, parameter.name));
    }
    canBeSilent = canBeSilent || parameter.neutral.has_value();
  }
  EXPECT_TRUE(canBeSilent);
}

TEST_P(Effects, AreSilentAtTheirNeutralValues) {
  const auto values = neutral();
  auto state = freshState();
  for (const JointState& joint : life(3)) {
    EXPECT_EQ(joint.command, effect->command({joint.command, joint.command}, joint, values, state, 1e-3).mean());
    EXPECT_EQ(joint.drive, effect->driveTorque(joint.drive, joint, values, state, 1e-3));
    EXPECT_EQ(0, effect->torque(joint, values));
    EXPECT_EQ(0, effect->frictionLimit(joint, values));
    EXPECT_EQ(0, effect->damping(joint, values));
    EXPECT_EQ(joint.position, effect->measured(joint.position, joint, values, state, 8e-3));
  }
  Random random(4);
  for (int i = 0; i < 200; ++i) EXPECT_EQ(Eigen::Vector3d::Zero(), effect->ballForce(ballAt(random), values));
  Scene scene = smallScene();
  effect->changeScene(scene, placeOf(*effect), values);
  EXPECT_EQ(numbersOf(smallScene()), numbersOf(scene));
}

TEST_P(Effects, DoSomethingAtEachEndOfTheirRange) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].neutral) continue;
    for (const double end : {parameters[i].minimum, parameters[i].maximum}) {
      if (end == *parameters[i].neutral) continue;
      auto values = neutral();
      values[i] = end;
      Scene scene = smallScene();
      scene.effects.push_back({effect, GetParam(), placeOf(*effect), values});
      effect->changeScene(scene, placeOf(*effect), values);
      EXPECT_TRUE(answers(*effect, values, freshState()) != answers(*effect, neutral(), freshState()) ||
                  numbersOf(scene) != numbersOf(smallScene()))
          << parameters[i].name << " = " << end;
    }
  }
}

TEST_P(Effects, StayFiniteAtTheirBounds) {
  for (const auto& values : corners()) {
    for (const double answer : answers(*effect, values, freshState())) ASSERT_TRUE(std::isfinite(answer));
    Scene scene = smallScene();
    effect->changeScene(scene, placeOf(*effect), values);
    for (const double number : numbersOf(scene)) ASSERT_TRUE(std::isfinite(number));
    for (const Link& link : scene.robots[0].model.links) {
      EXPECT_GT(link.inertial.mass_kg, 0);
      const Eigen::Vector3d inertia =
          Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(link.inertial.inertia_kg_m2).eigenvalues();
      EXPECT_GT(inertia.x(), 0);
      EXPECT_LE(inertia.z(), inertia.x() + inertia.y() + 1e-12);
    }
  }
}

TEST_P(Effects, AnswerTheSameTwice) {
  for (const auto& values : corners())
    EXPECT_EQ(answers(*effect, values, freshState()), answers(*effect, values, freshState()));
}

TEST_P(Effects, NeverGiveNegativeFrictionOrDamping) {
  for (const auto& values : corners())
    for (const JointState& joint : life(5)) {
      EXPECT_GE(effect->frictionLimit(joint, values), 0);
      EXPECT_GE(effect->damping(joint, values), 0);
    }
}

TEST_P(Effects, LeaveTheDriveAloneUnlessTheySaySo) {
  bool changed = false;
  for (const auto& values : corners()) {
    auto state = freshState();
    for (JointState joint : life(4)) {
      joint.damping = 0.03;
      changed = changed || effect->driveTorque(joint.drive, joint, values, state, 1e-3) != joint.drive;
    }
  }
  EXPECT_EQ(effect->changesDrive(), changed);
}

TEST_P(Effects, AddNoEnergyIfTheySaySo) {
  if (!effect->dissipative()) return;
  for (const auto& values : corners()) {
    auto state = freshState();
    for (const JointState& joint : life(6)) {
      EXPECT_LE(effect->torque(joint, values) * joint.rate, 0);
      // The drive's power may only fall, its command not change.
      EXPECT_EQ(joint.command, effect->command({joint.command, joint.command}, joint, values, state, 1e-3).mean());
      EXPECT_LE(std::abs(effect->driveTorque(joint.drive, joint, values, state, 1e-3)), std::abs(joint.drive));
    }
    Random random(9);
    for (int i = 0; i < 200; ++i) {
      const BallState ball = ballAt(random);
      EXPECT_LE(effect->ballForce(ball, values).dot(ball.velocity_m_s), 0);
    }
    Scene scene = smallScene();
    effect->changeScene(scene, placeOf(*effect), values);
    EXPECT_EQ(smallScene().gravity_m_s2, scene.gravity_m_s2);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Effects, testing::ValuesIn(test::effectsWithASize()),
                         [](const auto& name) { return name.param; });

}  // namespace
}  // namespace btr
