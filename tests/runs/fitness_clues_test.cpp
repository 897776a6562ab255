#include "core/run/reality/fitness_clues.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/run/setup/evaluator.h"
#include "core/spec/error.h"
#include "core/spec/system/cancelled.h"
#include "tests/runs/small_kick_run.h"

namespace btr {
namespace {

using ::testing::HasSubstr;

TEST(BestShare, IsTheLeastSquaresSize) {
  // d = 2δ exactly; most allows it, then not.
  const std::vector<double> change{1, -2, 0.5}, differences{2, -4, 1}, same{1, 1, 1};
  EXPECT_NEAR(2, bestShare(differences, change, same, 3).a, 1e-12);
  EXPECT_NEAR(1, bestShare(differences, change, same, 3).share, 1e-12);
  // At a = 1 half of every difference stays: a quarter of the squares.
  EXPECT_NEAR(0.75, bestShare(differences, change, same, 1).share, 1e-12);
  // The other direction takes nothing away.
  EXPECT_EQ(0, bestShare({-2, 4, -1}, change, same, 3).share);
  EXPECT_EQ(0, bestShare(differences, {0, 0, 0}, same, 3).share);
  // Weights: only the first counts.
  EXPECT_NEAR(1, bestShare({3, 100, 100}, {1, 0, 0}, {1, 0, 0}, 3).share, 1e-12);
}

/// A kick run of eight individuals, six of whom are measured after one generation.
class FitnessCluesTest : public testing::Test, protected test::SmallKickRun {
 protected:
  FitnessCluesTest() : SmallKickRun(8, 6) { EXPECT_EQ(RunEnd::waiting, goOn()); }

  /// Reality: our own simulator with an effect more.
  void measureWith(const PlacedEffect& hidden) {
    const PreparedExperiment prepared = prepareFromRun(database_.run(run_), host_);
    SimulatorSpec reality = database_.latestSimulator(run_).simulator;
    reality.effects.push_back(hidden);
    for (const MeasurementTask& task : database_.measurementTasks(run_, 1)) {
      const IndividualRecord individual = database_.individual(task.individual);
      MeasurementRecord value;
      value.run = run_;
      value.individual = task.individual;
      value.value = runTrialJob(prepared, {reality, individual.parameters, individual.trialSeed, false}).fitness;
      database_.addMeasurement(value);
    }
  }
};

TEST_F(FitnessCluesTest, AnEffectOfUsualSizeTakesAllOfItsOwnDifferencesAway) {
  const auto declared = host_.effect("torque_speed_limit")->parameters();
  Values typical;
  for (const Parameter& p : declared) typical[p.name] = p.neutral.value_or(p.byDefault);
  typical[declared[0].name] = declared[0].byDefault;
  measureWith({"torque_speed_limit", "ers7.RF_J1", typical});
  FitnessCluesOptions options;
  options.workers = 1;
  options.names = {"torque_speed_limit", "constant_wind"};
  const FitnessClues one = fitnessClues(database_, host_, run_, options);
  ASSERT_EQ(6u, one.individuals.size());
  ASSERT_FALSE(one.clues.empty());
  EXPECT_EQ("torque_speed_limit", one.clues[0].effect.effect);
  EXPECT_EQ("ers7.RF_J1", one.clues[0].effect.at);
  EXPECT_NEAR(1, one.clues[0].share, 1e-9);
  for (std::size_t i = 0; i < one.real.size(); ++i) EXPECT_NEAR(one.real[i], one.clues[0].simulated[i], 1e-9);
  EXPECT_GT(one.gap, 0);
  EXPECT_THAT(one.sentence, HasSubstr("torque speed limit at ers7.RF_J1 would take away most: 100 %"));

  // The same whatever the number of workers, and through its text.
  options.workers = 3;
  const FitnessClues three = fitnessClues(database_, host_, run_, options);
  EXPECT_EQ(toJsonText(one), toJsonText(three));
  EXPECT_EQ(toJsonText(one), toJsonText(fitnessCluesFromJson(toJsonText(one))));
}

TEST_F(FitnessCluesTest, NeedsThreeMeasuredIndividualsAndCanBeCancelled) {
  EXPECT_THROW(fitnessClues(database_, host_, run_, {}), InputError);
  measureWith({"constant_wind", "world", {}});
  FitnessCluesOptions options;
  options.workers = 1;
  options.names = {"constant_wind"};
  options.progress = [](const std::string&, double) { return false; };
  EXPECT_THROW(fitnessClues(database_, host_, run_, options), Cancelled);
}

}  // namespace
}  // namespace btr
