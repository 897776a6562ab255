// A ball on carpet, a ball in flight: seen by a camera, set off by hand.
#include <cmath>

#include "tests/prove/blind_world.h"

namespace btr::prove {
namespace {

constexpr int keptBack = 2;

BlindWorld ballWorld(Random& random) {
  BlindWorld world;
  BallSpec ball;
  ball.name = "ball";
  ball.radius_m = random.uniform(0.03, 0.05);
  ball.mass_kg = drawLog(random, 0.02, 0.1);
  ball.inertiaFactor = random.chance(0.5) ? 2.0 / 3.0 : 0.4;
  ball.position_m = {0, 0, ball.radius_m};
  world.scene.balls.push_back(ball);
  world.scene.floor.emplace();
  world.scene.floor->friction = random.uniform(0.4, 1.2);
  const double sample = static_cast<double>(4 + 2 * random.below(5)) / 1000;
  world.scene.controlPeriod_s = sample;
  world.scene.step_s = random.chance(0.5) ? 0.001 : 0.002;
  const Sensor camera = drawSensor(random, 3e-4, 2e-3, 0.5, 2);
  for (std::size_t axis = 0; axis < 3; ++axis)
    addColumn(world, MeasuredColumn::What::ballPosition, axis, std::string("ball.") + "xyz"[axis] + "_m", camera);
  return world;
}

TrialPlan ballTrial(const BlindWorld& world, double length_s) {
  TrialPlan trial;
  trial.sample_s = world.scene.controlPeriod_s;
  trial.rows = static_cast<std::size_t>(std::lround(length_s / trial.sample_s)) + 1;
  trial.ball.radius_m = world.scene.balls[0].radius_m;
  trial.ball.mass_kg = world.scene.balls[0].mass_kg;
  return trial;
}

}  // namespace

BlindWorld drawCarpet(Random& random) {
  BlindWorld world = ballWorld(random);
  // Who knows of rolling resistance measures it; who does not has a ball that never stops.
  if (random.chance(0.6)) {
    world.scene.balls[0].rollingDeceleration_m_s2 = random.uniform(0.15, 0.6);
    calibrate(world, random, "balls.ball.rolling_deceleration_m_s2", world.scene.balls[0].rollingDeceleration_m_s2);
    if (random.chance(0.5)) calibrate(world, random, "floor.friction", world.scene.floor->friction);
  } else {
    calibrate(world, random, "floor.friction", world.scene.floor->friction);
  }
  const double fastest = random.chance(0.12) ? 0.25 : random.uniform(0.8, 2);
  for (int i = 0; i < 7 + keptBack; ++i) {
    TrialPlan trial = ballTrial(world, random.uniform(1.8, 2.6));
    const double speed = fastest * random.uniform(0.3, 1), way = random.uniform(0, 2 * M_PI);
    trial.ball.position_m << random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), trial.ball.radius_m;
    trial.ball.velocity_m_s << speed * std::cos(way), speed * std::sin(way), 0;
    // It already rolls when the camera begins.
    trial.ball.spin_rad_s = Eigen::Vector3d::UnitZ().cross(trial.ball.velocity_m_s) / trial.ball.radius_m;
    trial.settle_s = 0.1;
    world.trials.push_back(trial);
  }
  keepBack(world, keptBack);
  return world;
}

BlindWorld drawFlight(Random& random) {
  BlindWorld world = ballWorld(random);
  const bool bounces = random.chance(0.6);
  if (bounces) {
    world.scene.step_s = 0.0005;  // a bounce is a matter of its instant
    world.scene.floor->restitution = random.uniform(0.4, 0.8);
    calibrate(world, random, "floor.restitution", world.scene.floor->restitution);
    world.scene.calibrate.back().maximum = 1;
    if (random.chance(0.4)) calibrate(world, random, "floor.friction", world.scene.floor->friction);
  } else {
    // The scale of the camera's picture is not trusted.
    calibrate(world, random, "gravity_m_s2.z", -9.81);
  }
  for (int i = 0; i < 8 + keptBack; ++i) {
    TrialPlan trial = ballTrial(world, bounces ? random.uniform(0.7, 1.1) : random.uniform(0.5, 0.7));
    const double way = random.uniform(0, 2 * M_PI), out = random.uniform(0.3, 3);
    const double rise = bounces ? random.uniform(0, 1.5) : random.uniform(2, 3.5);
    trial.ball.position_m << 0, 0, bounces ? random.uniform(0.3, 0.8) : 1.2;
    trial.ball.velocity_m_s << out * std::cos(way), out * std::sin(way), rise;
    world.trials.push_back(trial);
  }
  keepBack(world, keptBack);
  return world;
}

}  // namespace btr::prove
