// What a servo's firmware, supply and gear add, each against its own equation.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "core/sim/drive_law.h"
#include "tests/plugin/effect_worlds.h"

namespace btr {
namespace {

using Numbers = std::vector<double>;

using test::effect;

TEST(StrengthDecline, FallsExponentiallyAndLinearlyWhereItsTimeIsLong) {
  const auto decline = effect("strength_decline");
  const auto at = [&](double time, const Numbers& values) {
    return decline->driveTorque(2, {.time = time}, values, {}, 1e-3);
  };
  EXPECT_DOUBLE_EQ(2, at(0, {0.1, 3, 0}));
  EXPECT_NEAR(2 * (1 - 0.3 * (1 - std::exp(-2.0 / 3))), at(2, {0.1, 3, 0}), 1e-15);
  EXPECT_NEAR(2 * (1 - 0.05 * 4), at(4, {0.05, 1000, 0}), 1e-3);
  EXPECT_EQ(0, at(20, {1, 1000, 0}));
}

TEST(StrengthDecline, OfAVoltageLeavesTheDrivesOwnDamping) {
  // Long after, seven tenths are left of the supply: a servo whose gain and limit are seven tenths, with all of its
  // damping, within its limits and beyond them.
  test::Trial trial{test::armScene(), 3};
  Scene weak = trial.scene;
  for (Drive& drive : weak.robots[0].drives) {
    drive.p *= 0.7;
    drive.maxTorque *= 0.7;
  }
  Scene declined = trial.scene;
  for (const char* at : {"rig.hinge", "rig.wrist"})
    declined = test::withEffect(declined, effect("strength_decline"), "strength_decline", {1, 0.3, 1}, at);
  double most = 0;
  const auto positionsOf = [&](const Scene& scene) {
    World world(scene, 1);
    world.startAt(100);
    std::vector<double> positions;
    for (int i = 0; i < 300; ++i) {
      world.advance(test::commands(scene, test::signal(0.01 * i)), 0.01);
      for (std::size_t j = 0; j < 2; ++j) {
        positions.push_back(world.jointPositions(0)[j]);
        most = std::max(most, std::abs(world.robot(0).torque[j]));
      }
    }
    return positions;
  };
  const auto expected = positionsOf(weak), found = positionsOf(declined);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(expected[i], found[i], 2e-3) << i;
  EXPECT_GT(most, 0.99 * 0.7 * 0.6);
}

TEST(StrengthDecline, WithoutDampingIsTheSameOfBothKinds) {
  const auto decline = effect("strength_decline");
  const JointState joint{.time = 2, .rate = 3, .limit = 0.9};
  EXPECT_EQ(decline->driveTorque(0.4, joint, Numbers{0.1, 3, 0}, {}, 1e-3),
            decline->driveTorque(0.4, joint, Numbers{0.1, 3, 1}, {}, 1e-3));
}

TEST(DriveDeadBand, TakesFromAllTorquesOrSwallowsTheSmallOnes) {
  const auto band = effect("drive_dead_band");
  const auto of = [&](double torque, double kind) {
    return band->driveTorque(torque, {}, Numbers{0.2, kind}, {}, 1e-3);
  };
  EXPECT_DOUBLE_EQ(0.3, of(0.5, 0));
  EXPECT_DOUBLE_EQ(-0.3, of(-0.5, 0));
  EXPECT_EQ(0, of(0.1, 0));
  EXPECT_EQ(0.5, of(0.5, 1));
  EXPECT_EQ(0, of(-0.1, 1));
}

TEST(IntegralAction, AddsUpTheErrorUntilItsClampAndStaysWithinTheDrivesLimit) {
  const auto integral = effect("integral_action");
  Numbers state{0};
  const JointState joint{.position = 0.1, .command = 0.3, .limit = 0.9};
  double torque = 0;
  for (int i = 0; i < 250; ++i) torque = integral->driveTorque(0.6, joint, Numbers{2, 0.15, 0, 0}, state, 1e-3);
  // The mean over the last step.
  EXPECT_NEAR(0.6 + 2 * 0.2 * 0.2495, torque, 1e-12);
  for (int i = 0; i < 250; ++i) torque = integral->driveTorque(0.6, joint, Numbers{2, 0.15, 0, 0}, state, 1e-3);
  EXPECT_NEAR(0.75, torque, 1e-12);
  EXPECT_DOUBLE_EQ(0.9, integral->driveTorque(0.8, joint, Numbers{2, 0.15, 0, 0}, state, 1e-3));
}

TEST(IntegralAction, IsPartOfTheSumThatTheDriveLimits) {
  const auto integral = effect("integral_action");
  Numbers state{-0.15};
  // The law asks for 1.5 N·m of 0.9 N·m: with −0.15 N·m more it still does.
  const JointState joint{.position = 0.1, .command = 0.1, .limit = 0.9, .beyond = 0.6};
  EXPECT_DOUBLE_EQ(0.9, integral->driveTorque(0.9, joint, Numbers{2, 0.15, 0, 0}, state, 1e-3));
  const JointState nearer{.position = 0.1, .command = 0.1, .limit = 0.9, .beyond = 0.1};
  EXPECT_DOUBLE_EQ(0.85, integral->driveTorque(0.9, nearer, Numbers{2, 0.15, 0, 0}, state, 1e-3));
}

TEST(IntegralAction, ThatWaitsAddsUpNothingWhileTheDriveIsAtItsLimit) {
  const auto integral = effect("integral_action");
  const Numbers waits{2, 100, 0, 1};
  Numbers state{0.1};
  JointState joint{.position = 0.1, .command = 0.3, .drive = 0.9, .limit = 0.9};
  EXPECT_EQ(0.1, integral->servoTerm(joint, waits, state, 1e-3));
  EXPECT_EQ(0.1, state[0]);
  joint.command = -0.1;  // an error that leads back from the limit counts
  integral->servoTerm(joint, waits, state, 1e-3);
  EXPECT_DOUBLE_EQ(0.1 - 2 * 0.2 * 1e-3, state[0]);
  joint = {.position = 0.1, .command = 0.3, .drive = 0.8, .limit = 0.9};
  integral->servoTerm(joint, waits, state, 1e-3);
  EXPECT_DOUBLE_EQ(0.1, state[0]);
}

TEST(IntegralAction, HoldsTheWeightFromTheStartWhereItHasSettled) {
  const auto integral = effect("integral_action");
  Numbers state{0};
  integral->rest({.load = 0.1}, Numbers{2, 0.15, 0, 0}, state);
  EXPECT_EQ(0, state[0]);
  integral->rest({.load = 0.1}, Numbers{2, 0.15, 1, 0}, state);
  EXPECT_EQ(-0.1, state[0]);
  integral->rest({.load = -0.4}, Numbers{2, 0.15, 1, 0}, state);
  EXPECT_EQ(0.15, state[0]);
}

TEST(RateFeedforward, PushesWithTheCommandsRate) {
  const auto feedforward = effect("rate_feedforward");
  const Numbers values{0.2, 0.01};
  Numbers state(2);
  double torque = 0;
  for (int i = 0; i <= 100; ++i) torque = feedforward->driveTorque(0.1, {.command = 3e-3 * i}, values, state, 1e-3);
  EXPECT_NEAR(0.1 + 0.2 * 3, torque, 1e-4);
  // A step's whole push is the gain times the step, however fine the steps are.
  for (const double step : {1e-3, 4e-3}) {
    Numbers fresh(2);
    double push = step * feedforward->driveTorque(0, {.command = 0}, values, fresh, step);
    for (int i = 0; i < 400; ++i) push += step * feedforward->driveTorque(0, {.command = 0.5}, values, fresh, step);
    EXPECT_NEAR(0.2 * 0.5, push, 1e-9);
  }
}

TEST(RateFeedforward, IsPartOfTheSumThatTheDriveLimits) {
  const auto feedforward = effect("rate_feedforward");
  Numbers state(2);
  feedforward->driveTorque(0, {.command = 1}, Numbers{0.2, 1e-3}, state, 1e-3);
  const JointState joint{.command = 0, .limit = 0.9, .beyond = 0.3};
  EXPECT_DOUBLE_EQ(-0.9, feedforward->driveTorque(0.9, joint, Numbers{0.2, 1e-3}, state, 1e-3));
}

TEST(IntegralAction, LeavesATorqueCommandAlone) {
  Numbers state{0};
  EXPECT_EQ(0.6, effect("integral_action")
                     ->driveTorque(0.6, {.command = 1, .followsPosition = false}, Numbers{2, 0.15, 0, 0}, state, 1e-3));
}

TEST(ErrorDeadBand, LetsSmallErrorsBe) {
  const auto band = effect("error_dead_band");
  const JointState joint{.position = 0.5};
  for (const auto& [given, whole, rest] :
       {std::array{0.51, 0.5, 0.5}, {0.481, 0.5, 0.5}, {0.6, 0.6, 0.58}, {0.3, 0.3, 0.32}}) {
    const CommandAround kept = band->command({given, given}, joint, Numbers{0.02, 0}, {}, 1e-3);
    const CommandAround less = band->command({0.5, given}, joint, Numbers{0.02, 1}, {}, 1e-3);
    EXPECT_DOUBLE_EQ(whole, kept.before);
    EXPECT_DOUBLE_EQ(rest, less.after);
    EXPECT_DOUBLE_EQ(0.5, less.before);
  }
}

// A ramp of torque that is seen every 3 ms: what acted until a sample is a staircase's area, whatever the step.
TEST(SampledLoop, HoldsWhatItsLawAskedForUntilTheNextSample) {
  const auto loop = effect("sampled_loop");
  constexpr double period = 3e-3, slope = 2, until = 0.09;
  for (const double step : {1e-3, 0.5e-3, 4.5e-3}) {
    Numbers state(10);
    double area = 0;
    const long steps = std::lround(until / step);
    for (long i = 0; i < steps; ++i) {
      const double time = step * (static_cast<double>(i) + 0.5);
      area += step * loop->driveTorque(slope * time, {.time = time, .command = 1}, Numbers{1, 3, 0}, state, step);
    }
    // Where the slope is not known yet, the first sample may miss by what the ramp gains in half a step.
    double stairs = 0;
    for (double k = 0; k * period < until - 1e-9; ++k) stairs += period * slope * k * period;
    EXPECT_NEAR(stairs, area, 1e-9 + std::max(period, step) * slope * step) << "step " << step;
  }
}

TEST(SampledLoop, LeavesBackEmfAsItIs) {
  const auto loop = effect("sampled_loop");
  for (const double stays : {0.0, 1.0}) {
    Numbers state(10);
    double torque = 0;
    for (int i = 0; i < 5; ++i) {
      const double rate = i;  // damped by 0.1 N·m·s/rad
      torque = loop->driveTorque(1 - 0.1 * rate, {.time = 1e-3 * (i + 0.5), .rate = rate, .command = 1, .damping = 0.1},
                                 Numbers{1, 40, stays}, state, 1e-3);
    }
    EXPECT_NEAR(stays == 0 ? 1 : 1 - 0.1 * 4, torque, 1e-12);
  }
}

TEST(SampledLoop, SeesACommandThatJumpsAtItsSample) {
  const SceneEffect held{effect("sampled_loop"), "sampled_loop", "rig.hinge", {1, 10, 0}};
  const Drive drive{.p = 5, .d = 0, .maxTorque = 10};
  JointEffects effects;
  effects.add(held);
  DriveRow row;
  for (int i = 0; i < 15; ++i) {
    const CommandAround command{i > 10 ? 0.3 : 0, i >= 10 ? 0.3 : 0};
    const JointState joint{.time = 1e-3 * i, .command = command.mean(), .limit = 10};
    row = effects.drive({}, drive, joint, command, 0, {}, {.h = 1e-3, .inertia = 1, .left = 1e-3});
    if (i == 9) {
      EXPECT_NEAR(0, row.p, 1e-12);
    }
    if (i == 10) {
      EXPECT_NEAR(5 * 0.3 / 2, row.p, 1e-9);  // half of the kick
    }
  }
  EXPECT_NEAR(5 * 0.3, row.p, 1e-9);
}

// The law asks for 1.5 N·m, its integral for 0.3 more, the falling command for 1.2 less: 0.6 of them all, although each
// sum on the way is above the limit.
TEST(ServoTerms, OfSeveralEffectsAreOneSumThatIsLimitedOnce) {
  constexpr double step = 1e-3, filter = 2e-3, gain = 1.2 * step / (1 - 0.60653065971263342);
  const SceneEffect integral{effect("integral_action"), "integral_action", "rig.hinge", {1000, 0.3, 0, 0}};
  const SceneEffect feedforward{effect("rate_feedforward"), "rate_feedforward", "rig.hinge", {gain, filter}};
  const Drive drive{.p = 5, .d = 0, .maxTorque = 0.9};
  JointEffects effects;
  effects.add(integral);
  effects.add(feedforward);
  DriveRow row;
  for (const double at : {1.0, 0.0}) {
    const CommandAround command{at + 0.3, at + 0.3};
    const JointState joint{.position = at, .command = at + 0.3, .limit = 0.9};
    row = effects.drive({}, drive, joint, command, 0, {}, {.h = step, .inertia = 1, .left = step});
  }
  EXPECT_NEAR(0.6, row.p, 1e-9);
}

/// The profile's place after each step, as the means over the half steps say it; `told` is what is commanded then.
std::vector<double> profileOf(const Numbers& values, double step, int steps,
                              const std::function<double(double)>& told) {
  const auto profile = effect("command_profile");
  Numbers state(3);
  std::vector<double> places;
  double before = told(0);
  for (int i = 0; i < steps; ++i) {
    const double now = told(step * i);
    profile->command({before, now}, {}, values, state, step);
    before = now;
    places.push_back(state[1]);
  }
  return places;
}

TEST(CommandProfile, AnswersAStepWithATrapezoidOfSpeedWhateverTheStep) {
  constexpr double fastest = 2, steepest = 10, far = 1;
  for (const double step : {1e-3, 4e-3, 8e-3}) {
    // The command jumps in the middle of the first step.
    const auto places = profileOf({1 / fastest, 1 / steepest}, step, static_cast<int>(1 / step),
                                  [](double time) { return time > 0 ? far : 0.0; });
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double t = step * (static_cast<double>(i) - 0.5), whole = far / fastest + fastest / steepest;
      double expected = far;
      if (t < fastest / steepest)
        expected = steepest * t * std::abs(t) / 2;
      else if (t < whole - fastest / steepest)
        expected = fastest * (t - fastest / steepest / 2);
      else if (t < whole)
        expected = far - steepest * (whole - t) * (whole - t) / 2;
      EXPECT_NEAR(std::max(0.0, expected), places[i], 1e-12) << step << " s, step " << i;
    }
  }
}

TEST(CommandProfile, KeepsItsLimitsWhereCommandsTurnOnTheWayAndArrives) {
  constexpr double fastest = 3, steepest = 20, step = 2e-3;
  const auto places = profileOf({1 / fastest, 1 / steepest}, step, 2000, [](double time) {
    return time > 2 ? 0.3 : std::fmod(time, 0.3) < 0.17 ? 0.9 : -0.7;
  });
  double speed = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double now = (places[i] - places[i - 1]) / step;
    EXPECT_LE(std::abs(now), fastest * (1 + 1e-9));
    EXPECT_LE(std::abs(now - speed), steepest * step * (1 + 1e-9));
    speed = now;
  }
  EXPECT_EQ(0.3, places.back());
}

