// Trials: how they end, that they repeat, and what effects do on the way of a control step.
#include <gtest/gtest.h>

#include <cmath>
#include <concepts>

#include "core/sim/drive_law.h"
#include "core/sim/trial.h"
#include "core/spec/error.h"
#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

using Eigen::Vector3d;

/// A motion that commands `amplitude·sin(frequency·t)` to all joints for `duration`.
class Wave final : public Controller {
 public:
  Wave(double amplitude, double frequency, double duration)
      : amplitude_(amplitude), frequency_(frequency), duration_(duration) {}
  std::vector<Parameter> genotype() const override { return {}; }
  std::vector<Parameter> settings() const override { return {}; }
  void arrange(Scene&, const Values&) const override {}
  std::unique_ptr<Motion> begin(const Scene&, const Values&, std::span<const double>) const override {
    struct WaveMotion final : Motion {
      Wave wave;
      explicit WaveMotion(const Wave& of) : wave(of) {}
      void command(double time, const RobotReadings&, std::span<JointInput> inputs) override {
        for (auto& input : inputs) input.command = wave.amplitude_ * std::sin(wave.frequency_ * time);
      }
      double duration() const override { return wave.duration_; }
    };
    return std::make_unique<WaveMotion>(*this);
  }

 private:
  double amplitude_, frequency_, duration_;
};

// A bar on a stand that hits a ball.
Scene batScene(double step) {
  RobotModel model;
  model.name = "bat";
  model.links = {link("stand", 1, {0, 0, 0}, {1, 1, 1}),
                 link("bar", 0.2, {0, 0, -0.1}, {1e-3, 1e-3, 1e-4}, {box({0.03, 0.05, 0.2}, {0, 0, -0.1})})};
  model.joints = {joint("swing", 0, {0, -1, 0})};
  Scene scene = sceneOf(robot(model, false, {.p = 8, .d = 0.05, .maxTorque = 1.5}), step);
  scene.robots[0].start.translation().z() = 0.21;
  scene.floor = FloorSpec{};
  BallSpec ball;
  ball.name = "ball";
  ball.rollingDeceleration_m_s2 = 0.4;
  ball.position_m = {0.08, 0.003, ball.radius_m};
  scene.balls = {ball};
  return scene;
}

TEST(Trial, SameSeedSameBitsWhateverRanBefore) {
  const Scene scene = batScene(0.001);
  const Wave one(1.2, 12, 0.5), other(0.7, 9, 0.4);
  const TrialOptions options{.recordTrace = true};
  const auto first = runTrial(scene, one, {}, {}, 5, options);
  const auto between = runTrial(scene, other, {}, {}, 6, options);
  const auto again = runTrial(scene, one, {}, {}, 5, options);
  EXPECT_EQ(first.trace.sha256(), again.trace.sha256());
  EXPECT_NE(first.trace.sha256(), between.trace.sha256());
  EXPECT_EQ(first.balls[0].rest_m, again.balls[0].rest_m);
  EXPECT_EQ(TrialResult::Outcome::finished, first.outcome);
  EXPECT_GT(first.balls[0].rest_m.x(), 0.3);
}

TEST(Trial, ClosedFormOfTheRollIsWhatSimulatingToRestGives) {
  for (const double amplitude : {0.6, 0.9, 1.3}) {
    const Scene scene = batScene(0.001);
    const Wave motion(amplitude, 12, 0.5);
    const auto closed = runTrial(scene, motion, {}, {}, 5);
    const auto simulated = runTrial(scene, motion, {}, {}, 5, {.closedFormRoll = false});
    const double way = (simulated.balls[0].rest_m - simulated.balls[0].start_m).norm();
    ASSERT_GT(way, 0.2);
    EXPECT_LT((closed.balls[0].rest_m - simulated.balls[0].rest_m).norm(), 0.01 * way);
    EXPECT_LT(closed.simulated_s, simulated.simulated_s);
  }
}

TEST(Trial, WithoutTheBallMovingEndsWithTheMotion) {
  Scene scene = batScene(0.001);
  scene.balls[0].position_m[0] = 2;
  const auto result = runTrial(scene, Wave(0.5, 12, 0.48), {}, {}, 5);
  EXPECT_EQ(TrialResult::Outcome::finished, result.outcome);
  EXPECT_NEAR(0.48, result.simulated_s, 0.008);
  EXPECT_NEAR(0, (result.balls[0].rest_m - result.balls[0].start_m).head<2>().norm(), 1e-6);
}

