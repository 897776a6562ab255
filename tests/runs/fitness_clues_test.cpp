#include "core/run/fitness_clues.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/run/back_to_reality.h"
#include "core/run/evaluator.h"
#include "core/spec/error.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"
#include "tests/gap/temporary_folder.h"

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
class FitnessCluesTest : public testing::Test {
 protected:
  FitnessCluesTest() : host_(PLUGIN_DIR), database_(Database::open(folder_.file("a.db"), Database::Mode::create)) {
    const std::string examples = SOURCE_DIR "/resources/experiments";
    nlohmann::json text = nlohmann::json::parse(readFile(examples + "/kick-short.json"));
    text["learner"]["settings"]["population"] = 8;
    text["stages"] = {
        {"first_generations", 1}, {"next_generations", 1}, {"total_generations", 2}, {"measured_individuals", 6}};
    text["reality"] = "person";
    run_ = startRun(database_, host_, experimentFromJson(text.dump(), "kick", examples), 7);
    RunOptions options;
    options.jobs = 1;
    EXPECT_EQ(RunEnd::waiting, continueRun(database_, host_, run_, StopFlag{false}, options));
  }

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

  TemporaryFolder folder_;
  PluginHost host_;
  Database database_;
  Id run_ = 0;
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