TEST(CommandProfile, WithoutALimitOfAccelerationIsALimitOfSpeed) {
  const auto places = profileOf({0.5, 0}, 0.01, 100, [](double time) { return time > 0 ? 1.0 : 0.0; });
  for (std::size_t i = 1; i < places.size(); ++i)
    EXPECT_NEAR(std::min(1.0, 2 * 0.01 * (static_cast<double>(i) - 0.5)), places[i], 1e-12);
}

TEST(CommandFilter, AnswersAStepAsAFirstOrderLowPass) {
  const auto filter = effect("command_filter");
  for (const double step : {1e-3, 4e-3}) {
    Numbers state(2);
    filter->command({0, 1}, {}, Numbers{0.03}, state, step);  // the command jumps at t = 0
    for (int i = 1; i < 20; ++i) {
      const double t = i * step, h = step / 2;
      const auto mean = [&](double from, double to) {
        return 1 - 0.03 * (std::exp(-from / 0.03) - std::exp(-to / 0.03)) / (to - from);
      };
      const CommandAround followed = filter->command({1, 1}, {}, Numbers{0.03}, state, step);
      EXPECT_NEAR(mean(t - h, t), followed.before, 1e-12);
      EXPECT_NEAR(mean(t, t + h), followed.after, 1e-12);
    }
  }
}

