// Comparisons: what a stage showed, and its means and intervals over the seeds.
#include "core/run/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using ::testing::HasSubstr;

TEST(Comparison, MeansIntervalsAndPairedDifferencesAreThoseOfArithmetic) {
  const auto run = [](double gap, double real) { return std::vector<StageOutcome>{{1, gap, gap / 2, real, 2 * real}}; };
  std::vector<ComparedArm> arms{{"a", {run(0.2, 1), run(0.4, 2)}, {}}, {"b", {run(0.1, 1.5), run(0.3, 2.5)}, {}}};
  compareArms(arms);
  ASSERT_EQ(arms[0].stages.size(), 1u);
  const ComparedStage &a = arms[0].stages[0], &b = arms[1].stages[0];
  EXPECT_EQ(a.stage, 1);
  EXPECT_NEAR(a.gap.mean, 0.3, 1e-15);
  // Two values d apart: standard error d/2, and Student's t of one degree of freedom is 12.7062.
  EXPECT_NEAR(a.gap.halfWidth95, 0.1 * 12.7062, 1e-5);
  EXPECT_NEAR(a.adapted.mean, 0.15, 1e-15);
  EXPECT_NEAR(b.realBest.mean, 4, 1e-15);
  EXPECT_EQ(a.gapDifference.count, 0);
  // Both seeds differ by the same: the interval of the difference has no width.
  EXPECT_NEAR(b.gapDifference.mean, -0.1, 1e-15);
  EXPECT_NEAR(b.gapDifference.halfWidth95, 0, 1e-14);
  EXPECT_NEAR(b.realDifference.mean, 0.5, 1e-15);
}

TEST(Comparison, GoesAsFarAsAllSeedsHaveCome) {
  const StageOutcome first{1, 0.1, 0.1, 1, 1}, second{2, 0.2, 0.1, 1, 1};
  std::vector<ComparedArm> arms{{"a", {{first, second}, {first}}, {}}, {"b", {{first}, {}}, {}}};
  compareArms(arms);
  EXPECT_EQ(arms[0].stages.size(), 1u);
  EXPECT_EQ(arms[1].stages.size(), 0u);
}

std::string complaint(const std::string& text) {
  try {
    comparisonFromJson(text, "c.json", "");
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Comparison, AFileThatMakesNoSenseIsRefusedWithItsPlace) {
  const std::string head = R"({"format": "uchilsim-comparison-1", "name": "n", )";
  const std::string arms = R"("arms": [{"name": "a", "experiment": "a.json"}], )";
  EXPECT_EQ(complaint(head + arms + R"("seeds": [1, 2]})"), "accepted");
  EXPECT_THAT(complaint(head + arms + R"("seeds": [1, 1]})"), HasSubstr("seeds"));
  EXPECT_THAT(complaint(head + arms + R"("seeds": [1.5]})"), HasSubstr("seeds"));
  EXPECT_THAT(complaint(head + arms + R"("seeds": [null]})"), HasSubstr("seeds"));
  EXPECT_THAT(complaint(head + arms + R"("seeds": []})"), HasSubstr("at least one seed"));
  EXPECT_THAT(complaint(head + R"("arms": [], "seeds": [1]})"), HasSubstr("at least one arm"));
  EXPECT_THAT(complaint(head + R"("arms": [{"name": "a", "experiment": ""}], "seeds": [1]})"), HasSubstr("experiment"));
}

/// Two arms that differ in their population only, one stage, two seeds.
class ComparedRuns : public testing::Test {
 protected:
  ComparedRuns() : host_(PLUGIN_DIR) {
    setenv("UCHILSIM_BTR", BTR_PROGRAM, 1);
    nlohmann::json text = nlohmann::json::parse(readFile(SOURCE_DIR "/resources/experiments/kick-short.json"));
    text["scene"] = SOURCE_DIR "/resources/scenes/kick.json";
    text["adaptation"]["learner"]["settings"]["population"] = 2;
    text["adaptation"]["settings"]["generations"] = 1;
    text["stages"] = {
        {"first_generations", 1}, {"next_generations", 1}, {"total_generations", 1}, {"measured_individuals", 2}};
    for (const int population : {4, 6}) {
      text["learner"]["settings"]["population"] = population;
      text["name"] = "population " + std::to_string(population);
      folder_.write(std::to_string(population) + ".json", text.dump());
    }
    spec_ = comparisonFromJson(R"({"format": "uchilsim-comparison-1", "name": "populations",
      "arms": [{"name": "four", "experiment": "4.json"}, {"name": "six", "experiment": "6.json"}], "seeds": [1, 2]})",
                               "c.json", folder_.file(""));
  }
  Comparison compare(Database& database, int jobs) {
    RunOptions options;
    options.jobs = jobs;
    return runComparison(database, host_, spec_, loadArms(spec_, host_), StopFlag{false}, options);
  }

  TemporaryFolder folder_;
  PluginHost host_;
  ComparisonSpec spec_;
};

TEST_F(ComparedRuns, AreRunOnceAndFoundAgain) {
  Database database = Database::open(folder_.file("a.db"), Database::Mode::create);
  const Comparison once = compare(database, 2);
  EXPECT_EQ(once.end, RunEnd::finished);
  EXPECT_EQ(database.runs().size(), 4u);
  EXPECT_EQ(database.experiments().size(), 2u);
  const Comparison again = compare(database, 1);
  EXPECT_EQ(database.runs().size(), 4u);
  EXPECT_EQ(toCsv(again), toCsv(once));
  EXPECT_EQ(toJsonText(again), toJsonText(once));

  // The gap is that of the values that stand in the database.
  double gap = 0;
  for (const MeasurementTask& task : database.measurementTasks(once.runs[0][0], 1))
    for (const MeasurementRecord& m : database.measurements(once.runs[0][0]))
      if (m.individual == task.individual) gap += std::abs(m.value - task.simulatedFitness) / 2;
  EXPECT_NEAR(once.arms[0].runs[0][0].gap, gap, 1e-12);
  EXPECT_THAT(toCsv(once), HasSubstr("arm,stage,seeds,gap_m,gap_ci95_half_m,"));
  EXPECT_THAT(toCsv(once), HasSubstr("\"six\",1,2,"));
}

TEST_F(ComparedRuns, AStopKeepsWhatIsDone) {
  Database database = Database::open(folder_.file("a.db"), Database::Mode::create);
  RunOptions options;
  options.jobs = 1;
  const Comparison stopped = runComparison(database, host_, spec_, loadArms(spec_, host_), StopFlag{true}, options);
  EXPECT_EQ(stopped.end, RunEnd::stopped);
  EXPECT_EQ(compare(database, 1).end, RunEnd::finished);
}

}  // namespace
}  // namespace btr
