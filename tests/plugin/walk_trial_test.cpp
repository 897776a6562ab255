// Walks in the simulated world, made in the same way as in a run.
#include <gtest/gtest.h>

#include <cmath>

#include "core/run/setup/evaluator.h"
#include "core/run/setup/prepared_experiment.h"
#include "tests/plugin/built_plugins.h"

namespace btr {
namespace {

using test::host;

PreparedExperiment walkExperiment(const std::string& controller = "walk",
                                  const Values& settings = {{"duration_s", 6}}) {
  ExperimentSpec spec = loadExperiment(SOURCE_DIR "/resources/experiments/walk.json");
  spec.controller = {controller, settings, {}};
  return prepareFromFiles(spec, host());
}

std::vector<double> gait(const PreparedExperiment& experiment, const Values& changed = {}) {
  return resolve(experiment.genotype, changed, "test");
}

TrialReply walk(const PreparedExperiment& experiment, const Values& changed = {}) {
  return runTrialJob(experiment, {experiment.spec.simulator, gait(experiment, changed), 1, false});
}

TEST(WalkTrial, TheStartGaitsWalkForward) {
  for (const std::string controller : {"walk", "half_ellipse"}) {
    const TrialReply reply = walk(walkExperiment(controller));
    EXPECT_EQ("finished", reply.outcome) << reply.detail;
    EXPECT_GT(reply.fitness, 9) << controller;  // cm/s; the feet push back at 18
    EXPECT_LT(reply.fitness, 27) << controller;
    EXPECT_NE(std::string::npos, reply.detail.find("falls 0, infeasible_share 0,")) << reply.detail;
  }
}

TEST(WalkTrial, AGaitOutOfReachIsPenalisedAndToldNotRefused) {
  const auto experiment = walkExperiment();
  const Values far{{"front_z_m", -0.130}, {"front_x_m", 0.080}, {"length_m", 0.110}};
  const TrialReply reply = walk(experiment, far);
  EXPECT_EQ("finished", reply.outcome) << reply.detail;
  EXPECT_EQ(std::string::npos, reply.detail.find("infeasible_share 0,")) << reply.detail;
  ExperimentSpec unpunished = experiment.spec;
  unpunished.fitness.settings["infeasible_penalty"] = 0;
  unpunished.directory = SOURCE_DIR "/resources/experiments";
  EXPECT_LT(std::abs(reply.fitness), std::abs(walk(prepareFromFiles(unpunished, host()), far).fitness));
}

TEST(WalkTrial, WalksWhereTheFeetPush) {
  const auto way = [](const Values& settings) {
    Values task{{"duration_s", 6}};
    task.insert(settings.begin(), settings.end());
    const auto experiment = walkExperiment("half_ellipse", task);
    // Feet that stand outward have room to go inward: J2 ends 10° inward.
    const auto parameters = gait(experiment, {{"length_m", settings.contains("turn_rad_s") ? 0.0 : 0.05},
                                              {"cycle_s", 0.6},
                                              {"front_y_m", 0.03},
                                              {"rear_y_m", 0.03}});
    return experiment.trial(experiment.scene(experiment.spec.simulator), parameters, 1, false);
  };
  const auto backward = way({{"direction_rad", 3.1416}}), left = way({{"direction_rad", M_PI / 2}});
  const auto right = way({{"direction_rad", -M_PI / 2}}), turn = way({{"turn_rad_s", 0.8}});
  EXPECT_LT(backward.baseEnd_m.x() - backward.baseStart_m.x(), -0.2);
  EXPECT_GT(left.baseEnd_m.y(), 0.15);
  EXPECT_LT(right.baseEnd_m.y(), -0.15);
  double turned = 0;
  for (std::size_t i = 1; i < turn.basePath.size(); ++i)
    turned += std::remainder(turn.basePath[i].yaw_rad - turn.basePath[i - 1].yaw_rad, 2 * M_PI);
  EXPECT_GT(turned, 0.5 * 0.8 * 5.5);
  EXPECT_LT(turned, 1.5 * 0.8 * 5.5);
  EXPECT_LT((turn.baseEnd_m - turn.baseStart_m).norm(), 0.2);
}

TEST(WalkTrial, ATrialRepeatsBitForBit) {
  const auto experiment = walkExperiment("walk", {{"duration_s", 3}});
  const TrialReply first = walk(experiment);
  walk(experiment, {{"length_m", 0.05}});
  EXPECT_EQ(first.traceSha256, walk(experiment).traceSha256);
}

TEST(WalkTrial, MirroredSkewsLeadToMirroredSides) {
  // Which diagonal begins is not mirrored, so the ways are alike, not equal.
  const auto experiment = walkExperiment();
  const auto turned = [&](double skew) {
    const auto result =
        experiment.trial(experiment.scene(experiment.spec.simulator), gait(experiment, {{"skew_rad", skew}}), 1, false);
    return result.basePath.back().yaw_rad;  // below half a turn in 6 s
  };
  const double left = turned(0.3), right = turned(-0.3);
  EXPECT_GT(left, 0.2);
  EXPECT_LT(right, -0.2);
  EXPECT_NEAR(left, -right, 0.3 * (left - right));
}

}  // namespace
}  // namespace btr
