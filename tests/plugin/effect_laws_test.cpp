// The laws of gears, motors, sensors, air and floors that effects add, each against its own equation.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/plugin/effect_worlds.h"

namespace btr {
namespace {

using Numbers = std::vector<double>;

using test::effect;

TEST(StribeckFriction, FadesFromRestToSliding) {
  const auto friction = effect("stribeck_friction");
  for (const double exponent : {1.0, 2.0, 12.0}) {
    const Numbers values{0.02, 0.05, 0.1, exponent};
    EXPECT_DOUBLE_EQ(0.07, friction->frictionLimit({}, values));
    EXPECT_NEAR(0.02 + 0.05 / std::numbers::e, friction->frictionLimit({.rate = -0.1}, values), 1e-15);
    EXPECT_NEAR(0.02, friction->frictionLimit({.rate = 5}, values), 1e-15);
  }
}

TEST(StribeckFriction, WithALargeExponentIsAStep) {
  const auto friction = effect("stribeck_friction");
  const Numbers values{0.02, 0.05, 0.8, 12};
  EXPECT_NEAR(0.07, friction->frictionLimit({.rate = 0.5}, values), 1e-3);
  EXPECT_NEAR(0.02, friction->frictionLimit({.rate = -1}, values), 1e-6);
}

TEST(ThinningFriction, IsViscousWhenSlowAndFadesBeyond) {
  const auto friction = effect("thinning_friction");
  const auto torque = [&](double rate, double fading, double suddenness) {
    return rate * friction->damping({.rate = rate}, Numbers{0.3, 2.5, fading, suddenness});
  };
  for (const double fading : {1.0, 2.0}) EXPECT_NEAR(0.3 * 0.01, torque(0.01, fading, 2), 1e-7);
  // An eddy current brake: k·ω/(1 + (ω/ωc)²).
  for (const double rate : {0.5, 2.5, 9.0})
    EXPECT_NEAR(0.3 * rate / (1 + rate * rate / 6.25), torque(rate, 2, 2), 1e-12);
  EXPECT_GT(torque(2.5, 2, 2), torque(2, 2, 2)) << "it is strongest there";
  EXPECT_GT(torque(2.5, 2, 2), torque(3, 2, 2));
  // A second slope, here 0, at once.
  EXPECT_NEAR(0.3 * 1.5, torque(1.5, 1, 12), 1e-3);
  EXPECT_NEAR(0.3 * 2.5, torque(4, 1, 12), 1e-3);
}

TEST(LoadDependentFriction, AddsSharesOfDriveAndWeightWhereOneHoldsTheOther) {
  const auto friction = effect("load_dependent_friction");
  EXPECT_NEAR(0.01 + 0.2 * 0.5 + 0.1 * 0.5,
              friction->frictionLimit({.drive = 0.5, .load = -0.5}, Numbers{0.01, 0.2, 0.1}), 1e-15);
  EXPECT_NEAR(0.01 + 0.2 * 0.5 - 0.1 * 0.5,
              friction->frictionLimit({.drive = 0.5, .load = 0.5}, Numbers{0.01, 0.2, 0.1}), 1e-15);
}

TEST(LoadDependentFriction, FeelsTheMomentOfAllThatTheJointCarries) {
  // Arm 0.3 kg and hand 0.05 kg are held at rest by friction alone until their moment exceeds its share: with cl = 1
  // the joint cannot move at all, with cl = 0.5 it falls.
  for (const double share : {1.01, 0.5}) {
    const test::Trial trial{test::armScene(), 0.4, false};
    const Scene scene =
        test::withEffect(trial.scene, effect("load_dependent_friction"), "load_dependent_friction", {0, 0, share});
    World world(scene, 1);
    world.setRobot(0, scene.robots[0].start, {0, 0, 0}, {0, 0, 0}, Numbers{1.2, 0}, Numbers{0, 0});
    auto inputs = test::commands(scene, 0);
    for (auto& input : inputs[0]) input.enabled = false;
    world.advance(inputs, 0.04);
    if (share > 1) {
      EXPECT_NEAR(1.2, world.robot(0).position[0], 1e-3);
    } else {
      EXPECT_LT(world.robot(0).position[0], 1.2 - 5e-3);
    }
  }
}

TEST(AsymmetricFriction, OpposesEachDirectionWithItsOwnTorque) {
  const auto friction = effect("asymmetric_friction");
  const Numbers values{0.05, 0.02, 0.3, 0.1};
  for (const double rate : {2.0, -2.0}) {
    const JointState joint{.rate = rate};
    const double total = friction->torque(joint, values) - std::copysign(friction->frictionLimit(joint, values), rate) -
                         friction->damping(joint, values) * rate;
    EXPECT_NEAR(rate > 0 ? -0.05 - 0.3 * 2 : 0.02 + 0.1 * 2, total, 1e-15);
    EXPECT_LT(total * rate, 0);
  }
}

TEST(TorqueSpeedLimit, FallsAlongTheLineInTheDrivingQuadrantOnly) {
  const auto limit = effect("torque_speed_limit");
  const Numbers values{2, 0.1};  // 0.5 N·m at standstill, 10 rad/s without load
  const auto at = [&](double torque, double rate) {
    return limit->driveTorque(torque, {.rate = rate, .limit = 1}, values, {}, 1e-3);
  };
  EXPECT_DOUBLE_EQ(0.5, at(0.9, 0));
  EXPECT_DOUBLE_EQ(0.5 * (1 - 0.4), at(0.9, 4));
  EXPECT_DOUBLE_EQ(0, at(0.9, 12));
  EXPECT_DOUBLE_EQ(-0.5, at(-0.9, 4));
  EXPECT_DOUBLE_EQ(0.1, at(0.1, 4));
  // Without a stall torque of its own it is the drive's limit.
  EXPECT_DOUBLE_EQ(1 * (1 - 0.4), limit->driveTorque(0.9, {.rate = 4, .limit = 1}, Numbers{0, 0.1}, {}, 1e-3));
}

TEST(VoltageSag, WeakensADriveByTheTorqueOfAll) {
  EXPECT_DOUBLE_EQ(0.3 / 1.4, effect("voltage_sag")->driveTorque(0.3, {.allDrives = 2}, Numbers{0.2, 0}, {}, 1e-3));
}

TEST(VoltageSag, SettlesWhereTorqueAndVoltageAgree) {
  // A torque drive of 0.6 N·m: τ = 0.6/(1 + s·τ), so s·τ² + τ − 0.6 = 0.
  Scene scene = test::sceneOf(test::robot(test::wheelModel(1), false, {.kind = Drive::Kind::torque}), 0.001);
  const double s = 0.8;
  World world(test::withEffect(scene, effect("voltage_sag"), "voltage_sag", {s, 0}), 1);
  world.advance(test::commands(scene, 0.6), 0.2);
  EXPECT_NEAR((-1 + std::sqrt(1 + 4 * s * 0.6)) / (2 * s), world.robot(0).torque[0], 1e-9);
}

TEST(TorqueRipple, IsASineOfTheAngle) {
  EXPECT_DOUBLE_EQ(0.04 * std::sin(7 * 0.3 + 0.2),
                   effect("torque_ripple")->torque({.position = 0.3}, Numbers{0.04, 7, 0.2}));
}

TEST(SensorLag, FollowsARampItsTimeConstantLate) {
  const auto lag = effect("sensor_lag");
  Numbers state(4);
  const double h = 0.001, late = 0.02, slope = 3;
  for (int i = 0; i <= 400; ++i) {
    const double time = i * h;
    const JointState joint{.time = time, .position = slope * time};
    // y = slope·(t − T·(1 − e^(−t/T))), and the command moves by what the sensor is behind.
    const double behind = slope * late * (1 - std::exp(-time / late));
    EXPECT_NEAR(1 + behind, lag->command({1, 1}, joint, Numbers{late, 1}, state, h).mean(), 1e-12);
    JointState next = joint;
    next.position += slope * h;
    EXPECT_NEAR(next.position - slope * late * (1 - std::exp(-(time + h) / late)),
                lag->measured(next.position, next, Numbers{late, 1}, state, 0.008), 1e-12);
  }
}

TEST(SensorLag, OfTheRecordersOwnSensorLeavesTheServoAlone) {
  const auto lag = effect("sensor_lag");
  Numbers state(4);
  const double h = 0.001, late = 0.02, slope = 3;
  for (int i = 0; i <= 400; ++i) {
    const JointState joint{.time = i * h, .position = slope * i * h};
    EXPECT_EQ(1, lag->command({1, 1}, joint, Numbers{late, 0}, state, h).mean());
  }
  const JointState next{.time = 401 * h, .position = slope * 401 * h};
  EXPECT_NEAR(next.position - slope * late * (1 - std::exp(-next.time / late)),
              lag->measured(next.position, next, Numbers{late, 0}, state, 0.008), 1e-12);
}

TEST(RotorInertia, SlowsAWheelByItsInertia) {
  // τ/(I + J)·t²/2; the wheel has no weight about its axis.
  const double torque = 0.2, inertia = 2e-3, rotor = 3e-3;
  Scene scene = test::sceneOf(test::robot(test::wheelModel(inertia), false, {.kind = Drive::Kind::torque}), 0.001);
  scene = test::withEffect(scene, effect("rotor_inertia"), "rotor_inertia", {rotor});
  World world(scene, 1);
  world.advance(test::commands(scene, torque), 0.2);
  EXPECT_NEAR(torque / (inertia + rotor) * 0.2 * 0.2 / 2, world.robot(0).position[0], 2e-3);
}

/// The wheel's angle under a constant torque through a gear of that compliance, without damping.
double behindGear(double compliance, double step, double time) {
  Scene scene = test::sceneOf(test::robot(test::wheelModel(2e-3), false, {.kind = Drive::Kind::torque}), step);
  scene = test::withEffect(scene, effect("gear_elasticity"), "gear_elasticity", {compliance, 1e-3, 0, 0});
  World world(scene, 1);
  world.advance(test::commands(scene, 0.2), time);
  return world.robot(0).position[0];
}

TEST(GearElasticity, SwingsAsTwoMassesOnASpringDo) {
  // q = τ/(J + I)·(t²/2 − (1 − cos ωt)/ω²),   ω² = k·(1/J + 1/I)
  const double c = 0.1, omega = std::sqrt((1 / 1e-3 + 1 / 2e-3) / c);
  for (const double t : {0.016, 0.024, 0.048}) {
    const double expected = 0.2 / 3e-3 * (t * t / 2 - (1 - std::cos(omega * t)) / (omega * omega));
    EXPECT_NEAR(expected, behindGear(c, 1e-4, t), 0.01 * expected) << t;
  }
}

TEST(GearElasticity, IsRigidInTheLimitAndStableAtAnyStep) {
  const double rigid = behindGear(0, 1e-3, 0.2);
  EXPECT_NEAR(rigid, behindGear(1e-9, 1e-3, 0.2), 1e-5 * rigid);
  EXPECT_NEAR(rigid, behindGear(1e-5, 8e-3, 0.2), 0.05 * rigid);
}

TEST(GearElasticity, KeepsTheEnergyOfARotorThatSwingsAgainstTheJoint) {
  Scene scene =
      test::weightless(test::sceneOf(test::robot(test::wheelModel(2e-3), false, {.kind = Drive::Kind::torque}), 2e-4));
  scene = test::withEffect(scene, effect("gear_elasticity"), "gear_elasticity", {0.1, 1e-3, 0, 0});
  World world(scene, 1);
  world.advance(test::commands(scene, 0.2), 0.02);
  const double begin = world.energy();
  EXPECT_GT(begin, 0);
  world.advance(test::commands(scene, 0), 0.5);
  EXPECT_NEAR(begin, world.energy(), 0.15 * begin);
}

/// How far an arm leaves its place within half a second whose servo is told just so much more as holds its weight
/// there.
double movesFromRest(const std::string& name, const Numbers& values, double angle, bool rested, double step = 5e-4) {
  constexpr double mass = 0.5, length = 0.2, p = 4;
  const Drive servo{.kind = Drive::Kind::servo, .p = p, .d = 0.2, .maxTorque = 3};
  Scene scene = test::sceneOf(test::robot(test::pendulumModel(mass, length, 1e-3), false, servo), step);
  scene = test::withEffect(scene, effect(name), name, values);
  World world(scene, 1);
  world.setRobot(0, Eigen::Isometry3d::Identity(), {0, 0, 0}, {0, 0, 0}, Numbers{angle}, Numbers{0});
  if (rested) world.rest(0);
  double furthest = 0;
  for (int i = 0; i < 100; ++i) {
    world.advance(test::commands(scene, angle + mass * test::g * length * std::sin(angle) / p), 0.005);
    furthest = std::max(furthest, std::abs(world.robot(0).position[0] - angle));
  }
  return furthest;
}

TEST(Rest, LeavesTeethOnTheFlankThatHoldsTheWeightAndGearsWoundUp) {
  const std::map<std::string, Numbers> remembering{{"backlash", {0.1, 3}}, {"gear_elasticity", {0.1, 1e-3, 0.01}}};
  for (const auto& [name, values] : remembering)
    for (const double angle : {-0.7, 0.5}) {
      const double unrested = movesFromRest(name, values, angle, false);
      EXPECT_GT(unrested, 1e-3) << name;
      // The first step's half kick sets a spring swinging, by less the shorter it is.
      EXPECT_LT(movesFromRest(name, values, angle, true), 0.025 * unrested) << name;
      EXPECT_LT(movesFromRest(name, values, angle, true, 1.25e-4), 0.007 * unrested) << name;
    }
}

TEST(AirDrag, IsNewtonsAtTheSpeedOfTheBall) {
  const BallState ball{.velocity_m_s = {3, 4, 0}, .radius_m = 0.1, .mass_kg = 0.1};
  const Eigen::Vector3d force = effect("air_drag")->ballForce(ball, Numbers{0.5});
  const double expected = 0.5 * 1.2 * 0.5 * std::numbers::pi * 0.01 * 25;
  EXPECT_NEAR(expected, force.norm(), 1e-15);
  EXPECT_NEAR(-expected * 5, force.dot(ball.velocity_m_s), 1e-14);
}

TEST(JointStop, TurnsAWheelRoundInHalfAPeriodOfItsSpring) {
  // From 0 to the end at speed ω, then half of 2π·√(J/k) in it, no deeper than ω·√(J/k), and back.
  constexpr double inertia = 0.02, stiffness = 80, end = 0.6, speed = 12;
  const double swing = std::sqrt(inertia / stiffness);
  Scene scene = test::sceneOf(test::robot(test::wheelModel(inertia), false, {.kind = Drive::Kind::none}), 1e-4);
  World world(test::withEffect(scene, effect("joint_stop"), "joint_stop", {stiffness, -100, end, 0}), 1);
  world.setRobot(0, scene.robots[0].start, {0, 0, 0}, {0, 0, 0}, Numbers{0}, Numbers{speed});
  world.advance(test::commands(scene, 0), end / speed + std::numbers::pi / 2 * swing);
  EXPECT_NEAR(world.robot(0).position[0], end + speed * swing, 1e-3 * speed * swing);
  world.advance(test::commands(scene, 0), end / speed + std::numbers::pi / 2 * swing);
  EXPECT_NEAR(world.robot(0).position[0], 0, 5e-3 * end);
  EXPECT_NEAR(world.robot(0).rate[0], -speed, 5e-3 * speed);
}

TEST(FluidDrag, StopsAWheelAsOneOverTime) {
  // J·ω̇ = −c·ω²: ω = ω0/(1 + c·ω0·t/J), an angle of J/c·ln(1 + c·ω0·t/J).
  constexpr double inertia = 0.02, c = 0.004, speed = 12, time_s = 1.5;
  Scene scene = test::sceneOf(test::robot(test::wheelModel(inertia), false, {.kind = Drive::Kind::none}), 2e-4);
  World world(test::withEffect(scene, effect("fluid_drag"), "fluid_drag", {c}), 1);
  world.setRobot(0, scene.robots[0].start, {0, 0, 0}, {0, 0, 0}, std::vector{0.0}, std::vector{speed});
  world.advance(test::commands(scene, 0), time_s);
  EXPECT_NEAR(inertia / c * std::log(1 + c * speed * time_s / inertia), world.jointPositions(0)[0], 1e-3);
}

TEST(ViscousDrag, TakesItsShareOfTheSpeedInFlightAndLessOfItRolling) {
  constexpr double b = 0.8, time_s = 0.5;
  const auto lost = [](double rate) { return (1 - std::exp(-rate * time_s)) / rate; };
  for (const bool rolls : {false, true}) {
    test::Trial trial = rolls ? test::rolling(0.8, 0) : test::flying();
    BallSpec& ball = trial.scene.balls.at(0);
    if (!rolls) ball.position_m[2] = 5;
    const double speed = ball.velocity_m_s[0], rate = rolls ? b / (1 + ball.inertiaFactor) : b;
    World world(test::withEffect(trial.scene, effect("viscous_drag"), "viscous_drag", {b}), 1);
    world.advance(test::commands(trial.scene, 0), time_s);
    EXPECT_NEAR(speed * lost(rate), world.ball(0).position_m.x(), 1e-3) << (rolls ? "rolling" : "flying");
  }
}

TEST(MagnusLift, PushesATopSpinDown) {
  // Flying along x with spin about y (top spin): ω × v = −z.
  const BallState ball{.velocity_m_s = {5, 0, 0}, .spin_rad_s = {0, 30, 0}, .radius_m = 0.1, .mass_kg = 0.1};
  const Eigen::Vector3d force = effect("magnus_lift")->ballForce(ball, Numbers{1, 0});
  EXPECT_NEAR(-0.5 * 1.2 * std::numbers::pi * 1e-3 * 30 * 5, force.z(), 1e-15);
  EXPECT_EQ(0, force.dot(ball.velocity_m_s));
}

TEST(ConstantWind, WithAirDragIsDragInTheWind) {
  const BallState ball{.velocity_m_s = {1, 0, 2}, .radius_m = 0.1, .mass_kg = 0.1};
  const Eigen::Vector3d both =
      effect("constant_wind")->ballForce(ball, Numbers{4, -1}) + effect("air_drag")->ballForce(ball, Numbers{0.47});
  const Eigen::Vector3d relative(3, -1, -2);
  const Eigen::Vector3d expected = 0.5 * 1.2 * 0.47 * std::numbers::pi * 0.01 * relative.norm() * relative;
  EXPECT_NEAR(0, (both - expected).norm(), 1e-15);
}

TEST(ConstantWind, FollowsTheDragNumberOfStillAir) {
  const BallState ball{.velocity_m_s = {1, 0, 2}, .radius_m = 0.02, .mass_kg = 0.0027};
  const Eigen::Vector3d relative(3, -1, -2);
  const Eigen::Vector3d expected = 0.5 * 1.2 * 0.25 * std::numbers::pi * 4e-4 * relative.norm() * relative;
  const PlacedEffect wind{"constant_wind", "world", {{"x_m_s", 4}, {"y_m_s", -1}}};
  const PlacedEffect drag{"air_drag", "ball", {{"drag_number", 0.25}}};
  SceneSpec spec;
  spec.balls.push_back({.name = "ball"});
  for (const auto& effects : {std::vector{wind, drag}, std::vector{drag, wind}}) {
    const Scene scene = makeScene(spec, {}, {.values = {}, .effects = effects}, test::host().effectFactory());
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (const SceneEffect& placed : scene.effects) force += placed.effect->ballForce(ball, placed.values);
    EXPECT_NEAR(0, (force - expected).norm(), 1e-15);
  }
}

TEST(AnisotropicRollingResistance, SlowsABallByItsNumberAlongEachAxis) {
  // Rolling freely from 0.8 m/s for 0.5 s: x = v·t − a·t²/2.
  for (const bool alongX : {true, false}) {
    const test::Trial trial = alongX ? test::rolling(0.8, 0) : test::rolling(0, 0.8);
    World world(test::withEffect(trial.scene, effect("anisotropic_rolling_resistance"),
                                 "anisotropic_rolling_resistance", {0.6, 0.2, 0}),
                1);
    world.advance(test::commands(trial.scene, 0), 0.5);
    const Eigen::Vector3d at = world.ball(0).position_m;
    EXPECT_NEAR(0.8 * 0.5 - (alongX ? 0.6 : 0.2) * 0.125, alongX ? at.x() : at.y(), 2e-3);
    EXPECT_NEAR(0, alongX ? at.y() : at.x(), 1e-6);
  }
}

TEST(AnisotropicRollingResistance, EqualAlongBothAxesIsRollingResistance) {
  const test::Trial trial = test::rolling(0.6, 0.5);
  const auto directed = test::run(test::withEffect(trial.scene, effect("anisotropic_rolling_resistance"),
                                                   "anisotropic_rolling_resistance", {0.4, 0.4, 0.7}),
                                  trial);
  const auto plain =
      test::run(test::withEffect(trial.scene, effect("rolling_resistance"), "rolling_resistance", {0.4}), trial);
  ASSERT_EQ(plain.values.size(), directed.values.size());
  for (std::size_t i = 0; i < plain.values.size(); ++i) EXPECT_NEAR(plain.values[i], directed.values[i], 1e-4);
}

TEST(Restitution, ReturnsItsShareOfWhatTheSceneLoses) {
  Scene scene = test::ballScene({.name = "ball", .restitution = 0.5, .position_m = {0, 0, 0.5425}}, 0.001);
  scene = test::withEffect(scene, effect("restitution"), "restitution", {0.4});
  World world(scene, 1);
  const double fall = std::sqrt(2 * 0.5 / test::g), e = 0.5 + 0.5 * 0.4;
  world.advance(test::commands(scene, 0), std::round((fall + e * fall) * 1000) / 1000);
  EXPECT_NEAR(e * e * 0.5, world.ball(0).position_m.z() - 0.0425, 0.01);  // at the top of its bounce
}

TEST(ContactCompliance, LetsABoxSinkByItsWeight) {
  // Four points carry 0.4 kg: each sinks m·g/4·(1/k0 + c).
  test::Trial trial = test::creeping(0, 0, 0);
  const double c = 1e-3;
  const Scene scene = test::withEffect(trial.scene, effect("contact_compliance"), "contact_compliance", {c, 20});
  World world(scene, 1);
  world.advance(test::commands(scene, 0), 2);
  const double k = 1 / (1 / 2e4 + c);
  EXPECT_NEAR(0.05 - 0.4 * test::g / (4 * k), world.robot(0).base.translation().z(), 2e-5);
}

TEST(Slip, LetsABoxCreepByTheForceThatPullsIt) {
  // Each of four points takes a quarter of the force F = m·a: v = s·F/4.
  const test::Trial trial = test::creeping(1, 0, 0);
  const Scene scene = test::withEffect(trial.scene, effect("slip"), "slip", {0.2});
  World world(scene, 1);
  world.advance(test::commands(scene, 0), 0.4);
  const double before = world.robot(0).base.translation().x();
  world.advance(test::commands(scene, 0), 0.4);
  EXPECT_NEAR(0.2 * 0.4 * 1 / 4, (world.robot(0).base.translation().x() - before) / 0.4, 4e-4);
}

TEST(AnisotropicSlip, CreepsAlongItsDirectionAlone) {
  const test::Trial trial = test::creeping(1, 0, 0);
  const double angle = 0.6;
  const Scene scene = test::withEffect(trial.scene, effect("anisotropic_slip"), "anisotropic_slip", {0.4, angle});
  World world(scene, 1);
  world.advance(test::commands(scene, 0), 0.4);
  const Eigen::Vector3d before = world.robot(0).base.translation();
  world.advance(test::commands(scene, 0), 0.4);
  const Eigen::Vector3d way = world.robot(0).base.translation() - before;
  EXPECT_NEAR(angle, std::atan2(way.y(), way.x()), 0.03);
  EXPECT_NEAR(0.4 * 0.4 * std::cos(angle) / 4, way.head<2>().norm() / 0.4, 8e-4);
}

TEST(DcMotor, BrakesWhenItsWindingIsShortedAfterSwitchingOff) {
  // ω = ω0·exp(−kt²/(R·I)·t)
  Drive motor{.kind = Drive::Kind::dcMotor};
  motor.torqueConstant_nm_a = 0.3;
  motor.resistance_ohm = 5;
  for (const double braking : {0.0, 1.0}) {
    motor.offBraking = braking;
    const Scene scene = test::sceneOf(test::robot(test::wheelModel(2e-3), false, motor), 0.001);
    World world(scene, 1);
    world.setRobot(0, scene.robots[0].start, {0, 0, 0}, {0, 0, 0}, Numbers{0}, Numbers{5});
    auto inputs = test::commands(scene, 0);
    inputs[0][0].enabled = false;
    world.advance(inputs, 0.1);
    EXPECT_NEAR(5 * std::exp(-braking * 0.3 * 0.3 / 5 / 2e-3 * 0.1), world.robot(0).rate[0], 0.02);
  }
}

}  // namespace
}  // namespace btr
