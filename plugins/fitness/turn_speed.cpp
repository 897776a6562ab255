/// Fitness of turning on the spot: mean rate in rad/s over the trial, to the left positive, or to the right where
/// `side` says so. A robot that falls has turned no further than to where it fell, and the time runs on. A gait with
/// points out of a leg's reach is worth less, as in walk_speed.
/// Recorded beside it: falls, infeasible_share.
#include <cmath>
#include <memory>
#include <numbers>

#include "core/plugin/plugin.h"

namespace {

constexpr double fallenUp = 0.5;  ///< the body's up axis 60° from vertical

class TurnSpeed final : public btr::Fitness {
  std::string unit() const override { return "rad/s"; }

  std::string meaning() const override {
    return "Mean rate of turning over the trial, to the wanted side, whole turns counted";
  }

  std::vector<btr::Parameter> settings() const override {
    return {{"side", "", "the wanted side", 0, 1, 0, {}, false, {"left", "right"}},
            {"skip_s", "s", "time at the start that is not counted", 0, 600, 0},
            {"infeasible_penalty", "", "share of the rate lost if no point of the gait can be reached", 0, 10, 1}};
  }

  double evaluate(const btr::TrialResult& result, const btr::Values& settings, const btr::Values&) const override {
    if (result.outcome != btr::TrialResult::Outcome::finished) return ofFailure();
    const auto value = btr::resolve(this->settings(), settings, "turn_speed");
    const auto& poses = result.basePath;
    const auto first = static_cast<std::size_t>(std::lround(value[1] / result.controlPeriod_s));
    if (first + 1 >= poses.size()) return ofFailure();
    double turned = 0;
    for (std::size_t i = first; i + 1 < poses.size() && poses[i + 1].up >= fallenUp; ++i)
      turned += std::remainder(poses[i + 1].yaw_rad - poses[i].yaw_rad, 2 * std::numbers::pi);
    const double left = turned / (static_cast<double>(poses.size() - 1 - first) * result.controlPeriod_s);
    const double rate = value[0] == 1 ? -left : left;
    return btr::withInfeasiblePenalty(rate, value[2], result.remarks);
  }

  btr::Values figures(const btr::TrialResult& result, const btr::Values&, const btr::Values&) const override {
    int falls = 0;
    bool fallen = false;
    for (const btr::BasePose& pose : result.basePath) {
      if (pose.up < fallenUp && !fallen) ++falls;
      fallen = pose.up < fallenUp;
    }
    return {{"falls", falls}, {"infeasible_share", btr::infeasibleShare(result.remarks)}};
  }
};

}  // namespace

BTR_FITNESS(TurnSpeed, "turn_speed")
