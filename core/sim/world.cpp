#include "core/sim/world.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/sim/world/world_impl.h"

namespace btr {

World::Impl::Impl(const Scene& givenScene, std::uint64_t seed) : scene(givenScene), session(seed) {
  const dWorldID world = session.world();
  dWorldSetGravity(world, scene.gravity_m_s2.x(), scene.gravity_m_s2.y(), scene.gravity_m_s2.z());

  for (const auto& sceneRobot : scene.robots) {
    WorldRobot robot;
    robot.scene = &sceneRobot;
    robot.body = std::make_unique<Articulation>(world, sceneRobot);
    robot.drives.resize(robot.body->joints.size());
    robot.couples = std::ranges::any_of(robot.body->joints, [](const RobotJoint& joint) { return joint.leader >= 0; });
    if (!robot.body->movesInOde()) {
      robot.alone = std::make_unique<JointSpace>();
      robot.alone->begin(*robot.body);
      robot.rows.resize(robot.drives.size());
      for (const auto& body : robot.body->bodies) dBodyDisable(body.id);
    }
    robot.contact.assign(sceneRobot.model.links.size(), 0);
    for (const auto& sensor : sceneRobot.model.sensors)
      if (sensor.kind == Sensor::Kind::accelerometer && robot.accelerometerLink < 0) {
        robot.hasAccelerometer = true;
        robot.accelerometerLink = sensor.link;
        robot.accelerometer = sensor.pose;
      }
    for (std::size_t j = 0; j < robot.drives.size(); ++j) {
      robot.drives[j].command = robot.body->joints[j].position;
      robot.drives[j].rate = robot.drives[j].motorRate = robot.body->joints[j].rate;
    }
    robots.push_back(std::move(robot));
  }
  for (const auto& spec : scene.balls) {
    WorldBall ball;
    ball.spec = &spec;
    ball.id = dBodyCreate(world);
    const double inertia = spec.inertiaFactor * spec.mass_kg * spec.radius_m * spec.radius_m;
    dMass mass;
    dMassSetParameters(&mass, spec.mass_kg, 0, 0, 0, inertia, inertia, inertia, 0, 0, 0);
    dBodySetMass(ball.id, &mass);
    const bool resists = spec.rollingDeceleration_m_s2 > 0 || spec.directedRolling_m_s2 != std::array<double, 3>{};
    if (resists && scene.floor) {
      ball.rolling = dJointCreateAMotor(world, nullptr);
      dJointAttach(ball.rolling, ball.id, nullptr);
      dJointSetAMotorMode(ball.rolling, dAMotorUser);
      dJointSetAMotorNumAxes(ball.rolling, 2);
    }
    BallState start;
    start.position_m << spec.position_m[0], spec.position_m[1], spec.position_m[2];
    start.velocity_m_s << spec.velocity_m_s[0], spec.velocity_m_s[1], spec.velocity_m_s[2];
    start.spin_rad_s << spec.spin_rad_s[0], spec.spin_rad_s[1], spec.spin_rad_s[2];
    placeBall(ball, start);
    balls.push_back(std::move(ball));
  }

  makeObstacles();
  makeSolids();

  // Effects to the joints and balls that they act on; those of floor and world that push balls act on all of them.
  for (const auto& effect : scene.effects) {
    for (auto& robot : robots)
      for (std::size_t j = 0; j < robot.drives.size(); ++j) {
        const auto model = static_cast<std::size_t>(robot.body->joints[j].modelJoint);
        if (effect.effect->onEveryJoint() ||
            effect.at == robot.scene->name + "." + robot.scene->model.joints[model].name) {
          robot.drives[j].effects.add(effect);
          robot.hasEffects = true;
        }
      }
    for (auto& ball : balls)
      if (effect.at == ball.spec->name || effect.at == "floor" || effect.at == "world") ball.effects.push_back(&effect);
  }
  inOde = !balls.empty() || std::ranges::any_of(obstacles, [](const WorldObstacle& o) { return o.id != nullptr; }) ||
          std::ranges::any_of(robots, [](const WorldRobot& robot) { return !robot.alone; });
  for (auto& robot : robots) sense(robot, 0);
  checkFault();
}

void World::Impl::advance(const std::vector<std::vector<JointInput>>& inputs, double duration) {
  if (inputs.size() != robots.size()) throw std::logic_error("World::advance: inputs for each robot");
  for (std::size_t i = 0; i < robots.size(); ++i)
    if (inputs[i].size() != robots[i].scene->model.joints.size())
      throw std::logic_error("World::advance: an input for each joint of the model");
  if (!(duration > 0) || duration > 1e6) throw std::logic_error("World::advance: a positive duration");
  if (!fault.empty()) return;
  until = time() + duration;

  // The scene's steps where a whole number of them fits, else equal steps that are a little smaller.
  long count = std::lround(duration / scene.step_s);
  const bool whole = count >= 1 && std::abs(static_cast<double>(count) * scene.step_s - duration) <= 1e-6 * duration;
  if (!whole) count = static_cast<long>(std::ceil(duration / scene.step_s));
  const double stepSize = whole ? scene.step_s : duration / static_cast<double>(count);
  for (long i = 0; i < count && fault.empty(); ++i) {
    const int parts = scene.nearSubsteps > 1 && !robotsStopped && nearBall(inputs, stepSize) ? scene.nearSubsteps : 1;
    const double h = stepSize / parts, begin = time() + (whole ? 0 : static_cast<double>(i) * stepSize);
    for (int part = 0; part < parts && fault.empty(); ++part) step(inputs, begin + part * h, h);
    if (whole) ++steps;
  }
  // Time is counted in whole steps so that it does not gather rounding; what lies between is added as it is.
  if (!whole) start_s += duration;
  if (!inOde) placeRobots();
  if (fault.empty() && !robotsStopped)
    for (auto& robot : robots) sense(robot, duration);
}

void World::Impl::driveRobots(const std::vector<std::vector<JointInput>>& inputs, double now, double h) {
  for (auto& robot : robots) {
    // Leapfrog: positions belong to the steps' ends, velocities to their middles. A rig that was put somewhere at an
    // instant gets half of the first step's forces. (Free robots are corrected in flight instead, and contacts know no
    // halves.)
    robot.kick = robot.first && robot.body->fixedBase() ? 0.5 : 1;
    robot.first = false;
    robot.body->addRingTorques();
    if (robot.kick < 1 && !robot.alone)
      for (const auto& body : robot.body->bodies) {
        const Eigen::Vector3d force = (robot.kick - 1) * body.mass_kg * scene.gravity_m_s2;
        dBodyAddForce(body.id, force.x(), force.y(), force.z());
      }
  }
  for (auto& robot : robots)
    if (robot.hasEffects || robot.alone) weighLoads(robot);
  for (auto& robot : robots)
    if (robot.couples && !robot.alone) robot.coupled.prepare(*robot.body);
  for (std::size_t i = 0; i < robots.size(); ++i)
    for (std::size_t j = 0; j < robots[i].drives.size(); ++j)
      driveJoint(robots[i], j, inputs[i][static_cast<std::size_t>(robots[i].body->joints[j].modelJoint)], now, h);
}

void World::Impl::step(const std::vector<std::vector<JointInput>>& inputs, double now, double h) {
  if (!robotsStopped) driveRobots(inputs, now, h);
  if (inOde) {
    makeContacts(h);
    for (auto& ball : balls) driveBall(ball, now, h);
    pullAll(h);
    try {
      session.step(h);
    } catch (const OdeFailure& failure) {
      fault = failure.what();
      return;
    }
    contacts.clear();
  }
  if (!robotsStopped && !takeRobots(h)) return;
  for (auto& ball : balls) {
    const BallState before = ball.state;
    readBall(ball, now + h);
    if (ball.touched || ball.state.onFloor) continue;
    ball.state.position_m += h / 2 * (before.velocity_m_s - ball.state.velocity_m_s);
    bounce(ball, before, h);
    const Eigen::Vector3d& p = ball.state.position_m;
    dBodySetPosition(ball.id, p.x(), p.y(), p.z());
    ball.pose.translation() = p;
  }
  settleObstacles(h);
  if (inOde) checkFault();
}

/// Where nothing moves in ODE, within an advance nothing asks where bodies are but the joints themselves.
void World::Impl::placeRobots() {
  for (auto& robot : robots) {
    robot.alone->place(*robot.body);
    robot.alone->placeVelocities(*robot.body);
  }
  checkFault();
}

/// What the step made of the robots. False (and a fault) if one of them cannot be moved.
bool World::Impl::takeRobots(double h) {
  for (auto& robot : robots) {
    for (std::size_t j = 0; j < robot.drives.size(); ++j) robot.drives[j].rateBefore = robot.body->joints[j].rate;
    if (!robot.alone) {
      robot.body->refresh();
    } else if (!robot.alone->step(*robot.body, robot.rows, robot.kick, h)) {
      fault = robot.scene->name + " cannot be moved: its forces are not finite";
      return false;
    } else if (inOde || robot.alone->needsPoses()) {
      robot.alone->place(*robot.body);
      if (inOde) robot.alone->placeVelocities(*robot.body);
    }
    // ODE moves bodies by their new velocity. Where only gravity acts, the mean of both is the exact parabola.
    if (!robot.touches && !robot.body->fixedBase()) robot.body->shift(-h * h / 2 * scene.gravity_m_s2);
    robot.body->updateRings();
    robot.allDrives = 0;
    if (robot.couples && !robot.alone) loadLeaders(robot, h);
    for (std::size_t j = 0; j < robot.drives.size(); ++j) {
      const RobotJoint& joint = robot.body->joints[j];
      JointDrive& drive = robot.drives[j];
      drive.torque = drive.row.torqueAt(joint.solvedRate);
      if (drive.gear.elastic()) drive.torque = drive.gear.turn(drive.motorAhead, drive.motorRate, joint.solvedRate);
      robot.allDrives += std::abs(drive.torque);
      drive.rate = joint.rate;
      if (!robot.body->fixedBase()) continue;
      // From the step's middle to its end, unless that would turn the motion round.
      const double end = joint.rate + (joint.solvedRate - drive.rateBefore) / 2 / robot.kick;
      if (end * joint.rate > 0) drive.rate = end;
    }
  }
  return true;
}

World::World(const Scene& scene, std::uint64_t seed) : impl_(std::make_unique<Impl>(scene, seed)) {}
World::~World() = default;

namespace {

/// Where its joints and its root frame are and how they move; nothing that it remembers.
void place(WorldRobot& robot, const Eigen::Isometry3d& base, const Eigen::Vector3d& velocity,
           const Eigen::Vector3d& spin, std::span<const double> joints, std::span<const double> rates) {
  robot.body->set(base, velocity, spin, joints, rates);
  if (robot.alone) robot.alone->begin(*robot.body);
  robot.first = true;
}

}  // namespace

void World::setRobot(std::size_t index, const Eigen::Isometry3d& base, const Eigen::Vector3d& velocity,
                     const Eigen::Vector3d& spin, std::span<const double> positions, std::span<const double> rates) {
  WorldRobot& robot = impl_->robots.at(index);
  place(robot, base, velocity, spin, positions, rates);
  for (std::size_t j = 0; j < robot.drives.size(); ++j) {
    JointDrive& drive = robot.drives[j];
    drive.effects.reset();
    drive.integral = drive.torque = drive.motorAhead = drive.couplingLoad = 0;
    drive.dryRow = drive.passiveRow = robot.body->joints[j].extra != nullptr;
    drive.command = robot.body->joints[j].position;
    drive.rate = drive.motorRate = robot.body->joints[j].rate;
    drive.gear = {};
    drive.fresh = true;
  }
  robot.allDrives = 0;
  impl_->sense(robot, 0);
  impl_->checkFault();
}

void World::moveRobot(std::size_t index, const Eigen::Isometry3d& base, const Eigen::Vector3d& velocity,
                      const Eigen::Vector3d& spin, std::span<const double> positions, std::span<const double> rates) {
  WorldRobot& robot = impl_->robots.at(index);
  std::vector<double> joints(positions.begin(), positions.end());
  for (std::size_t j = 0; j < robot.drives.size(); ++j)
    joints.at(static_cast<std::size_t>(robot.body->joints[j].modelJoint)) +=
        robot.body->joints[j].position - robot.drives[j].measured;
  std::vector<double> before(robot.drives.size());
  for (std::size_t j = 0; j < before.size(); ++j) before[j] = robot.body->joints[j].position;
  place(robot, base, velocity, spin, joints, rates);
  for (std::size_t j = 0; j < robot.drives.size(); ++j) {
    JointDrive& drive = robot.drives[j];
    drive.effects.moved(robot.body->joints[j].position - before[j]);
    const double rate = robot.body->joints[j].rate;
    drive.motorRate += rate - drive.rate;
    drive.rate = rate;
    drive.gear = {};
  }
  impl_->sense(robot, 0);
  impl_->checkFault();
}

void World::rest(std::size_t index) {
  WorldRobot& robot = impl_->robots.at(index);
  impl_->weighLoads(robot);
  for (std::size_t j = 0; j < robot.drives.size(); ++j) {
    JointDrive& drive = robot.drives[j];
    const Drive& spec = robot.scene->drives[static_cast<std::size_t>(robot.body->joints[j].modelJoint)];
    if (spec.kind != Drive::Kind::servo) continue;
    drive.effects.rest(impl_->stateOf(robot, j, 0));
    drive.motorAhead = -drive.load * spec.gearCompliance;
    if (spec.gearPlay > 0 && drive.load != 0) drive.motorAhead -= std::copysign(spec.gearPlay / 2, drive.load);
  }
}

void World::setObstacle(std::size_t index, const ObstacleState& state) {
  impl_->placeObstacle(impl_->obstacles.at(index), state);
  impl_->checkFault();
}

void World::setBall(std::size_t index, const BallState& state) {
  impl_->placeBall(impl_->balls.at(index), state);
  impl_->checkFault();
}

void World::advance(const std::vector<std::vector<JointInput>>& inputs, double duration) {
  impl_->advance(inputs, duration);
}

}  // namespace btr
