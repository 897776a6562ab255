/// Fitness of a kick: f = d · exp(−k·ψ²)
///   d   how far the ball lies in the end [m], from where it lay (default) or from the neck's ground projection
///   ψ   angle between the way it went and the wanted direction α [rad], −π … π
///   k   how much a wrong direction costs [rad⁻²]; 7.3 = 1/(2·(15°)²): 15° off costs 39 %
/// The papers give the form, not k and not the place from which d is measured. A robot that fell while kicking still
/// kicked: its fitness is multiplied by fall_factor, 1 unless the user wants it to stay on its feet. A ball that lies
/// still has d = 0.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/plugin/ball_fitness.h"
#include "core/plugin/plugin.h"

namespace {

class KickDistance final : public btr::BallFitness {
  std::string unit() const override { return "m"; }
  bool canBeNegative() const override { return false; }

  std::string meaning() const override {
    return "Distance on the floor from where the ball lay (or from below the neck joint, see measured_from) to where "
           "it comes "
           "to rest, times exp(−k·ψ²) for the angle ψ off the wanted direction";
  }

  std::vector<btr::Parameter> settings() const override {
    return {{"k_rad2", "1/rad²", "cost of a wrong direction", 0, 100, 7.3},
            {"measured_from", "", "where the distance begins", 0, 1, 0, {}, false, {"ball_start", "neck"}},
            {"fall_factor", "", "times this if the robot fell", 0, 1, 1}};
  }

  void check(const btr::Scene& scene) const override {
    if (scene.balls.empty())
      throw btr::InputError(
          "fitness kick_distance: the scene has no ball; choose a scene with one, or another fitness");
  }

  bool seesBallsOnly(const btr::Values& settings) const override {
    return btr::valueOf(this->settings(), settings, "fall_factor") == 1;
  }

  double evaluate(const btr::TrialResult& result, const btr::Values& settings,
                  const btr::Values& controllerSettings) const override {
    if (result.outcome != btr::TrialResult::Outcome::finished || result.balls.empty()) return ofFailure();
    const auto value = btr::resolve(this->settings(), settings, "kick_distance");
    const Way way = wayOf(result, value[1] == 1, controllerSettings);
    const double kick = way.distance * std::exp(-value[0] * way.psi * way.psi);
    return result.fell ? kick * value[2] : kick;
  }

  /// How far and how straight the ball went, and how the robot kept its balance.
  btr::Values figures(const btr::TrialResult& result, const btr::Values& settings,
                      const btr::Values& controllerSettings) const override {
    if (result.balls.empty()) return {};
    const auto value = btr::resolve(this->settings(), settings, "kick_distance");
    const Way way = wayOf(result, value[1] == 1, controllerSettings);
    double up = 1;
    for (const btr::BasePose& pose : result.basePath) up = std::min(up, pose.up);
    return {{"way_m", way.distance},
            {"off_direction_rad", way.psi},
            {"falls", result.fell ? 1.0 : 0.0},
            {"largest_tilt_rad", std::acos(std::clamp(up, -1.0, 1.0))}};
  }

 private:
  struct Way {
    double distance, psi;
  };
  static Way wayOf(const btr::TrialResult& result, bool fromNeck, const btr::Values& controllerSettings) {
    const auto task = [&](const char* name) {
      const auto found = controllerSettings.find(name);
      if (found == controllerSettings.end())
        throw btr::InputError(std::string("kick_distance: needs a controller with the setting ") + name +
                              ", as kick has");
      return found->second;
    };
    const double wanted = task("direction_rad");
    const btr::BallRest& ball = result.balls.front();
    Eigen::Vector2d from = ball.start_m.head<2>();
    if (fromNeck) {
      const double d = task("distance_m"), bearing = task("bearing_rad");
      from -= d * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
    }
    const Eigen::Vector2d way = ball.rest_m.head<2>() - from;
    return {way.norm(), std::remainder(std::atan2(way.y(), way.x()) - wanted, 2 * std::numbers::pi)};
  }
};

}  // namespace

BTR_FITNESS(KickDistance, "kick_distance")
