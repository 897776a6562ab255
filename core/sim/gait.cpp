#include "core/sim/gait.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/spec/error.h"
#include "core/spec/require.h"

namespace btr {
namespace {
using Eigen::Vector3d;

/// Where inverse kinematics begins to look: bent knees.
LegAngles bent(const FourLegs::Leg& leg) { return {0, 0, leg.front ? 1.2 : 1.4}; }

/// The feet of the stance in their hips' frames: as the start gait of the walk stands.
Vector3d standingFoot(const FourLegs::Leg& leg) {
  return leg.front ? Vector3d(0.055, 0.007, -0.105) : Vector3d(-0.050, 0.005, -0.115);
}

LegSolution solveContact(const FourLegs::Leg& leg, const Vector3d& contact, const LegAngles& last) {
  return leg.geometry.solve(contact + Vector3d(0, 0, leg.footRadius_m), last, leg.limits);
}

/// The angles between two points of a path.
LegAngles between(const LegAngles& from, const LegAngles& to, double share) {
  LegAngles result;
  for (std::size_t j = 0; j < 3; ++j) result[j] = from[j] + (to[j] - from[j]) * share;
  return result;
}

SceneRobot& firstRobot(Scene& scene, const std::string& who) {
  if (scene.robots.empty()) throw InputError(who + ": the scene has no robot");
  return scene.robots.front();
}

}  // namespace

Gait::Gait(const FourLegs& dog, const std::array<std::vector<FootPoint>, 4>& paths, const std::array<long, 4>& late,
           long period)
    : frames_(static_cast<std::size_t>(period)) {
  for (std::size_t i = 0; i < 4; ++i) {
    const std::vector<FootPoint>& path = paths[i];
    require(!path.empty() && path.front().frame == 0 && path.back().frame < static_cast<double>(period),
            "key frames from 0 to less than the period");
    // The second round begins where the first ended: the cycle closes in joint space too.
    std::vector<LegAngles> angles(path.size(), bent(dog.legs[i]));
    for (const bool counts : {false, true})
      for (std::size_t n = 0; n < path.size(); ++n) {
        const LegAngles& last = n == 0 && !counts ? angles[0] : angles[n == 0 ? path.size() - 1 : n - 1];
        const LegSolution solution = solveContact(dog.legs[i], path[n].contact_m, last);
        angles[n] = solution.angles;
        if (!counts) continue;
        ++points_;
        if (!solution.feasible()) ++infeasible_;
      }

    std::size_t next = 1;
    for (long frame = 0; frame < period; ++frame) {
      while (next < path.size() && path[next].frame <= static_cast<double>(frame)) ++next;
      const double begin = path[next - 1].frame,
                   end = next < path.size() ? path[next].frame : static_cast<double>(period);
      const double share = (static_cast<double>(frame) - begin) / (end - begin);
      const auto place = static_cast<std::size_t>((frame + late[i]) % period);
      frames_[place][i] = between(angles[next - 1], angles[next % path.size()], share);
    }
  }
}

const std::vector<Parameter>& gaitSettings() {
  static const std::vector<Parameter> settings{
      {"duration_s", "s", "time of the trial, lead-in included", 1, 600, 20},
      {"lead_in_s", "s", "time from the stance to the first point of the gait", 0.1, 5, 0.5},
      {"direction_rad", "rad", "where the feet push the body: 0 ahead, positive left", -3.1416, 3.1416, 0},
      {"turn_rad_s", "rad/s", "rate at which the feet turn the body, positive left", -4, 4, 0}};
  return settings;
}

GaitTask gaitTask(const Values& settings, const std::string& who) {
  const auto value = resolve(gaitSettings(), settings, who);
  if (value[1] >= value[0])
    throw InputError(who + "/lead_in_s", toText(value[1]), "less than duration_s = " + toText(value[0]));
  return {value[0], value[1], value[2], value[3]};
}

FootPlaces::FootPlaces(const FourLegs& dog, const Vector3d& front_m, const Vector3d& rear_m)
    : front_(front_m), rear_(rear_m) {
  const Vector3d reach = dog.legs[0].hip_m + front_m - dog.legs[2].hip_m - rear_m;
  forward_ = Vector3d(reach.x(), 0, reach.z()).normalized();
  up_ = Vector3d(-forward_.z(), 0, forward_.x());
}

Vector3d FootPlaces::stroke(const FourLegs::Leg& leg, const GaitTask& task, double speed_m_s, double time_s,
                            double skew_rad) const {
  const Vector3d place = leg.hip_m + leg.turned(middle(leg));
  const double vx = speed_m_s * std::cos(task.direction_rad) - task.turn_rad_s * place.y();
  const double vy = speed_m_s * std::sin(task.direction_rad) + task.turn_rad_s * place.x();
  const double skew = leg.front ? skew_rad : -skew_rad;
  const double c = std::cos(skew), s = std::sin(skew);
  return Vector3d(c * vx - s * vy, s * vx + c * vy, 0) * -time_s;
}

Vector3d FootPlaces::at(const FourLegs::Leg& leg, const Vector3d& away) const {
  return middle(leg) + away.x() * forward_ + leg.turned(Vector3d(0, away.y(), 0)) + away.z() * up_;
}

std::vector<double> stanceOf(const RobotModel& model, const std::string& who) {
  const FourLegs dog = FourLegs::of(model, who);
  std::vector<double> stance = restPositions(model);
  for (const FourLegs::Leg& leg : dog.legs) {
    const LegAngles angles = solveContact(leg, standingFoot(leg), bent(leg)).angles;
    for (std::size_t j = 0; j < 3; ++j) stance[leg.joints[j]] = angles[j];
  }
  return stance;
}

void standStill(SceneRobot& robot, std::vector<double> joints, const std::string& who) {
  robot.jointStart = std::move(joints);
  robot.jointStartRate.assign(robot.model.joints.size(), 0.0);
  robot.start = standing(robot.model, robot.jointStart, who);
  robot.startVelocity_m_s.setZero();
  robot.startSpin_rad_s.setZero();
}

void arrangeStance(Scene& scene, const std::string& who) {
  SceneRobot& robot = firstRobot(scene, who);
  standStill(robot, stanceOf(robot.model, who), who);
}

GaitSteps::GaitSteps(double controlPeriod_s, std::vector<double> start, const FourLegs& dog, const GaitTask& task,
                     Gait gait)
    : period_s_(controlPeriod_s),
      start_(std::move(start)),
      gait_(std::move(gait)),
      leadIn_(std::max(1L, std::lround(task.leadIn_s / period_s_))),
      end_(std::lround(task.duration_s / period_s_)) {
  for (std::size_t i = 0; i < 4; ++i) joints_[i] = dog.legs[i].joints;
}

void GaitSteps::targets(double time, std::span<double> targets) const {
  std::ranges::copy(start_, targets.begin());
  // A target is held for the period, so it is the position to be reached at its end.
  const long frame = std::lround(time / period_s_) + 1 - leadIn_;
  const double share = std::min(1.0, 1 + static_cast<double>(frame) / static_cast<double>(leadIn_));
  const auto& wanted = gait_.angles(frame > 0 ? frame % gait_.period() : 0);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      double& target = targets[joints_[i][j]];
      target = share < 1 ? target + (wanted[i][j] - target) * share : wanted[i][j];
    }
}

double infeasibleShare(const Values& remarks) {
  const auto points = remarks.find("points"), infeasible = remarks.find("infeasible_points");
  if (points == remarks.end() || infeasible == remarks.end() || points->second <= 0) return 0;
  return infeasible->second / points->second;
}

double withInfeasiblePenalty(double speed, double penalty, const Values& remarks) {
  return speed > 0 ? speed * std::max(0.0, 1 - penalty * infeasibleShare(remarks)) : speed;
}

Values GaitSteps::remarks() const { return {{"points", gait_.points()}, {"infeasible_points", gait_.infeasible()}}; }

}  // namespace btr