TEST(Trial, ALongMotionTimesOutAndKeepsItsStates) {
  const auto result = runTrial(batScene(0.002), Wave(0.5, 12, 30), {}, {}, 5, {.maximum_s = 0.4, .recordTrace = true});
  EXPECT_EQ(TrialResult::Outcome::timedOut, result.outcome);
  EXPECT_FALSE(result.detail.empty());
  EXPECT_EQ(51u, result.trace.rows());
  EXPECT_NEAR(0.4, result.trace.at(50, 0), 1e-12);
}

TEST(Trial, AnExplosionIsAnOutcomeThatSaysWhatExploded) {
  Scene scene = batScene(0.001);
  scene.robots[0].drives[0] = {.kind = Drive::Kind::torque};
  const auto result = runTrial(scene, Wave(5e4, 20, 2), {}, {}, 5, {.recordTrace = true});
  EXPECT_EQ(TrialResult::Outcome::exploded, result.outcome);
  EXPECT_NE(std::string::npos, result.detail.find("bat.bar")) << result.detail;
  EXPECT_GT(result.trace.rows(), 1u);
  // The process and the next trial are unharmed.
  EXPECT_EQ(TrialResult::Outcome::finished, runTrial(batScene(0.001), Wave(0.5, 12, 0.4), {}, {}, 5).outcome);
}

TEST(Trial, ACommandThatIsNotANumberExplodesInsteadOfEndingTheProcess) {
  for (const Drive::Kind kind : {Drive::Kind::servo, Drive::Kind::torque}) {
    Scene scene = batScene(0.001);
    scene.robots[0].drives[0].kind = kind;
    scene.robots[0].drives[0].maxTorque = 1e9;
    const auto result = runTrial(scene, Wave(NAN, 20, 1), {}, {}, 5);
    EXPECT_EQ(TrialResult::Outcome::exploded, result.outcome);
    EXPECT_EQ(TrialResult::Outcome::finished, runTrial(batScene(0.001), Wave(0.5, 12, 0.4), {}, {}, 5).outcome);
  }
}

TEST(World, OnlyOneMayExistInAProcess) {
  const Scene scene = batScene(0.001);
  {
    World world(scene, 1);
    EXPECT_THROW(World(scene, 1), std::logic_error);
  }
  EXPECT_NO_THROW(World(scene, 1));
}

// ---- effects: each hook in its place ------------------------------------------------------------------------------

struct TestEffect : Effect {
  Place where = Place::joint;
  std::vector<Parameter> parameters() const override { return {{"value", "", "size", -10, 10, 0}}; }
  Place place() const override { return where; }
};

SceneEffect placed(std::shared_ptr<const Effect> effect, const std::string& at,
                   std::convertible_to<double> auto... values) {
  return {std::move(effect), "test", at, {static_cast<double>(values)...}};
}

/// Command, drive torque and measurement are each changed; the state counts the calls.
struct Chain final : TestEffect {
  int stateSize() const override { return 2; }
  CommandAround command(CommandAround command, const JointState&, std::span<const double> v, std::span<double> state,
                        double) const override {
    state[0] += 1;
    return {command.before + v[0], command.after + v[0]};
  }
  bool changesDrive() const override { return true; }
  double driveTorque(double torque, const JointState& joint, std::span<const double>, std::span<double>,
                     double) const override {
    lastCommand = joint.command;
    return torque / 2;
  }
  double measured(double position, const JointState&, std::span<const double>, std::span<double> state,
                  double dt) const override {
    lastDt = dt;
    calls = state[0];
    return position + 100;
  }
  mutable double lastCommand = 0, lastDt = -1, calls = 0;
};

TEST(Effects, AreCalledFromCommandToSensor) {
  Scene scene = sceneOf(robot(pendulumModel(0.5, 0.2, 0.001), false, {.p = 20, .d = 0.2, .maxTorque = 2}), 0.002);
  const auto chain = std::make_shared<Chain>();
  scene.effects = {placed(chain, "rig.hinge", 0.25)};
  World world(scene, 1);
  EXPECT_EQ(0, chain->lastDt) << "a sample before the first step";
  world.advance(commands(scene, 0.3), 16);
  EXPECT_NEAR(0.55, chain->lastCommand, 1e-12);
  EXPECT_EQ(8000, chain->calls) << "once a step";
  EXPECT_EQ(16, chain->lastDt) << "once a sample";
  // Half the torque: at rest p·(0.55 − q)/2 = m·g·l·sin(q).
  const auto readings = world.robot(0);
  const double q = readings.position[0] - 100;
  EXPECT_NEAR(0.5 * g * 0.2 * std::sin(q), 20 * (0.55 - q) / 2, 1e-6);
  EXPECT_NEAR(20 * (0.55 - q) / 2, readings.torque[0], 1e-6);
}