TEST(MagnusLift, OfFastSpinFollowsNathansCurve) {
  const BallState ball{.velocity_m_s = {5, 0, 0}, .spin_rad_s = {0, 60, 0}, .radius_m = 0.1, .mass_kg = 0.1};
  const double ratio = 0.1 * 60 / 5, lift = ratio / (0.4 + 2.32 * ratio);
  const double expected = -0.5 * 1.2 * M_PI * 0.01 * lift * 25;
  EXPECT_NEAR(expected, effect("magnus_lift")->ballForce(ball, Numbers{2.5, 1}).z(), 1e-12);
}

/// The height to which a ball comes back that falls by that much on a floor of restitution 0.8.
double comesBackTo(double height, double loss) {
  BallSpec ball{.name = "ball", .position_m = {0, 0, 0.0425 + height}};
  ball.restitution = 0.8;
  Scene scene = test::ballScene(ball, 1e-4);
  scene = test::withEffect(scene, effect("restitution_by_speed"), "restitution_by_speed", {loss});
  World world(scene, 1);
  double top = 0;
  for (int i = 0; i < 3000 && world.fault().empty(); ++i) {
    world.advance(test::commands(scene, 0), 1e-3);
    if (i > 1.1e3 * std::sqrt(2 * height / 9.81) && world.ball(0).velocity_m_s.z() > 0)
      top = std::max(top, world.ball(0).position_m.z() - 0.0425);
    if (top > 0 && world.ball(0).velocity_m_s.z() < 0) break;
  }
  return top;
}

