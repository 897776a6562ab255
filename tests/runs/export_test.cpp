#include "core/run/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "core/spec/csv.h"
#include "core/spec/error.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using Row = std::vector<std::string>;

/// Two generations of two individuals, one of which was measured three times by the stand-in, and one adapted
/// simulator.
class Export : public testing::Test {
 protected:
  Export() {
    database_.emplace(Database::open(folder_.file("kick.db"), Database::Mode::create));
    Database& db = *database_;
    RunRecord run;
    run.experiment = db.addExperiment({0, "kick", "{}", "", ""});
    run.reality = "stand_in";
    SimulatorRecord simulator;
    simulator.createdAt = "2026-11-21T10:00:00Z";
    simulator.simulator.values = {{"friction", 0.1}};
    run_ = db.addRun(run, simulator);
    for (int number = 1; number <= 2; ++number) {
      GenerationRecord g;
      g.run = run_;
      g.number = number;
      g.simulator = 1;
      g.best = 0.1 + 0.2;
      g.mean = 0.25;
      g.worst = -1e-9;
      g.trials = 2;
      g.seconds = 1.5;
      g.finishedAt = "2026-11-21T10:11:12Z";
      for (int slot = 0; slot < 2; ++slot) {
        IndividualRecord i;
        i.slot = slot;
        i.chromosome = slot ? "01" : "10";
        i.parameters = {0.1, 1.0 / 3};
        i.fitness = number + 0.5 * slot;
        i.trialSeed = 0xffffffffffffffffu;
        g.individuals.push_back(i);
      }
      g.individuals[1].outcome = "exploded";
      g.individuals[1].detail = "fell, then \"flew\"";
      db.addGeneration(g);
    }
    db.addMeasurementStage(run_, 1, {{run_, 1, 3, 1, 2.0, 2, true}});
    for (const double value : {0.5, 0.75, 100.0})
      db.addMeasurement({0, run_, 3, value, value == 100, "a,b", "me", "stand_in", "2026-11-21T11:00:00Z"});
    simulator.run = run_;
    simulator.parent = 1;
    simulator.madeBy = "L3";
    simulator.madeAfterGeneration = 2;
    simulator.simulator = {
        {{"friction", 0.7}, {"leg_mass_kg", 0.2}},
        {{"backlash", "leg.knee", {{"width_rad", 0.051}}}, {"backlash", "leg.knee", {{"width_rad", 0.1}}}}};
    db.finishStage(simulator, {run_, 1, 1, 0, 1.375, 0.25, std::nullopt, 0.5, 1.375, 0.125, 0.1, 1},
                   RunState::learning);
  }
  // The table, read by the program's own reader.
  std::vector<Row> table(const std::string& what, const std::vector<std::string>& names = {}) const {
    std::vector<Parameter> genotype;
    for (const std::string& name : names) genotype.push_back({name, "", ""});
    std::istringstream stream(exportCsv(*database_, run_, what, genotype, "m"));
    CsvReader reader(stream, what);
    std::vector<Row> rows;
    for (Row row; reader.next(row);) rows.push_back(row);
    for (const Row& row : rows) EXPECT_EQ(rows[0].size(), row.size());
    return rows;
  }

  const TemporaryFolder folder_;
  std::optional<Database> database_;
  Id run_ = 0;
};

TEST_F(Export, GenerationsCarryTheFitnessUnitAndTheShortestExactNumbers) {
  EXPECT_EQ((std::vector<Row>{{"run", "generation", "simulator", "best_m", "mean_m", "worst_m", "trials", "reused",
                               "failed", "wall_time_s", "finished_at", "reality"},
                              {"1", "1", "0", "0.30000000000000004", "0.25", "-1e-09", "2", "0", "0", "1.5",
                               "2026-11-21T10:11:12Z", "stand_in"},
                              {"1", "2", "0", "0.30000000000000004", "0.25", "-1e-09", "2", "0", "0", "1.5",
                               "2026-11-21T10:11:12Z", "stand_in"}}),
            table("generations"));
}

