// Kicks in the simulated world, made in the same way as in a run.
#include <gtest/gtest.h>

#include <cmath>

#include "core/run/setup/prepared_experiment.h"
#include "tests/plugin/built_plugins.h"

namespace btr {
namespace {

using test::host;

PreparedExperiment kickExperiment(double bearing = 0, const SimulatorSpec& simulator = {}) {
  ExperimentSpec spec = loadExperiment(SOURCE_DIR "/resources/experiments/kick.json");
  spec.controller.settings["bearing_rad"] = bearing;
  spec.simulator = simulator;
  return prepareFromFiles(spec, host());
}

TrialResult trial(const PreparedExperiment& experiment, const std::vector<double>& parameters, bool trace = false) {
  return experiment.trial(experiment.scene(experiment.spec.simulator), parameters, 1, trace);
}

/// Learnt in 50 generations from nothing at the robot's own joint speeds: all four legs take part.
/// LF, RF, LR, RR: J1, J2, J3 each.
const std::vector<double> sweep{1.1039,  0.4007,  0.9710, 0.0008,  -0.1322, -0.1745,
                                -0.0525, -0.1427, 0.7141, -1.0275, 0.0791,  1.8506,  // accumulation
                                -0.6816, -0.1155, 0.1412, 1.0243,  0.4258,  1.5663,
                                0.6290,  0.4714,  0.6400, 0.2580,  0.1985,  0.9365,  // release
                                13};

/// Left and right exchanged.
std::vector<double> mirrored(const std::vector<double>& kick) {
  std::vector<double> other = kick;
  for (const std::size_t phase : {0u, 12u})
    for (const std::size_t pair : {0u, 6u})
      for (std::size_t j = 0; j < 3; ++j) std::swap(other[phase + pair + j], other[phase + pair + 3 + j]);
  return other;
}

TEST(KickTrial, ALearntSweepSendsTheBallFarAhead) {
  const auto experiment = kickExperiment(-0.25);
  const TrialResult result = trial(experiment, sweep);
  EXPECT_EQ(TrialResult::Outcome::finished, result.outcome) << result.detail;
  EXPECT_GT(experiment.fitnessOf(result), 0.5);
}

TEST(KickTrial, StandingStillMovesNothing) {
  const auto experiment = kickExperiment();
  std::vector<double> still;
  for (const Parameter& parameter : experiment.genotype) still.push_back(parameter.byDefault);
  const TrialResult result = trial(experiment, still);
  EXPECT_EQ(TrialResult::Outcome::finished, result.outcome) << result.detail;
  EXPECT_FALSE(result.fell);
  EXPECT_LT((result.balls[0].rest_m - result.balls[0].start_m).norm(), 1e-3);
  EXPECT_LT((result.baseEnd_m - result.baseStart_m).norm(), 0.02);
}

TEST(KickTrial, SomeRandomKicksMoveTheBall) {
  const auto experiment = kickExperiment();
  Random random(1);
  int moved = 0;
  for (int i = 0; i < 40; ++i) {
    std::vector<double> parameters;
    for (const Parameter& p : experiment.genotype) {
      const double value = random.uniform(p.minimum, p.maximum);
      parameters.push_back(p.integer ? std::round(value) : value);
    }
    const TrialResult result = trial(experiment, parameters);
    EXPECT_EQ(TrialResult::Outcome::finished, result.outcome) << result.detail;
    moved += (result.balls[0].rest_m - result.balls[0].start_m).norm() > 0.05;
  }
  EXPECT_GE(moved, 3);
}

TEST(KickTrial, WhereTheFitnessAloneIsWantedItIsTheSameToTheLastBit) {
  const auto experiment = kickExperiment(-0.25);
  const Scene scene = experiment.scene(experiment.spec.simulator);
  Random random(3);
  for (int i = 0; i < 25; ++i) {
    std::vector<double> kick = sweep;
    for (std::size_t j = 0; j + 1 < kick.size() && i > 0; ++j) kick[j] += 0.1 * random.normal();
    const TrialResult whole = experiment.trial(scene, kick, 1, false);
    const TrialResult shorter = experiment.trialForFitness(scene, kick, 1);
    EXPECT_EQ(whole.outcome, shorter.outcome);
    EXPECT_EQ(experiment.fitnessOf(whole), experiment.fitnessOf(shorter)) << i;
  }
}

TEST(KickTrial, RobotsAreSimulatedToTheEndForAFitnessThatLooksAtThem) {
  auto experiment = kickExperiment(-0.25);
  const Scene scene = experiment.scene(experiment.spec.simulator);
  const std::size_t whole = experiment.trial(scene, sweep, 1, false).basePath.size();
  EXPECT_LT(experiment.trialForFitness(scene, sweep, 1).basePath.size(), whole);
  experiment.spec.fitness.settings["fall_factor"] = 0.5;
  const TrialResult result = experiment.trialForFitness(scene, sweep, 1);
  EXPECT_EQ(result.basePath.size(), whole);
  EXPECT_EQ(result.trace.sha256(), experiment.trial(scene, sweep, 1, true).trace.sha256());
}

TEST(KickTrial, AMirroredKickAtAMirroredBallGoesTheMirroredWay) {
  for (const double bearing : {0.0, 0.25, -0.25}) {
    const auto here = kickExperiment(bearing), there = kickExperiment(-bearing);
    const BallRest ball = trial(here, sweep).balls[0];
    const Eigen::Vector3d one = ball.rest_m;
    const Eigen::Vector3d other = trial(there, mirrored(sweep)).balls[0].rest_m;
    EXPECT_GT((one - ball.start_m).norm(), 0.05);
    EXPECT_NEAR(one.x(), other.x(), 0.01);
    EXPECT_NEAR(one.y(), -other.y(), 0.01);
  }
}

TEST(KickTrial, EffectsAtTheirNeutralValuesLeaveTheTraceBitForBit) {
  const std::string plain = trial(kickExperiment(), sweep, true).trace.sha256();
  for (const std::string& name : host().effects()) {
    const auto effect = host().effect(name);
    PlacedEffect placed{name, "", {}};
    switch (effect->place()) {
      case Effect::Place::joint:
        placed.at = "ers7.RF_J1";
        break;
      case Effect::Place::link:
        placed.at = "ers7.HEAD";
        break;
      case Effect::Place::ball:
        placed.at = "ball";
        break;
      case Effect::Place::floor:
        placed.at = "floor";
        break;
      case Effect::Place::world:
        placed.at = "world";
        break;
    }
    for (const Parameter& p : effect->parameters()) placed.parameters[p.name] = p.neutral.value_or(p.byDefault);
    SimulatorSpec simulator;
    simulator.effects.push_back(placed);
    EXPECT_EQ(plain, trial(kickExperiment(0, simulator), sweep, true).trace.sha256()) << name;
    // And with a strong one it is noticed. (A usual torque-speed line lies outside the one that the dog has already; a
    // measured law is nothing until it was measured; nothing in a kick bounces.)
    if (name == "measured_law" || name == "restitution_by_speed") continue;
    for (const Parameter& p : effect->parameters())
      placed.parameters[p.name] = p.neutral && !p.integer ? p.byDefault + 0.2 * (p.maximum - p.byDefault) : p.byDefault;
    simulator.effects = {placed};
    EXPECT_NE(plain, trial(kickExperiment(0, simulator), sweep, true).trace.sha256()) << name;
  }
}

}  // namespace
}  // namespace btr