TEST(RestitutionBySpeed, LowersFastHitsMoreThanSlowOnes) {
  for (const double height : {0.05, 0.5}) {
    const double speed = std::sqrt(2 * 9.81 * height), back = 0.8 / (1 + 0.2 * speed);
    EXPECT_NEAR(back * back * height, comesBackTo(height, 0.2), 0.02 * height) << height;
  }
}

/// A wheel of 2e-3 kg·m² without weight, its rotor of 1e-3 behind a gap; where joint and motor are after a while under
/// 0.2 N·m.
std::pair<double, double> behindGap(double width, double step, double time, double sensors) {
  const Drive drive{.kind = Drive::Kind::torque, .rotorInertia_kg_m2 = 1e-3};
  Scene scene = test::weightless(test::sceneOf(test::robot(test::wheelModel(2e-3), false, drive), step));
  scene = test::withEffect(scene, effect("backlash"), "backlash", {width, 100, sensors});
  World world(scene, 1);
  world.advance(test::commands(scene, 0.2), time);
  return {world.robot(0).position[0], world.robot(0).rate[0]};
}

TEST(Backlash, WithItsSensorAtTheMotorCrossesTheGapAsTheRotorDoesAndMovesBothAfterAnInelasticHit) {
  // Half the gap, 0.01 rad, from its middle: φ'' = (τ − φ'/s)/J, s = 100. Then both go on with the rotor's momentum.
  const double torque = 0.2, rotor = 1e-3, wheel = 2e-3, drag = 0.01, gap = 0.01;
  double crossing = 0, way = 0, rate = 0;
  for (; way < gap; crossing += 1e-7) {
    rate += 1e-7 * (torque - drag * rate) / rotor;
    way += 1e-7 * rate;
  }
  const double together = rate * rotor / (rotor + wheel), rest = 0.1 - crossing;
  const double joint = together * rest + torque / (rotor + wheel) * rest * rest / 2;
  for (const double step : {1e-4, 1e-3}) {
    const double tolerance = 20 * step * together;
    EXPECT_NEAR(joint, behindGap(2 * gap, step, 0.1, 1).first, tolerance) << step;
    EXPECT_NEAR(joint + gap, behindGap(2 * gap, step, 0.1, 3).first, tolerance) << step;
    EXPECT_NEAR(together + torque / (rotor + wheel) * rest, behindGap(2 * gap, step, 0.1, 3).second, 0.05 * together)
        << step;
  }
}