TEST_F(Export, IndividualsCarryParametersByNameAndWhatWasMeasured) {
  const auto rows = table("individuals", {"height_m", "swing_rad"});
  EXPECT_EQ((Row{"run", "individual", "generation", "slot", "simulator", "fitness_m", "outcome", "detail", "same_as",
                 "trial_seed", "trace_sha256", "measured_mean_m", "measured_count", "reality", "chromosome", "height_m",
                 "swing_rad"}),
            rows[0]);
  ASSERT_EQ(5u, rows.size());
  EXPECT_EQ((Row{"1", "2", "1", "1", "0", "1.5", "exploded", "fell, then \"flew\"", "", "18446744073709551615", "", "",
                 "0", "", "01", "0.1", "0.3333333333333333"}),
            rows[2]);
  EXPECT_EQ((Row{"1", "3", "2", "0", "0", "2", "finished", "", "", "18446744073709551615", "", "0.625", "2", "stand_in",
                 "10", "0.1", "0.3333333333333333"}),
            rows[3]);
  EXPECT_EQ("parameter_2", table("individuals")[0].back());
}

TEST_F(Export, GapsSaySimulatorVersionsAndReality) {
  EXPECT_EQ((std::vector<Row>{
                {"run", "stage", "simulator_before", "simulator_after", "before_m", "after_m", "held_out_before_m",
                 "held_out_after_m", "new_before_m", "new_after_m", "standard_error_m", "individuals",
                 "held_out_standard_error_m", "held_out_individuals", "reality"},
                {"1", "1", "0", "1", "1.375", "0.25", "", "0.5", "1.375", "0.125", "0.1", "1", "", "0", "stand_in"}}),
            table("gaps"));
}

TEST_F(Export, SimulatorsHaveOneColumnForEachNumberOfAnyVersion) {
  const auto rows = table("simulators");
  ASSERT_EQ(3u, rows.size());
  EXPECT_EQ((Row{"run", "simulator", "parent", "made_by", "made_after_generation", "created_at", "effects", "reality",
                 "backlash@leg.knee#2.width_rad", "backlash@leg.knee.width_rad", "friction", "leg_mass_kg"}),
            rows[0]);
  EXPECT_EQ((Row{"1", "0", "", "start", "0", "2026-11-21T10:00:00Z", "", "stand_in", "", "", "0.1", ""}), rows[1]);
  EXPECT_EQ((Row{"1", "1", "0", "L3", "2", "2026-11-21T10:00:00Z", "backlash@leg.knee backlash@leg.knee", "stand_in",
                 "0.1", "0.051", "0.7", "0.2"}),
            rows[2]);
}

TEST_F(Export, MeasurementsKeepVoidOnesAndTheirSource) {
  const auto rows = table("measurements");
  ASSERT_EQ(4u, rows.size());
  EXPECT_EQ((Row{"run", "measurement", "individual", "generation", "slot", "stage", "held_out", "reason", "rank",
                 "disagreement_m", "candidates", "simulated_fitness_m", "value_m", "void", "note", "who", "entered_at",
                 "reality"}),
            rows[0]);
  EXPECT_EQ((Row{"1", "1", "3", "2", "0", "1", "1", "best", "0", "", "0", "2", "0.5", "0", "a,b", "me",
                 "2026-11-21T11:00:00Z", "stand_in"}),
            rows[1]);
  EXPECT_EQ("1", rows[3][13]);
}

TEST_F(Export, WrongRequestsAreRefused) {
  EXPECT_THROW(exportCsv(*database_, run_, "everything"), InputError);
  EXPECT_THROW(exportCsv(*database_, 99, "gaps"), InputError);
  EXPECT_THROW(exportCsv(*database_, run_, "individuals", {Parameter{"one", "", ""}}), InputError);
}

TEST(UnitSuffix, IsTheUnitInLettersAsColumnsEnd) {
  EXPECT_EQ("_m", unitSuffix("m"));
  EXPECT_EQ("_cm_s", unitSuffix("cm/s"));
  EXPECT_EQ("_nm", unitSuffix("N·m"));
  EXPECT_EQ("", unitSuffix(""));
}

}  // namespace
}  // namespace btr
