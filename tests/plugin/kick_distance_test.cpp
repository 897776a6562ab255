#include <gtest/gtest.h>

#include <cmath>

#include "core/plugin/plugin_host.h"
#include "core/spec/error.h"

namespace btr {
namespace {

/// The fitness of a ball that lay at (0.23, 0) and now lies at (x, y).
class KickDistance : public testing::Test {
 protected:
  PluginHost host{PLUGIN_DIR};
  std::unique_ptr<Fitness> fitness = host.fitness("kick_distance");
  Values settings, task{{"distance_m", 0.16}, {"bearing_rad", 0}, {"direction_rad", 0}};
  TrialResult result;

  double at(double x, double y) {
    result.balls = {{{0.23, 0, 0.0425}, {x, y, 0.0425}}};
    return fitness->evaluate(result, settings, task);
  }
};

TEST_F(KickDistance, StraightAheadIsTheDistance) {
  EXPECT_NEAR(1.5, at(1.73, 0), 1e-12);
  EXPECT_EQ("m", fitness->unit());
}

TEST_F(KickDistance, OneStandardDeviationOffCostsItsShare) {
  // k = 7.3 / rad² is 1/(2·(15°)²): 15° off leaves exp(−½).
  const double angle = 15 * M_PI / 180;
  EXPECT_NEAR(2 * std::exp(-7.3 * angle * angle), at(0.23 + 2 * std::cos(angle), 2 * std::sin(angle)), 1e-12);
  EXPECT_NEAR(2 * std::exp(-0.5), at(0.23 + 2 * std::cos(angle), 2 * std::sin(angle)), 1e-3);
}

TEST_F(KickDistance, LeftAndRightCostTheSame) { EXPECT_DOUBLE_EQ(at(1, 0.4), at(1, -0.4)); }

TEST_F(KickDistance, FollowsTheWantedDirection) {
  task["direction_rad"] = M_PI / 2;
  EXPECT_NEAR(1, at(0.23, 1), 1e-12);
  task["direction_rad"] = 3.1;
  EXPECT_NEAR(std::exp(-7.3 * 0.2 * 0.2) * 1, at(0.23 + std::cos(3.3), std::sin(3.3)), 1e-12);  // across ±π
}

TEST_F(KickDistance, ABallThatLiesStillIsWorthNothing) { EXPECT_EQ(0, at(0.23, 0)); }

TEST_F(KickDistance, TellsWayAngleFallsAndTilt) {
  task["direction_rad"] = 0.1;
  at(0.23 + 0.3, 0.4);
  result.fell = true;
  result.basePath.resize(2);
  result.basePath[0].up = 1;
  result.basePath[1].up = 0.5;
  const Values told = fitness->figures(result, settings, task);
  EXPECT_NEAR(0.5, told.at("way_m"), 1e-12);
  EXPECT_NEAR(std::atan2(0.4, 0.3) - 0.1, told.at("off_direction_rad"), 1e-12);
  EXPECT_EQ(1, told.at("falls"));
  EXPECT_NEAR(M_PI / 3, told.at("largest_tilt_rad"), 1e-12);
}

TEST_F(KickDistance, IsNeverNegative) {
  for (int i = 0; i < 360; ++i) EXPECT_GE(at(0.23 + std::cos(i), std::sin(i)), 0);
}

TEST_F(KickDistance, MayBeMeasuredFromTheNeck) {
  settings["measured_from"] = 1;
  EXPECT_NEAR(1.66, at(1.73, 0), 1e-12);
  task["bearing_rad"] = M_PI / 2;  // the neck lies 0.16 m to the right of the ball
  EXPECT_NEAR(0.5 * std::exp(-7.3 * std::pow(std::atan2(0.4, 0.3), 2)), at(0.23 + 0.3, 0.4 - 0.16), 1e-12);
}

TEST_F(KickDistance, AFallCostsWhatTheUserSays) {
  result.fell = true;
  EXPECT_NEAR(1.5, at(1.73, 0), 1e-12);
  settings["fall_factor"] = 0.25;
  EXPECT_NEAR(0.375, at(1.73, 0), 1e-12);
}

TEST_F(KickDistance, AFailedTrialIsWorthNothing) {
  for (const auto outcome :
       {TrialResult::Outcome::exploded, TrialResult::Outcome::timedOut, TrialResult::Outcome::workerDied}) {
    result.outcome = outcome;
    EXPECT_EQ(0, at(1.73, 0));
  }
  EXPECT_EQ(0, fitness->ofFailure());
}

TEST_F(KickDistance, NeedsAControllerWithADirection) {
  task.clear();
  EXPECT_THROW(at(1, 0), InputError);
}

}  // namespace
}  // namespace btr
