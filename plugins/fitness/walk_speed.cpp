/// Fitness of a walk: mean speed in cm/s over the trial (20 s with the walking controllers' defaults).
///   speed = way / time    from skip_s after the start (0: the whole trial, lead-in included) to the trial's end
///   way     forward   displacement along the wanted direction, seen from how the robot stood at the start
///           distance  straight line between the ends of the way, wherever it led
///           path      length of the way itself, between places half a second apart: swaying counts less than walking
/// A robot that falls has walked no further than to where it fell, and the time runs on; fall_factor multiplies a way
/// that ended so. A gait with points out of a leg's reach is worth less by infeasible_penalty times the share of such
/// points: that is not seen by a person who measures the speed.
/// Recorded beside it: straightness (distance over path, 1 is straight), sideways_m (to the left of the wanted
/// direction), turned_rad (left), falls, infeasible_share.
#include <cmath>
#include <memory>
#include <numbers>

#include "core/plugin/plugin.h"

namespace {

constexpr double fallenUp = 0.5;  ///< the body's up axis 60° from vertical
constexpr double pathEvery_s = 0.5;
constexpr double centimetres = 100;

/// The walked part of a trial.
struct Walked {
  double forward = 0, sideways = 0, distance = 0, path = 0;  ///< m
  double turned = 0;                                         ///< rad, whole turns counted
  int falls = 0;
  double time = 0;  ///< s

  Walked(const btr::TrialResult& result, double skip_s, double direction) {
    const auto& poses = result.basePath;
    const auto periods = [&](double seconds) {
      return static_cast<std::size_t>(std::lround(seconds / result.controlPeriod_s));
    };
    const std::size_t first = periods(skip_s);
    if (first + 1 >= poses.size()) return;
    time = static_cast<double>(poses.size() - 1 - first) * result.controlPeriod_s;

    std::size_t last = poses.size() - 1;
    bool fallen = false;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const bool now = poses[i].up < fallenUp;
      if (now && !fallen && ++falls == 1) last = i;
      fallen = now;
    }
    if (last <= first) return;
    for (std::size_t i = first; i < last; ++i)
      turned += std::remainder(poses[i + 1].yaw_rad - poses[i].yaw_rad, 2 * std::numbers::pi);
    const std::size_t every = std::max<std::size_t>(1, periods(pathEvery_s));
    for (std::size_t i = first; i < last; i += every)
      path += (poses[std::min(i + every, last)].position_m - poses[i].position_m).head<2>().norm();
    const Eigen::Vector2d way = (poses[last].position_m - poses[first].position_m).head<2>();
    const double angle = poses.front().yaw_rad + direction;
    forward = way.x() * std::cos(angle) + way.y() * std::sin(angle);
    sideways = way.y() * std::cos(angle) - way.x() * std::sin(angle);
    distance = way.norm();
  }
};

class WalkSpeed final : public btr::Fitness {
  std::string unit() const override { return "cm/s"; }

  std::string meaning() const override {
    return "Mean speed over the trial: way into the wanted direction (see measured) divided by the trial's time; a "
           "robot that falls has walked no further than to there";
  }

  std::vector<btr::Parameter> settings() const override {
    return {{"measured", "", "which way counts", 0, 2, 0, {}, false, {"forward", "distance", "path"}},
            {"direction_rad", "rad", "wanted direction, 0 as the robot looks at the start, positive left", -3.1416,
             3.1416, 0},
            {"skip_s", "s", "time at the start that is not counted", 0, 600, 0},
            {"fall_factor", "", "times this if the robot fell", 0, 1, 1},
            {"infeasible_penalty", "", "share of the speed lost if no point of the gait can be reached", 0, 10, 1}};
  }

  double evaluate(const btr::TrialResult& result, const btr::Values& settings, const btr::Values&) const override {
    if (result.outcome != btr::TrialResult::Outcome::finished) return ofFailure();
    const auto value = btr::resolve(this->settings(), settings, "walk_speed");
    const Walked walked(result, value[2], value[1]);
    if (walked.time <= 0) return ofFailure();
    const double way = value[0] == 0 ? walked.forward : value[0] == 1 ? walked.distance : walked.path;
    double speed = centimetres * way / walked.time;
    // A walk backwards does not gain from falling.
    if (speed > 0 && walked.falls > 0) speed *= value[3];
    return btr::withInfeasiblePenalty(speed, value[4], result.remarks);
  }

  btr::Values figures(const btr::TrialResult& result, const btr::Values& settings, const btr::Values&) const override {
    const auto value = btr::resolve(this->settings(), settings, "walk_speed");
    const Walked walked(result, value[2], value[1]);
    return {{"straightness", walked.path > 0 ? walked.distance / walked.path : 0},
            {"sideways_m", walked.sideways},
            {"turned_rad", walked.turned},
            {"falls", walked.falls},
            {"infeasible_share", btr::infeasibleShare(result.remarks)}};
  }
};

}  // namespace

BTR_FITNESS(WalkSpeed, "walk_speed")
