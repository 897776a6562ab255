#include "core/run/reality/adoption.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/gap/report/report_files.h"
#include "core/gap/search/gap_report.h"
#include "core/run/reality/identified_numbers.h"
#include "core/run/setup/run_lock.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "tests/gap/report/sample_report.h"
#include "tests/runs/small_kick_run.h"

namespace btr {
namespace {

using ::testing::HasSubstr;

/// A kick run of a person's: two measured individuals after each generation of four.
class Adoption : public testing::Test, protected test::SmallKickRun {
 protected:
  Adoption()
      : SmallKickRun(4, 2, [](nlohmann::json& experiment) {
          experiment["adaptation"]["learner"]["settings"]["population"] = 2;
          experiment["adaptation"]["settings"]["generations"] = 1;
        }) {}

  static void measure(Database& database, Id run, int stage) {
    for (const MeasurementTask& task : database.measurementTasks(run, stage)) {
      MeasurementRecord value;
      value.run = run;
      value.individual = task.individual;
      value.value = 0.5 + 0.1 * task.position;
      database.addMeasurement(value);
    }
  }
  static SimulatorSpec repaired() {
    return {{{"servo_p_nm_rad", 6.5}}, {{"coulomb_friction", "ers7.LF_J1", {{"torque_nm", 0.05}}}}};
  }
  std::string complaint(const std::function<void()>& action) {
    try {
      action();
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
};

TEST_F(Adoption, WhileARunWaitsItAdaptsAndLearnsOnFromTheAdoptedSimulator) {
  ASSERT_EQ(goOn(), RunEnd::waiting);
  const SimulatorRecord first = database_.latestSimulator(run_);
  const SimulatorRecord adopted = adoptSimulator(database_, host_, run_, repaired(), "{\"from\":\"test\"}");
  EXPECT_EQ(adopted.number, 1);
  EXPECT_EQ(adopted.parent, first.id);
  EXPECT_EQ(adopted.madeBy, "gap analysis");
  EXPECT_EQ(adopted.evidence, "{\"from\":\"test\"}");
  EXPECT_EQ(adopted.madeAfterGeneration, 1);
  EXPECT_EQ(adopted.simulator.values.at("servo_p_nm_rad"), 6.5);
  EXPECT_EQ(adopted.simulator.values.at("leg_mass_kg"), first.simulator.values.at("leg_mass_kg"));
  EXPECT_EQ(database_.simulator(first.id).simulator, first.simulator);

  measure(database_, run_, 1);
  ASSERT_EQ(goOn(), RunEnd::waiting);
  const std::vector<SimulatorRecord> all = database_.simulators(run_);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[2].madeBy, "L3");
  EXPECT_EQ(all[2].parent, adopted.id);
  EXPECT_EQ(all[2].simulator.effects, repaired().effects);
  EXPECT_EQ(database_.gaps(run_).front().simulatorBefore, adopted.id);
  for (const IndividualRecord& i : database_.individuals(run_, 2)) EXPECT_EQ(i.simulator, all[2].id);
}

TEST_F(Adoption, ARunThatAdoptedGivesTheSameBitsAgain) {
  ASSERT_EQ(goOn(), RunEnd::waiting);
  std::filesystem::copy_file(folder_.file("a.db"), folder_.file("b.db"));
  // The log is folded into the file when the last connection closes; a copy of an open database needs it too.
  if (std::filesystem::exists(folder_.file("a.db-wal")))
    std::filesystem::copy_file(folder_.file("a.db-wal"), folder_.file("b.db-wal"));
  Database other = Database::open(folder_.file("b.db"), Database::Mode::readWrite);
  for (Database* db : {&database_, &other}) {
    adoptSimulator(*db, host_, run_, repaired(), "{}");
    measure(*db, run_, 1);
    ASSERT_EQ(goOn(*db), RunEnd::waiting);
  }
  const auto a = database_.individuals(run_, 2), b = other.individuals(run_, 2);
  ASSERT_EQ(a.size(), 4u);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].parameters, b[i].parameters);
    EXPECT_EQ(a[i].fitness, b[i].fitness);
    EXPECT_EQ(a[i].traceSha256, b[i].traceSha256);
  }
}

TEST_F(Adoption, BeforeTheFirstGenerationAllOfItIsLearnedInTheAdoptedSimulator) {
  const SimulatorRecord adopted = adoptSimulator(database_, host_, run_, repaired(), "{}");
  ASSERT_EQ(goOn(), RunEnd::waiting);
  for (const IndividualRecord& i : database_.individuals(run_, 1)) EXPECT_EQ(i.simulator, adopted.id);
}

TEST_F(Adoption, AfterTheLastGenerationOfAStageItsIndividualsAreMeasuredAllTheSame) {
  // Stopped between learning and choosing: the generation is stored, nobody is chosen yet.
  StopFlag stop{false};
  RunOptions options;
  options.jobs = 1;
  options.progress = [&](const RunProgress& p) { stop = stop || p.generation >= 1; };
  ASSERT_EQ(continueRun(database_, host_, run_, stop, options), RunEnd::stopped);
  ASSERT_EQ(database_.run(run_).generation, 1);
  ASSERT_TRUE(database_.measurementTasks(run_).empty());
  adoptSimulator(database_, host_, run_, repaired(), "{}");
  ASSERT_EQ(goOn(), RunEnd::waiting);
  EXPECT_EQ(database_.measurementTasks(run_, 1).size(), 2u);
}