struct Limit final : TestEffect {
  bool dissipative() const override { return true; }
  double frictionLimit(const JointState&, std::span<const double> v) const override { return v[0]; }
};

struct Yielding final : TestEffect {
  bool dissipative() const override { return true; }
  double frictionLimit(const JointState&, std::span<const double> v) const override { return v[0]; }
  double frictionTransition(const JointState&, std::span<const double> v) const override { return v[1]; }
};

/// A wheel that starts at `rate`; with a shape (there is nothing to touch) it moves in ODE.
Scene rollingWheel(double inertia, double rate, double step, bool inOde) {
  RobotModel model = wheelModel(inertia);
  if (inOde) model.links[1].shapes = {sphere(0.01)};
  Scene scene = weightless(sceneOf(robot(model, false), step));
  scene.robots[0].jointStartRate = {rate};
  return scene;
}

// Below its transition speed friction is viscous: ω = ω0·exp(−T·t/(I·ωs)). Above it, it takes T/I of the rate a second.
TEST(Effects, DryFrictionFadesBelowItsTransitionSpeed) {
  const double inertia = 0.0015, torque = 0.02, transition = 2, step = 0.0005, span = 0.1;
  for (const bool inOde : {false, true}) {
    const auto rateAfter = [&](double start) {
      Scene scene = rollingWheel(inertia, start, step, inOde);
      scene.effects = {placed(std::make_shared<Yielding>(), "rig.hinge", torque, transition)};
      World world(scene, 1);
      world.advance(commands(scene, 0), span);
      return world.robot(0).rate[0];
    };
    EXPECT_NEAR(std::exp(-torque * span / (inertia * transition)), rateAfter(1), 2e-3) << inOde;
    EXPECT_NEAR(8 - torque / inertia * span, rateAfter(8), 1e-3) << inOde;
  }
}

// Frictions of one joint are one row of the solver: all of their torque at speed, and below a transition that lies
// between theirs.
TEST(Effects, FrictionsOfOneJointAddUp) {
  DryFriction all{0.01, 0};
  all.add({0.03, 0.4});
  EXPECT_DOUBLE_EQ(all.limit, 0.04);
  EXPECT_DOUBLE_EQ(all.transition, 0.3);
  EXPECT_DOUBLE_EQ(all.softness(), 0.3 / 0.04);
  all.add({0, 5});
  EXPECT_DOUBLE_EQ(all.transition, 0.3);
  EXPECT_EQ(DryFriction{}.softness(), 0);
}

struct Smooth final : TestEffect {
  bool dissipative() const override { return true; }
  double torque(const JointState& joint, std::span<const double> v) const override {
    return -v[0] * std::tanh(joint.rate / 1e-3);
  }
};

TEST(Effects, DryFrictionHoldsWhetherItIsALimitOrASteepTorque) {
  for (const double step : {0.0005, 0.008}) {
    for (const bool limit : {true, false}) {
      Scene scene = weightless(sceneOf(robot(wheelModel(0.0015), false), step));
      scene.robots[0].jointStartRate = {8};
      std::shared_ptr<const Effect> effect;
      if (limit)
        effect = std::make_shared<Limit>();
      else
        effect = std::make_shared<Smooth>();
      scene.effects = {placed(effect, "rig.hinge", 0.02)};
      World world(scene, 1);
      double energy = world.energy();
      for (int i = 0; i < 200; ++i) {
        world.advance(commands(scene, 0), 0.008);
        EXPECT_LE(world.energy(), energy * (1 + 1e-12));
        energy = world.energy();
      }
      EXPECT_NEAR(0.0015 * 64 / 0.04, world.robot(0).position[0], 8 * step + 0.005);
      EXPECT_NEAR(0, world.robot(0).rate[0], 1e-6);
    }
  }
}

struct Spring final : TestEffect {
  double torque(const JointState& joint, std::span<const double> v) const override { return -v[0] * joint.position; }
};

