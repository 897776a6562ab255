// What can be known of the world from outside: sensors, poses, energy, faults, rows of a trace.
#include <algorithm>
#include <cmath>

#include "core/sim/contact/obstacle_shape.h"
#include "core/sim/contact/ray.h"
#include "core/sim/world/world_impl.h"

namespace btr {
namespace {
using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double fastest_m_s = 50, fastestSpin_rad_s = 500, farthestPlace_m = 100;

std::string faultOf(const std::string& name, const Vector3d& position, const Vector3d& velocity, const Vector3d& spin) {
  if (!position.allFinite() || !velocity.allFinite() || !spin.allFinite()) return name + " is not finite";
  if (velocity.norm() > fastest_m_s) return name + " moves at " + toText(velocity.norm()) + " m/s";
  if (spin.norm() > fastestSpin_rad_s) return name + " spins at " + toText(spin.norm()) + " rad/s";
  if (position.norm() > farthestPlace_m) return name + " is " + toText(position.norm()) + " m away";
  return {};
}

// Links whose contacts a trace keeps: the ends of limbs that can touch something.
bool isPaw(const RobotModel& model, std::size_t link) {
  for (const auto& joint : model.joints)
    if (joint.parentLink == static_cast<int>(link)) return false;
  for (const auto& shape : model.links[link].shapes)
    if (shape.collides) return true;
  return false;
}

std::string accelerometerName(const WorldRobot& robot) {
  for (const auto& sensor : robot.scene->model.sensors)
    if (sensor.kind == Sensor::Kind::accelerometer) return sensor.name;
  return {};
}

void push(std::vector<double>& row, const Vector3d& v) { row.insert(row.end(), {v.x(), v.y(), v.z()}); }

// One of the two quaternions of a rotation: w ≥ 0.
void push(std::vector<double>& row, const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0 ? -1 : 1;
  row.insert(row.end(), {sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z()});
}

}  // namespace

void World::Impl::checkFault() {
  if (!fault.empty()) return;
  for (const auto& robot : robots)
    for (const auto& body : robot.body->bodies) {
      const std::string& link = robot.scene->model.links[static_cast<std::size_t>(body.firstLink)].name;
      if (body.velocity_m_s.squaredNorm() <= fastest_m_s * fastest_m_s &&
          body.spin_rad_s.squaredNorm() <= fastestSpin_rad_s * fastestSpin_rad_s &&
          body.pose.translation().squaredNorm() <= farthestPlace_m * farthestPlace_m)
        continue;
      fault = faultOf(robot.scene->name + "." + link, body.pose.translation(), body.velocity_m_s, body.spin_rad_s);
      if (!fault.empty()) return;
    }
  for (const auto& ball : balls) {
    fault = faultOf(ball.spec->name, ball.state.position_m, ball.state.velocity_m_s, ball.state.spin_rad_s);
    if (!fault.empty()) return;
  }
  for (const auto& obstacle : obstacles) {
    if (!obstacle.id) continue;
    const ObstacleState& state = obstacle.state;
    fault = faultOf(obstacle.spec->name, state.pose.translation(), state.velocity_m_s, state.spin_rad_s);
    if (!fault.empty()) return;
  }
}

void World::Impl::sense(WorldRobot& robot, double dt) {
  for (std::size_t j = 0; j < robot.drives.size(); ++j) {
    JointDrive& drive = robot.drives[j];
    const RobotJoint& joint = robot.body->joints[j];
    const Drive& spec = robot.scene->drives[static_cast<std::size_t>(joint.modelJoint)];
    drive.measured = joint.position + (spec.recordedAtMotor ? drive.motorAhead : 0);
    if (!drive.effects.empty())
      drive.measured = drive.effects.measured(drive.measured, loopStateOf(robot, j, stateOf(robot, j, time())), dt);
  }
  // Specific force: the mean acceleration since the last sample minus gravity, in the sensor's axes.
  if (robot.accelerometerLink < 0) return;
  const Isometry3d sensor = robot.body->linkPose(robot.accelerometerLink) * robot.accelerometer;
  const Vector3d velocity = robot.body->pointVelocity(robot.accelerometerLink, sensor.translation());
  const Vector3d acceleration = dt > 0 ? Vector3d((velocity - robot.accelerometerVelocity_m_s) / dt) : Vector3d::Zero();
  robot.accelerometerVelocity_m_s = velocity;
  robot.specificForce_m_s2 = sensor.linear().transpose() * (acceleration - scene.gravity_m_s2);
}

RobotReadings World::robot(std::size_t index) const {
  RobotReadings readings;
  read(index, readings);
  return readings;
}

void World::read(std::size_t index, RobotReadings& readings) const {
  const WorldRobot& robot = impl_->robots.at(index);
  readings.base = robot.body->base();
  const bool moves = !robot.body->fixedBase();
  readings.baseVelocity_m_s =
      moves ? robot.body->pointVelocity(0, readings.base.translation()) : Vector3d(Vector3d::Zero());
  readings.baseSpin_rad_s = moves ? robot.body->bodies[0].spin_rad_s : Vector3d(Vector3d::Zero());
  const std::size_t joints = robot.scene->model.joints.size();
  readings.position.assign(joints, 0);
  readings.rate.assign(joints, 0);
  readings.torque.assign(joints, 0);
  for (std::size_t j = 0; j < robot.drives.size(); ++j) {
    const auto model = static_cast<std::size_t>(robot.body->joints[j].modelJoint);
    readings.position[model] = robot.drives[j].measured;
    readings.rate[model] =
        robot.scene->drives[model].recordedAtMotor ? robot.drives[j].motorRate : robot.drives[j].rate;
    readings.torque[model] = robot.drives[j].torque;
  }
  readings.contact = robot.contact;
  readings.accelerometer_m_s2 = robot.specificForce_m_s2;
}

std::vector<double> World::jointPositions(std::size_t index) const {
  const Articulation& body = *impl_->robots.at(index).body;
  std::vector<double> positions(impl_->robots[index].scene->model.joints.size(), 0);
  for (const RobotJoint& joint : body.joints) positions[static_cast<std::size_t>(joint.modelJoint)] = joint.position;
  return positions;
}

void World::measureAcceleration(std::size_t index) {
  WorldRobot& robot = impl_->robots.at(index);
  if (robot.accelerometerLink >= 0) return;
  robot.accelerometerLink = 0;
  impl_->sense(robot, 0);
}

double World::rayDistance_m(const Vector3d& origin, const Vector3d& direction, double farthest_m,
                            std::size_t robotLeftOut) const {
  double least = farthest_m;
  const auto meet = [&](const Collider& collider, const Isometry3d& solid) {
    const Vector3d way = solid.translation() - origin;
    const double along = way.dot(direction), bound = collider.bound_m;
    if (along < -bound || along > least + bound || way.squaredNorm() - along * along > bound * bound) return;
    if (const auto distance = rayDistance(collider, solid, origin, direction)) least = std::min(least, *distance);
  };
  if (impl_->scene.floor && direction.z() < 0) least = std::min(least, std::max(0.0, -origin.z() / direction.z()));
  for (const WorldObstacle& obstacle : impl_->obstacles) meet(obstacle.solid->collider(), obstacle.solid->pose());
  for (const WorldBall& ball : impl_->balls) {
    Collider sphere;
    sphere.bound_m = ball.spec->radius_m;
    sphere.size_m.x() = ball.spec->radius_m;
    meet(sphere, ball.pose);
  }
  for (std::size_t i = 0; i < impl_->robots.size(); ++i) {
    if (i == robotLeftOut) continue;
    const Articulation& body = *impl_->robots[i].body;
    for (const RobotBody& part : body.bodies)
      for (const Collider& collider : part.colliders) meet(collider, part.pose * collider.pose);
    for (const Collider& collider : body.baseColliders) meet(collider, body.poseOf(-1) * collider.pose);
  }
  return least;
}

std::vector<Isometry3d> World::linkPoses(std::size_t robot) const { return impl_->robots.at(robot).body->linkPoses(); }
BallState World::ball(std::size_t index) const { return impl_->balls.at(index).state; }
Isometry3d World::ballPose(std::size_t index) const { return impl_->balls.at(index).pose; }
const ObstacleState& World::obstacle(std::size_t index) const { return impl_->obstacles.at(index).state; }
bool World::ballTouched(std::size_t index) const { return impl_->balls.at(index).touched; }
double World::time() const { return impl_->time(); }
void World::startAt(double time_s) { impl_->start_s = time_s; }
std::string World::fault() const { return impl_->fault; }

void World::measureForces(bool on) { impl_->contacts.measureForces(on); }
const std::vector<ContactForce>& World::contactForces() const { return impl_->contacts.forces(); }
Eigen::Vector3d World::floorForce_n() const { return impl_->contacts.floorForce_n(); }

double World::energy() const {
  double sum = 0;
  const Vector3d& gravity = impl_->scene.gravity_m_s2;
  for (const auto& robot : impl_->robots) {
    for (const auto& body : robot.body->bodies) {
      const Vector3d spin = body.pose.linear().transpose() * body.spin_rad_s;
      const double ring = spin.dot(body.ringAxis);
      sum += body.mass_kg * (body.velocity_m_s.squaredNorm() / 2 - gravity.dot(body.pose.translation())) +
             spin.dot(body.inertia_kg_m2 * spin) / 2 + body.ringInertia_kg_m2 * ring * ring / 2;
    }
    for (std::size_t j = 0; j < robot.drives.size(); ++j) {
      const RobotJoint& joint = robot.body->joints[j];
      const Drive& spec = robot.scene->drives[static_cast<std::size_t>(joint.modelJoint)];
      const double rate = spec.hasGear() ? robot.drives[j].motorRate : joint.rate, ahead = robot.drives[j].motorAhead;
      sum += spec.rotorInertia_kg_m2 * rate * rate / 2;
      if (spec.gearCompliance > 0 && spec.gearPlay == 0) sum += ahead * ahead / spec.gearCompliance / 2;
    }
  }
  for (const auto& ball : impl_->balls) {
    const double m = ball.spec->mass_kg, r = ball.spec->radius_m;
    sum += m * (ball.state.velocity_m_s.squaredNorm() / 2 - gravity.dot(ball.state.position_m)) +
           ball.spec->inertiaFactor * m * r * r * ball.state.spin_rad_s.squaredNorm() / 2;
  }
  for (const auto& obstacle : impl_->obstacles) {
    if (!obstacle.id) continue;
    const ObstacleState& state = obstacle.state;
    const Inertial inertial = obstacleInertial(*obstacle.spec);
    const Vector3d spin = state.pose.linear().transpose() * state.spin_rad_s;
    const Vector3d centre = state.pose.linear() * inertial.centreOfMass_m;
    const Vector3d velocity = state.velocity_m_s + state.spin_rad_s.cross(centre);
    sum += inertial.mass_kg * (velocity.squaredNorm() / 2 - gravity.dot(state.pose.translation() + centre)) +
           spin.dot(inertial.inertia_kg_m2 * spin) / 2;
  }
  return sum;
}

std::vector<std::string> World::channels() const {
  std::vector<std::string> names{"time_s"};
  for (const auto& robot : impl_->robots) {
    const RobotModel& model = robot.scene->model;
    const std::string prefix = robot.scene->name + ".";
    for (const char* quantity : {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"})
      names.push_back(prefix + "base." + quantity);
    for (const auto& joint : robot.body->joints) {
      const std::string at = prefix + model.joints[static_cast<std::size_t>(joint.modelJoint)].name + ".";
      if (joint.slides)
        names.insert(names.end(), {at + "command_m", at + "position_m", at + "velocity_m_s", at + "force_n"});
      else
        names.insert(names.end(), {at + "command_rad", at + "position_rad", at + "velocity_rad_s", at + "torque_nm"});
    }
    for (std::size_t link = 0; link < model.links.size(); ++link)
      if (isPaw(model, link)) names.push_back(prefix + model.links[link].name + ".contact");
    if (robot.hasAccelerometer)
      for (const char* axis : {"ax_m_s2", "ay_m_s2", "az_m_s2"})
        names.push_back(prefix + accelerometerName(robot) + "." + axis);
  }
  for (const auto& ball : impl_->balls)
    for (const char* quantity : {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"})
      names.push_back(ball.spec->name + "." + quantity);
  for (const auto& obstacle : impl_->obstacles)
    if (obstacle.id)
      for (const char* quantity : {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"})
        names.push_back(obstacle.spec->name + "." + quantity);
  return names;
}

void World::sample(std::vector<double>& row) const {
  row.push_back(time());
  for (const auto& robot : impl_->robots) {
    const RobotModel& model = robot.scene->model;
    const Isometry3d base = robot.body->base();
    push(row, base.translation());
    push(row, Eigen::Quaterniond(base.linear()));
    for (std::size_t j = 0; j < robot.drives.size(); ++j) {
      const JointDrive& drive = robot.drives[j];
      const auto joint = static_cast<std::size_t>(robot.body->joints[j].modelJoint);
      const double rate = robot.scene->drives[joint].recordedAtMotor ? drive.motorRate : drive.rate;
      row.insert(row.end(), {drive.command, drive.measured, rate, drive.torque});
    }
    for (std::size_t link = 0; link < model.links.size(); ++link)
      if (isPaw(model, link)) row.push_back(robot.contact[link]);
    if (robot.hasAccelerometer) push(row, robot.specificForce_m_s2);
  }
  for (const auto& ball : impl_->balls) {
    push(row, ball.state.position_m);
    push(row, Eigen::Quaterniond(ball.pose.linear()));
  }
  for (const auto& obstacle : impl_->obstacles) {
    if (!obstacle.id) continue;
    push(row, obstacle.state.pose.translation());
    push(row, Eigen::Quaterniond(obstacle.state.pose.linear()));
  }
}

}  // namespace btr