TEST_F(Adoption, RevertingMakesTheParentTheNewestAgain) {
  ASSERT_EQ(goOn(), RunEnd::waiting);
  const SimulatorRecord adopted = adoptSimulator(database_, host_, run_, repaired(), "{}");
  const SimulatorRecord reverted = revertSimulator(database_, run_);
  EXPECT_EQ(reverted.number, 2);
  EXPECT_EQ(reverted.parent, adopted.id);
  EXPECT_EQ(reverted.madeBy, "by hand");
  EXPECT_EQ(originOf(reverted), "back to version 0");
  EXPECT_EQ(originOf(adopted), "gap analysis");
  EXPECT_EQ(reverted.simulator, database_.simulators(run_)[0].simulator);
  EXPECT_EQ(database_.simulators(run_).size(), 3u);
  EXPECT_EQ(revertSimulator(database_, run_, 1).simulator, adopted.simulator);
  EXPECT_THAT(complaint([&] { revertSimulator(database_, run_, 9); }),
              HasSubstr("version 9 is not allowed; a version from 0 to 2"));
}

TEST_F(Adoption, TheFirstVersionCannotBeReverted) {
  EXPECT_THAT(complaint([&] { revertSimulator(database_, run_); }), HasSubstr("reverting the first version"));
}

TEST_F(Adoption, IsRefusedWhileAProcessWorksOnTheRunAndWhenItIsFinished) {
  {
    const RunLock working(database_.path(), run_);
    EXPECT_THAT(complaint([&] { adoptSimulator(database_, host_, run_, repaired(), "{}"); }),
                HasSubstr("another process works on it"));
  }
  database_.setRunState(run_, RunState::finished, "");
  const std::string text = complaint([&] { adoptSimulator(database_, host_, run_, repaired(), "{}"); });
  EXPECT_THAT(text, HasSubstr("the run is finished"));
  EXPECT_THAT(text, HasSubstr("while a run waits for measurements or is stopped"));
  EXPECT_EQ(database_.simulators(run_).size(), 1u);
}

TEST_F(Adoption, IsRefusedInTheMiddleOfAnAdaptation) {
  ASSERT_EQ(goOn(), RunEnd::waiting);
  AdaptationRecord begun;
  begun.run = run_;
  begun.stage = 1;
  begun.number = 1;
  database_.addAdaptation(begun);
  EXPECT_THAT(complaint([&] { adoptSimulator(database_, host_, run_, repaired(), "{}"); }),
              HasSubstr("the adaptation of stage 1 has begun"));
}

TEST_F(Adoption, RefusesWhatTheRunsSceneCannotBuild) {
  SimulatorSpec wrong = repaired();
  wrong.effects[0].at = "ers7.no_such_joint";
  EXPECT_THAT(complaint([&] { adoptSimulator(database_, host_, run_, wrong, "{}"); }), HasSubstr("no_such_joint"));
  EXPECT_THAT(complaint([&] { adoptSimulator(database_, host_, 99, repaired(), "{}"); }), HasSubstr("run 99"));
  EXPECT_EQ(database_.simulators(run_).size(), 1u);
}

TEST_F(Adoption, ASimulatorThatTheRunHasAlreadyIsRefused) {
  adoptSimulator(database_, host_, run_, repaired(), "{}");
  EXPECT_THAT(complaint([&] { adoptSimulator(database_, host_, run_, repaired(), "{}"); }),
              HasSubstr("version 1 is this simulator already"));
}

TEST_F(Adoption, TheReportIsTheEvidence) {
  GapReport report = sampleReport("ers7");
  report.after = repaired();
  writeReport(report, folder_.file("report"));
  const SimulatorRecord adopted =
      adoptFromFiles(database_, host_, run_, folder_.file("report/simulator.json"), folder_.file("report"));
  const auto evidence = nlohmann::json::parse(adopted.evidence);
  EXPECT_EQ(evidence["report_sha256"], sha256(readFile(folder_.file("report/report.json"))));
  EXPECT_EQ(evidence["verdict"], "missing_physics");
  EXPECT_EQ(evidence["sentence"], report.sentence);
  EXPECT_EQ(evidence["recordings_sha256"].size(), 5u);
  // What the recordings told of numbers is known to the stages that follow.
  const auto told = identifiedNumbers(database_.simulators(run_), adopted);
  ASSERT_FALSE(report.calibrated.empty());
  for (const GapReport::Number& number : report.calibrated) {
    ASSERT_TRUE(number.ci95.known());
    EXPECT_EQ(told.at(number.name).low, number.ci95.low);
    EXPECT_EQ(told.at(number.name).high, number.ci95.high);
  }

  SimulatorSpec other = repaired();
  other.values["servo_p_nm_rad"] = 5;
  folder_.write("other.json", toJsonText(other));
  EXPECT_THAT(
      complaint([&] { adoptFromFiles(database_, host_, run_, folder_.file("other.json"), folder_.file("report")); }),
      HasSubstr("is not the simulator that the report"));
}

}  // namespace
}  // namespace btr