TEST(Effects, ASpringSwingsWithItsPeriodAndAStiffOneStaysStable) {
  const double stiffness = 0.6, inertia = 0.0015;
  Scene scene = weightless(sceneOf(robot(wheelModel(inertia), false), 0.001, 0.001));
  scene.robots[0].jointStart = {0.3};
  scene.effects = {placed(std::make_shared<Spring>(), "rig.hinge", stiffness)};
  const double period = 2 * M_PI / std::sqrt(stiffness / inertia);
  {
    World world(scene, 1);
    const int steps = static_cast<int>(std::lround(10 * period / 0.001));
    for (int i = 0; i < steps; ++i) world.advance(commands(scene, 0), 0.001);
    EXPECT_NEAR(0.3 * std::cos(2 * M_PI * world.time() / period), world.robot(0).position[0], 0.01);
  }
  scene.step_s = scene.controlPeriod_s = 0.008;
  scene.effects[0].values = {10};  // h²k/I = 0.4
  World world(scene, 1);
  for (int i = 0; i < 500; ++i) {
    world.advance(commands(scene, 0), 0.008);
    EXPECT_LE(std::abs(world.robot(0).position[0]), 0.36);
  }
}

struct Push final : TestEffect {
  Push() { where = Place::ball; }
  Vector3d ballForce(const BallState& ball, std::span<const double> v) const override {
    return {v[0] * ball.mass_kg, 0, 0};
  }
};

struct Drag final : TestEffect {
  Drag() { where = Place::ball; }
  bool dissipative() const override { return true; }
  Vector3d ballForce(const BallState& ball, std::span<const double> v) const override {
    return -v[0] * ball.velocity_m_s.norm() * ball.velocity_m_s;
  }
};

TEST(Effects, BallForcesAccelerateAndBrakeBalls) {
  BallSpec ball;
  ball.name = "ball";
  ball.position_m = {0, 0, 3};
  Scene scene = weightless(ballScene(ball, 0.001));
  scene.effects = {placed(std::make_shared<Push>(), "ball", 2)};
  {
    World world(scene, 1);
    world.advance({}, 0.8);
    EXPECT_NEAR(2 * 0.8 * 0.8 / 2, world.ball(0).position_m.x(), 1e-9);
  }
  scene.effects = {placed(std::make_shared<Drag>(), "ball", 0.02)};
  scene.balls[0].velocity_m_s = {6, 0, 0};
  World world(scene, 1);
  world.advance({}, 0.8);
  // m·v' = −c·v²: v = v0/(1 + c·v0·t/m).
  EXPECT_NEAR(6 / (1 + 0.02 * 6 * 0.8 / 0.055), world.ball(0).velocity_m_s.x(), 0.01);
}

TEST(Effects, ATrialWithBallForcesIsSimulatedToItsEndInsteadOfTheClosedForm) {
  Scene scene = batScene(0.001);
  const Wave motion(0.9, 12, 0.5);
  const double plain = runTrial(scene, motion, {}, {}, 5).balls[0].rest_m.x();
  scene.effects = {placed(std::make_shared<Drag>(), "ball", 0.05)};
  const auto braked = runTrial(scene, motion, {}, {}, 5, {.settle_s = 15});
  EXPECT_LT(braked.balls[0].rest_m.x(), plain - 0.05);
  EXPECT_EQ(TrialResult::Outcome::finished, braked.outcome);
}

// ---- traces -----------------------------------------------------------------------------------------------------

TEST(Trace, ColumnsAreNamedAsInRecordings) {
  const auto result = runTrial(batScene(0.001), Wave(0.5, 12, 0.4), {}, {}, 5, {.recordTrace = true});
  for (const char* name : {"time_s", "bat.base.x_m", "bat.base.qw", "bat.swing.command_rad", "bat.swing.position_rad",
                           "bat.swing.velocity_rad_s", "bat.swing.torque_nm", "bat.bar.contact", "ball.x_m", "ball.qz"})
    EXPECT_GE(result.trace.column(name), 0) << name;
  EXPECT_EQ(-1, result.trace.column("bat.swing"));
  EXPECT_EQ("time_s,", result.trace.toCsv().substr(0, 7));
}

TEST(Trace, PacksWithoutLossAndRefusesDamagedBytes) {
  const auto trace = runTrial(batScene(0.001), Wave(0.5, 12, 0.4), {}, {}, 5, {.recordTrace = true}).trace;
  const std::string bytes = trace.pack();
  EXPECT_LT(bytes.size(), trace.values.size() * sizeof(double));
  EXPECT_EQ(trace.sha256(), Trace::unpack(bytes).sha256());
  EXPECT_EQ(trace.channels, Trace::unpack(bytes).channels);
  EXPECT_EQ(Trace{}.sha256(), Trace::unpack(Trace{}.pack()).sha256());
  for (std::size_t at = 0; at < bytes.size(); at += 7) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    EXPECT_THROW(Trace::unpack(damaged), InputError) << at;
    EXPECT_THROW(Trace::unpack(bytes.substr(0, at)), InputError) << at;
  }
}

}  // namespace
}  // namespace btr::test
