// What real recordings have: encoders without noise, joints that are told to stand still, and fresh trials to score on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/gap/proof/proof_fresh.h"
#include "core/gap/search/gap_report.h"
#include "core/spec/json_reader.h"
#include "tests/prove/prove_fixture.h"
#include "tests/temporary_folder.h"

namespace btr::prove {
namespace {

constexpr std::uint64_t circumstanceSeed = 42;

BlindWorld worldOf(const std::string& scene, std::uint64_t number) {
  Random random = Random::forPurpose(circumstanceSeed, "circumstances", number);
  return drawWorld(scene, random);
}

bool stands(const TrialPlan& plan, std::size_t joint) {
  return std::all_of(plan.commands.begin(), plan.commands.end(),
                     [&](const auto& row) { return row[joint] == plan.commands[0][joint]; });
}

/// Five standard errors of a share of `n`.
double fiveErrors(double share, int n) { return 5 * std::sqrt(share * (1 - share) / n); }

TEST(Sensors, OneInSixRoundsAndDoesNothingElse) {
  constexpr int worlds = 600;
  for (const char* scene : {"pendulum", "leg", "carpet"}) {
    int exact = 0;
    for (int number = 1; number <= worlds; ++number) {
      const BlindWorld world = worldOf(scene, static_cast<std::uint64_t>(number));
      exact += world.columns[0].noise == 0;
      for (const MeasuredColumn& column : world.columns) {
        EXPECT_GT(column.floor(), 0);
        if (column.noise > 0) continue;
        EXPECT_DOUBLE_EQ(column.quantum / std::sqrt(12), column.floor());
      }
    }
    EXPECT_NEAR(1.0 / 6, static_cast<double>(exact) / worlds, fiveErrors(1.0 / 6, worlds)) << scene;
  }
}

TEST(Legs, NowAndThenOneJointIsToldToStandStillAndTheOthersMove) {
  constexpr int worlds = 600;
  constexpr double share = 0.3;
  int standing = 0, always = 0;
  for (int number = 1; number <= worlds; ++number) {
    const BlindWorld world = worldOf("leg", static_cast<std::uint64_t>(number));
    int joints = 0;
    for (std::size_t joint = 0; joint < 3; ++joint) {
      const auto still = std::count_if(world.trials.begin(), world.trials.end(),
                                       [&](const TrialPlan& plan) { return stands(plan, joint); });
      EXPECT_TRUE(still == 0 || still == 3 || still == 4);
      joints += still > 0;
      always += still == 4;
    }
    EXPECT_LE(joints, 1);
    standing += joints;
  }
  EXPECT_NEAR(share, static_cast<double>(standing) / worlds, fiveErrors(share, worlds));
  EXPECT_NEAR(share / 2, static_cast<double>(always) / worlds, fiveErrors(share / 2, worlds));
}

TEST(Legs, AStandingJointOnAnEncoderWithoutNoiseCanBeRecorded) {
  const Plugins plugins;
  // The first case with both.
  for (std::uint64_t number = 1; number <= 200; ++number) {
    const BlindCase blind =
        drawCase({.seed = circumstanceSeed, .number = number, .engine = "ode", .scene = "leg", .kind = "nothing"},
                 plugins.library);
    const BlindWorld& world = blind.world;
    const bool still = stands(world.trials[0], 0) || stands(world.trials[0], 1) || stands(world.trials[0], 2);
    if (world.columns[0].noise > 0 || !still) continue;
    EXPECT_EQ(world.trials.size(), recordTrials(blind, plugins.library).size());
    return;
  }
  FAIL() << "no such case among 200";
}

TEST(FreshTrials, AreOthersInTheSameCircumstances) {
  for (const std::string& scene : sceneKinds()) {
    const BlindWorld world = worldOf(scene, 1);
    ASSERT_FALSE(world.fresh.empty()) << scene;
    for (const TrialPlan& fresh : world.fresh)
      for (const TrialPlan& shown : world.trials) {
        EXPECT_EQ(shown.sample_s, fresh.sample_s);
        EXPECT_EQ(shown.enabled.empty(), fresh.enabled.empty());
        EXPECT_TRUE(shown.commands != fresh.commands || shown.ball.velocity_m_s != fresh.ball.velocity_m_s);
      }
  }
}

/// By channel: error in the fresh trials of a case over what its sensor adds.
std::vector<double> errorsOf(const Plugins& plugins, const BlindCase& blind, const SimulatorSpec& simulator) {
  const TemporaryFolder folder;
  writeCase(blind, plugins.library, folder.file("case"));
  writeFresh(blind, plugins.library, folder.file("fresh"));
  GapReport report;
  report.after = simulator;
  report.step_s = blind.world.scene.step_s / 8;  // an analysis goes so far where bounces need it
  const Values errors = freshErrors(report, folder.file("case/scene.json"),
                                    {folder.file("fresh/trial_1.csv"), folder.file("fresh/trial_2.csv")},
                                    {plugins.library.make, plugins.library.names});
  std::vector<double> ratios;
  for (const MeasuredColumn& column : blind.world.columns)
    if (errors.count(column.name)) ratios.push_back(errors.at(column.name) / column.floor());
  EXPECT_FALSE(ratios.empty());
  return ratios;
}

BlindCase wrongNumbers(const Plugins& plugins, const std::string& scene) {
  return drawCase({.seed = circumstanceSeed, .number = 1, .engine = "ode", .scene = scene, .kind = "parameters"},
                  plugins.library);
}

TEST(FreshTrials, OfTheTrueSimulatorLeaveTheNoiseAndOfAWrongOneMore) {
  const Plugins plugins;
  const BlindCase blind = wrongNumbers(plugins, "pendulum");
  EXPECT_NEAR(1, errorsOf(plugins, blind, blind.simulator)[0], 0.05);
  EXPECT_GT(errorsOf(plugins, blind, {})[0], 2);
}

TEST(FreshTrials, OfABallThatBouncesAreFollowedFromItsStart) {
  const Plugins plugins;
  const BlindCase blind = wrongNumbers(plugins, "flight");
  ASSERT_EQ(1u, blind.world.given.count("floor.restitution"));
  // After four iterations of its start 2 noise floors were left.
  for (const double error : errorsOf(plugins, blind, blind.simulator)) EXPECT_NEAR(1, error, 0.1);
}

}  // namespace
}  // namespace btr::prove
