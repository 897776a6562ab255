/// How far the first ball went: f = |rest − start| on the floor [m].
#include "core/plugin/plugin.h"

namespace {

class BallWay final : public btr::Fitness {
  std::string unit() const override { return "m"; }
  std::string meaning() const override { return "Distance on the floor from where the ball lay to where it rests"; }
  std::vector<btr::Parameter> settings() const override { return {}; }

  void check(const btr::Scene& scene) const override {
    if (scene.balls.empty()) throw btr::InputError("fitness ball_way: the scene has no ball");
  }

  double evaluate(const btr::TrialResult& result, const btr::Values&, const btr::Values&) const override {
    if (result.balls.empty()) return ofFailure();
    const btr::BallRest& ball = result.balls.front();
    return (ball.rest_m - ball.start_m).head<2>().norm();
  }
};

}  // namespace

BTR_FITNESS(BallWay, "ball_way")