TEST(Backlash, OfHardlyAnyWidthIsARigidGearWhereverTheSensorsSit) {
  const double rigid = behindGap(0, 1e-3, 0.1, 0).first;
  for (const double sensors : {1.0, 2.0, 3.0})
    EXPECT_NEAR(rigid, behindGap(1e-7, 1e-3, 0.1, sensors).first, 0.01 * rigid);
}

/// The arm's hinge at rest under its own weight, commanded to 0.6 rad.
double restsAt(double sensors) {
  Scene scene = test::armScene();
  scene = test::withEffect(scene, effect("gear_elasticity"), "gear_elasticity", {0.2, 1e-3, 0.05, sensors});
  World world(scene, 1);
  world.advance(test::commands(scene, 0.6), 5);
  EXPECT_LT(std::abs(world.robot(0).rate[0]), 1e-3);
  return world.robot(0).position[0];
}

TEST(GearElasticity, RestsWhereTheLoopsSensorAndTheRecordingsSensorSay) {
  // τ = p·(c − what the loop follows) = weight(q) = what twists the gear by τ·compliance. The wrist is rigid.
  const double atJoint = restsAt(0), jointOfMotor = restsAt(1), motorOfJoint = restsAt(2), atMotor = restsAt(3);
  EXPECT_NEAR(3 * (0.6 - atJoint) * 0.2, motorOfJoint - atJoint, 2e-3);
  EXPECT_NEAR(3 * (0.6 - atMotor) * 0.2, atMotor - jointOfMotor, 2e-3);
  EXPECT_GT(atJoint, jointOfMotor + 0.01);
}

}  // namespace
}  // namespace btr
