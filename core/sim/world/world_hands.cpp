// What reaches into a world from outside while it runs: springs that pull, and its memory.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "core/sim/engine/ode_body.h"
#include "core/sim/world/world_impl.h"

namespace btr {
namespace {
using Eigen::Isometry3d;
using Eigen::Vector3d;

BodyMemory memoryOf(const RobotBody& body) {
  return {body.pose.translation(), body.pose.linear(), body.velocity_m_s, body.spin_rad_s};
}

void rememberAttitude(dBodyID body, const BodyMemory& memory) {
  if (body && memory.attitude) setAttitude(body, *memory.attitude);
}

template <class Things>
auto* named(Things& things, const std::string& name) {
  const auto found = std::ranges::find_if(things, [&](const auto& thing) { return thing.spec->name == name; });
  return found == things.end() ? nullptr : &*found;
}

}  // namespace

void World::Impl::pullAll(double h) {
  pullForces_n.assign(pulls.size(), Vector3d::Zero());
  for (std::size_t i = 0; i < pulls.size(); ++i) {
    const Pull& pull = pulls[i];
    dBodyID id = nullptr;
    Vector3d point;
    if (pull.what == Pull::What::ball) {
      id = balls[pull.object].id;
      point = balls[pull.object].pose * pull.point_m;
    } else if (pull.what == Pull::What::obstacle) {
      id = obstacles[pull.object].id;
      point = obstacles[pull.object].state.pose * pull.point_m;
    } else {
      const Articulation& body = *robots[pull.object].body;
      const int link = static_cast<int>(pull.link);
      id = body.idOf(body.bodyOfLink(link));
      point = body.linkPose(link) * pull.point_m;
    }
    if (!id) continue;  // what never moves
    // Not only gravity acts on it: it does not fly along the exact parabola.
    if (pull.what == Pull::What::ball)
      balls[pull.object].touched = true;
    else if (pull.what == Pull::What::obstacle)
      obstacles[pull.object].touched = true;
    else
      robots[pull.object].touches = true;
    dVector3 v;
    dBodyGetPointVel(id, point.x(), point.y(), point.z(), v);
    dMass mass;
    dBodyGetMass(id, &mass);
    const double k = std::min(pull.stiffness_n_m, mass.mass / (4 * h * h));
    const double damping = std::min(2 * std::sqrt(k * mass.mass), mass.mass / (4 * h));
    Vector3d force = k * (pull.target_m - point) - damping * Vector3d(v[0], v[1], v[2]);
    if (const double size = force.norm(); size > pull.most_n) force *= pull.most_n / size;
    dBodyAddForceAtPos(id, force.x(), force.y(), force.z(), point.x(), point.y(), point.z());
    pullForces_n[i] = force;
  }
}

void World::setPulls(std::vector<Pull> pulls) {
  for (const Pull& pull : pulls) {
    if (pull.what == Pull::What::link)
      (void)impl_->robots.at(pull.object).scene->model.links.at(pull.link);
    else if (pull.what == Pull::What::ball)
      (void)impl_->balls.at(pull.object);
    else
      (void)impl_->obstacles.at(pull.object);
  }
  impl_->pulls = std::move(pulls);
  impl_->pullForces_n.assign(impl_->pulls.size(), Vector3d::Zero());
}

Vector3d World::pullForce_n(std::size_t pull) const { return impl_->pullForces_n.at(pull); }

WorldMemory World::memory(Detail detail) const {
  const auto addAttitude = [detail](BodyMemory& of, dBodyID body) {
    if (body && detail == Detail::everything) of.attitude = attitudeOf(body);
  };
  WorldMemory memory{impl_->start_s, impl_->steps, dRandGetSeed()};
  for (const WorldRobot& robot : impl_->robots) {
    RobotMemory of;
    of.name = robot.scene->name;
    of.base = robot.body->base();
    for (const RobotBody& body : robot.body->bodies) {
      of.bodies.push_back(memoryOf(body));
      addAttitude(of.bodies.back(), body.id);
      of.ringAxes.push_back(body.ringAxis);
    }
    for (std::size_t j = 0; j < robot.drives.size(); ++j) {
      const JointDrive& drive = robot.drives[j];
      const RobotJoint& joint = robot.body->joints[j];
      JointMemory at{joint.position,   joint.rate,       joint.solvedRate,  drive.command,  drive.integral,
                     drive.rate,       drive.rateBefore, drive.torque,      drive.measured, drive.load,
                     drive.motorAhead, drive.motorRate,  drive.couplingLoad};
      if (robot.alone) {
        at.middleRate = robot.alone->middleRates()[static_cast<Eigen::Index>(j)];
        at.endRate = robot.alone->endRates()[static_cast<Eigen::Index>(j)];
      }
      at.fresh = drive.fresh;
      at.enabled = drive.enabled;
      at.dryRow = drive.dryRow && detail == Detail::everything;
      at.passiveRow = drive.passiveRow && detail == Detail::everything;
      if (detail == Detail::everything) at.extraRows = joint.extraMade;
      at.effects = drive.effects.memory();
      of.joints.push_back(std::move(at));
    }
    of.contact.assign(robot.contact.begin(), robot.contact.end());
    of.first = robot.first;
    of.touches = robot.touches;
    of.allDrives = robot.allDrives;
    of.accelerometerVelocity_m_s = robot.accelerometerVelocity_m_s;
    of.specificForce_m_s2 = robot.specificForce_m_s2;
    memory.robots.push_back(std::move(of));
  }
  for (const WorldBall& ball : impl_->balls) {
    memory.balls.push_back({ball.spec->name,
                            {ball.state.position_m, ball.pose.linear(), ball.state.velocity_m_s, ball.state.spin_rad_s},
                            ball.touched,
                            ball.state.onFloor});
    addAttitude(memory.balls.back().body, ball.id);
  }
  for (const WorldObstacle& obstacle : impl_->obstacles) {
    memory.obstacles.push_back({obstacle.spec->name,
                                {obstacle.state.pose.translation(), obstacle.state.pose.linear(),
                                 obstacle.state.velocity_m_s, obstacle.state.spin_rad_s},
                                obstacle.touched,
                                false});
    addAttitude(memory.obstacles.back().body, obstacle.id);
  }
  return memory;
}

void World::Impl::remakeExtraRows(const WorldMemory& memory) {
  std::vector<std::tuple<const ExtraRowsMemory*, WorldRobot*, std::size_t>> all;
  for (const RobotMemory& of : memory.robots)
    for (WorldRobot& robot : robots)
      if (robot.scene->name == of.name)
        for (std::size_t j = 0; j < of.joints.size(); ++j)
          if (of.joints[j].extraRows) all.emplace_back(&*of.joints[j].extraRows, &robot, j);
  std::sort(all.begin(), all.end(),
            [](const auto& a, const auto& b) { return std::get<0>(a)->order < std::get<0>(b)->order; });
  for (const auto& [rows, robot, joint] : all) robot->body->remakeExtraRows(robot->body->joints[joint], *rows);
}

void World::remember(const WorldMemory& memory) {
  impl_->start_s = memory.start_s;
  impl_->steps = memory.steps;
  dRandSetSeed(memory.odeSeed);
  for (const RobotMemory& of : memory.robots) {
    const auto found = std::ranges::find_if(impl_->robots, [&](const auto& r) { return r.scene->name == of.name; });
    if (found == impl_->robots.end()) continue;
    WorldRobot& robot = *found;
    if (of.bodies.size() != robot.body->bodies.size() || of.joints.size() != robot.drives.size() ||
        of.ringAxes.size() != of.bodies.size() || of.contact.size() != robot.contact.size())
      throw std::logic_error("World::remember: " + of.name + " is another robot");
    // By the way of the joints first, so that what follows from positions is there; then each body where it was.
    std::vector<double> positions(robot.scene->model.joints.size()), rates(positions.size());
    for (std::size_t j = 0; j < of.joints.size(); ++j) {
      const auto model = static_cast<std::size_t>(robot.body->joints[j].modelJoint);
      positions[model] = of.joints[j].position;
      rates[model] = of.joints[j].rate;
    }
    robot.body->set(of.base, Vector3d::Zero(), Vector3d::Zero(), positions, rates);
    robot.body->remember(of.bodies, of.ringAxes);
    if (robot.alone) robot.alone->begin(*robot.body);
    Eigen::VectorXd middle(static_cast<Eigen::Index>(of.joints.size())), end(middle.size());
    for (std::size_t j = 0; j < of.joints.size(); ++j) {
      const JointMemory& at = of.joints[j];
      RobotJoint& joint = robot.body->joints[j];
      joint.position = at.position;
      joint.rate = at.rate;
      joint.solvedRate = at.solvedRate;
      JointDrive& drive = robot.drives[j];
      drive.command = at.command;
      drive.integral = at.integral;
      drive.rate = at.driveRate;
      drive.rateBefore = at.rateBefore;
      drive.torque = at.torque;
      drive.measured = at.measured;
      drive.load = at.load;
      drive.motorAhead = at.motorAhead;
      drive.motorRate = at.motorRate;
      drive.couplingLoad = at.couplingLoad;
      drive.fresh = at.fresh;
      drive.enabled = at.enabled;
      drive.dryRow |= at.dryRow;
      drive.passiveRow |= at.passiveRow;
      drive.effects.remember(at.effects);
      drive.gear = {};
      middle[static_cast<Eigen::Index>(j)] = at.middleRate;
      end[static_cast<Eigen::Index>(j)] = at.endRate;
    }
    if (robot.alone) robot.alone->setRates(middle, end);
    robot.contact.assign(of.contact.begin(), of.contact.end());
    robot.first = of.first;
    robot.touches = of.touches;
    robot.allDrives = of.allDrives;
    robot.accelerometerVelocity_m_s = of.accelerometerVelocity_m_s;
    robot.specificForce_m_s2 = of.specificForce_m_s2;
  }
  impl_->remakeExtraRows(memory);
  for (const ThingMemory& of : memory.balls)
    if (WorldBall* ball = named(impl_->balls, of.name)) {
      Isometry3d pose = Isometry3d::Identity();
      pose.translation() = of.body.position_m;
      pose.linear() = of.body.axes;
      setPose(ball->id, pose);
      rememberAttitude(ball->id, of.body);
      BallState state;
      state.position_m = of.body.position_m;
      state.velocity_m_s = of.body.velocity_m_s;
      state.spin_rad_s = of.body.spin_rad_s;
      state.time = time();
      impl_->placeBall(*ball, state);
      ball->touched = of.touched;
      ball->state.onFloor = of.onFloor;
    }
  for (const ThingMemory& of : memory.obstacles)
    if (WorldObstacle* obstacle = named(impl_->obstacles, of.name)) {
      ObstacleState state;
      state.pose.translation() = of.body.position_m;
      state.pose.linear() = of.body.axes;
      state.velocity_m_s = of.body.velocity_m_s;
      state.spin_rad_s = of.body.spin_rad_s;
      impl_->placeObstacle(*obstacle, state);
      rememberAttitude(obstacle->id, of.body);
      obstacle->touched = of.touched;
    }
  impl_->checkFault();
}

}  // namespace btr
