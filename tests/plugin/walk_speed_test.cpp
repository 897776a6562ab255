#include <gtest/gtest.h>

#include <cmath>

#include "core/spec/error.h"
#include "tests/plugin/built_plugins.h"

namespace btr {
namespace {

/// A trial of 10 s, told by where the body was.
class WalkSpeed : public testing::Test {
 protected:
  std::unique_ptr<Fitness> fitness = test::host().fitness("walk_speed"), turning = test::host().fitness("turn_speed");
  Values settings;
  TrialResult result;

  void SetUp() override { result.controlPeriod_s = 0.01; }

  template <class Place>
  void walked(Place place) {
    result.basePath.clear();
    for (int i = 0; i <= 1000; ++i) result.basePath.push_back(place(0.01 * i));
  }
  static BasePose at(double x, double y, double yaw = 0, double up = 1) {
    return {{x, y, 0.1}, std::remainder(yaw, 2 * M_PI), up};
  }
  double speed() const { return fitness->evaluate(result, settings, {}); }
  double figure(const std::string& name) const { return fitness->figures(result, settings, {}).at(name); }
};

TEST_F(WalkSpeed, IsTheWayAheadByTheTime) {
  walked([](double t) { return at(0.2 * t, 0.01 * t); });
  EXPECT_NEAR(20, speed(), 1e-9);
  EXPECT_EQ("cm/s", fitness->unit());
  EXPECT_NEAR(0.1, figure("sideways_m"), 1e-9);
  EXPECT_NEAR(1, figure("straightness"), 1e-9);
  EXPECT_EQ(0, figure("falls"));
}

TEST_F(WalkSpeed, AheadIsHowItStoodAtTheStart) {
  walked([](double t) { return at(0, 0.2 * t, M_PI / 2); });
  EXPECT_NEAR(20, speed(), 1e-9);
  settings["direction_rad"] = M_PI / 2;
  EXPECT_NEAR(0, speed(), 1e-9);
}

TEST_F(WalkSpeed, MayLeaveTheBeginningOut) {
  walked([](double t) { return at(t < 2 ? 0 : 0.2 * (t - 2), 0); });
  EXPECT_NEAR(16, speed(), 1e-9);
  settings["skip_s"] = 2;
  EXPECT_NEAR(20, speed(), 1e-9);
  settings["skip_s"] = 10;
  EXPECT_EQ(0, speed());
}

TEST_F(WalkSpeed, ACircleIsLongButLeadsNowhere) {
  // 10 s at 0.2 m/s once around: the way in chords of half a second, r·2·sin(π/20) each.
  const double r = 2 / (2 * M_PI);
  walked([&](double t) { return at(r * std::sin(0.2 * M_PI * t), r - r * std::cos(0.2 * M_PI * t), 0.2 * M_PI * t); });
  EXPECT_NEAR(0, speed(), 1e-9);
  EXPECT_NEAR(0, figure("straightness"), 1e-9);
  EXPECT_NEAR(2 * M_PI, figure("turned_rad"), 1e-9);
  settings["measured"] = 1;
  EXPECT_NEAR(0, speed(), 1e-9);
  settings["measured"] = 2;
  EXPECT_NEAR(100 * 20 * 2 * r * std::sin(M_PI / 20) / 10, speed(), 1e-9);
  EXPECT_NEAR(0.2 * M_PI, turning->evaluate(result, {}, {}), 1e-9);
  EXPECT_NEAR(-0.2 * M_PI, turning->evaluate(result, {{"side", 1}}, {}), 1e-9);
}

TEST_F(WalkSpeed, AFallEndsTheWayButNotTheTime) {
  walked([](double t) { return at(0.2 * t, 0, 0, t < 4.995 ? 1 : 0.3); });
  EXPECT_NEAR(10, speed(), 1e-9);
  EXPECT_EQ(1, figure("falls"));
  settings["fall_factor"] = 0.25;
  EXPECT_NEAR(2.5, speed(), 1e-9);
}

TEST_F(WalkSpeed, FallingBackwardsGainsNothing) {
  walked([](double t) { return at(-0.2 * t, 0, 0, t < 4.995 ? 1 : 0.3); });
  settings["fall_factor"] = 0.25;
  EXPECT_NEAR(-10, speed(), 1e-9);
}

TEST_F(WalkSpeed, TurningPaysForPointsOutOfReachAsWalkingDoes) {
  walked([](double t) { return at(0, 0, 0.2 * M_PI * t); });
  result.remarks = {{"points", 80}, {"infeasible_points", 20}};
  EXPECT_NEAR(0.75 * 0.2 * M_PI, turning->evaluate(result, {}, {}), 1e-9);
  EXPECT_NEAR(0.2 * M_PI, turning->evaluate(result, {{"infeasible_penalty", 0}}, {}), 1e-9);
  EXPECT_NEAR(-0.2 * M_PI, turning->evaluate(result, {{"side", 1}}, {}), 1e-9) << "the wrong way gains nothing";
  EXPECT_EQ(0.25, turning->figures(result, {}, {}).at("infeasible_share"));
}

TEST_F(WalkSpeed, GettingUpAgainCountsEveryFall) {
  walked([](double t) { return at(0.2 * t, 0, 0, std::fmod(t, 3) < 2 ? 1 : 0); });
  EXPECT_EQ(3, figure("falls"));
}

TEST_F(WalkSpeed, PointsOutOfReachCostTheirShare) {
  walked([](double t) { return at(0.2 * t, 0); });
  result.remarks = {{"points", 80}, {"infeasible_points", 20}};
  EXPECT_NEAR(15, speed(), 1e-9);
  EXPECT_NEAR(0.25, figure("infeasible_share"), 1e-12);
  settings["infeasible_penalty"] = 2;
  EXPECT_NEAR(10, speed(), 1e-9);
  settings["infeasible_penalty"] = 10;
  EXPECT_EQ(0, speed());
}

TEST_F(WalkSpeed, WalkingBackwardsIsWorseThanStanding) {
  walked([](double t) { return at(-0.2 * t, 0); });
  result.remarks = {{"points", 80}, {"infeasible_points", 20}};
  EXPECT_NEAR(-20, speed(), 1e-9);
}

TEST_F(WalkSpeed, AFailedTrialIsWorthNothing) {
  walked([](double t) { return at(0.2 * t, 0); });
  for (const auto outcome :
       {TrialResult::Outcome::exploded, TrialResult::Outcome::timedOut, TrialResult::Outcome::workerDied}) {
    result.outcome = outcome;
    EXPECT_EQ(0, speed());
  }
}

TEST_F(WalkSpeed, RefusesSettingsThatItDoesNotHave) {
  walked([](double t) { return at(t, 0); });
  settings["skip_s"] = -1;
  EXPECT_THROW(speed(), InputError);
  settings = {{"speed", 1}};
  EXPECT_THROW(speed(), InputError);
}

}  // namespace
}  // namespace btr
