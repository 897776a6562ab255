// L2: what it begins at, what its learner is told, what goes back, and when it is done.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "core/run/export.h"
#include "core/run/loop/back_to_reality.h"
#include "core/run/reality/reality_gap.h"
#include "core/run/reality/reality_report.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/error.h"

namespace {

namespace fs = std::filesystem;
using namespace btr;

class RealityLearning : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    spec_ = loadExperiment(SOURCE_DIR "/resources/experiments/kick-short.json");
    spec_.learner.settings["population"] = 6;
    spec_.adaptation.settings["population"] = 4;
    spec_.adaptationSettings["generations"] = 1;
    spec_.stages = {
        {"first_generations", 2}, {"next_generations", 1}, {"total_generations", 4}, {"measured_individuals", 3}};
    spec_.realityLearner = {"pgrl", {{"policies", 4}, {"epsilon", 0.1}}, {}};
    spec_.realitySettings = {{"iterations", 2}, {"repeats", 2}};
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// Starts the experiment in a database of its own.
  void begin(const std::string& name) {
    db_.emplace(Database::open((folder_ / (name + ".db")).string(), Database::Mode::create));
    run_ = startRun(*db_, host, spec_, 1);
  }
  /// Runs the experiment to its end or until it waits.
  RunEnd go() {
    if (!db_) begin("run");
    const StopFlag never{false};
    return continueRun(*db_, host, run_, never, {.jobs = 2, .progress = {}});
  }
  /// Enters values for every task that has not its repeats yet: `value` of the parameters, one higher each repeat.
  template <class F>
  void measure(F value) {
    const auto done = db_->measurements(run_);
    for (const MeasurementTask& task : db_->measurementTasks(run_)) {
      if (isSettled(task, done)) continue;
      MeasurementRecord m;
      m.run = run_;
      m.individual = task.individual;
      for (int repeat = 0; repeat < task.wantedRepeats; ++repeat) {
        m.value = value(db_->individual(task.individual).parameters) + repeat;
        db_->addMeasurement(m);
      }
    }
  }
  std::vector<Parameter> genotype() const { return host.controller("kick")->genotype(); }

  PluginHost host{PLUGIN_DIR};
  ExperimentSpec spec_;
  std::optional<Database> db_;
  Id run_ = 0;

 private:
  fs::path folder_ = fs::temp_directory_path() / ("btr-l2-" + std::to_string(getpid()));
};

TEST_F(RealityLearning, WaitsForThePoliciesStepsAndGivesTheBestBack) {
  spec_.reality = "person";
  const std::vector<Parameter> declared = genotype();
  // Reality likes a large first parameter and nothing else.
  const auto reality = [&](const std::vector<double>& p) {
    return (p[0] - declared[0].minimum) / (declared[0].maximum - declared[0].minimum);
  };
  ASSERT_EQ(RunEnd::waiting, go());
  measure(reality);
  ASSERT_EQ(RunEnd::waiting, go());

  // It waits for four policies around the best of the three.
  std::vector<double> best;
  for (const MeasurementTask& t : db_->measurementTasks(run_, 1)) {
    const std::vector<double> p = db_->individual(t.individual).parameters;
    if (t.iteration == 0 && (best.empty() || reality(p) > reality(best))) best = p;
  }
  std::vector<MeasurementTask> tasks = db_->measurementTasks(run_, 1);
  ASSERT_EQ(7u, tasks.size());
  const auto begun = db_->begunRealityIteration(run_, 1);
  ASSERT_TRUE(begun);
  EXPECT_EQ(best, begun->centreBefore);
  for (std::size_t i = 3; i < 7; ++i) {
    EXPECT_EQ(1, tasks[i].iteration);
    EXPECT_EQ(2, tasks[i].wantedRepeats);
    EXPECT_EQ(static_cast<int>(i) + 1, tasks[i].position);
    EXPECT_TRUE(db_->trace(tasks[i].individual)) << "a replay needs it";
  }
  EXPECT_EQ("waiting", std::string(toText(db_->run(run_).state)));
  EXPECT_THAT(db_->run(run_).message, testing::HasSubstr("4 of 4 policies"));
  ASSERT_EQ(RunEnd::waiting, go()) << "waiting is not over by asking again";
  EXPECT_EQ(7u, db_->measurementTasks(run_, 1).size());

  // A measurement of the stage that is voided now must not change the policies that wait.
  db_->setMeasurementVoid(db_->measurements(run_).front().id, true, "the ball hit a wall");
  measure(reality);
  ASSERT_EQ(RunEnd::waiting, go());
  measure(reality);
  ASSERT_EQ(RunEnd::waiting, go());
  const std::vector<RealityIteration> iterations = db_->realityIterations(run_, 1);
  ASSERT_EQ(2u, iterations.size());
  EXPECT_EQ(iterations[0].centreAfter, iterations[1].centreBefore);
  const std::vector<IndividualRecord> policies = db_->realityPolicies(run_, 1, 1);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(policies[k].id, iterations[0].policies[k].individual);
    EXPECT_DOUBLE_EQ(reality(policies[k].parameters) + 0.5, *iterations[0].policies[k].fitness);
    EXPECT_EQ(2, iterations[0].policies[k].count);
    EXPECT_DOUBLE_EQ(0.5, iterations[0].policies[k].standardError);  // of two values one apart
  }

  // The next generation begins with what was best in reality, as near as eight bits say it.
  std::vector<double> top = best;
  for (const RealityIteration& i : iterations)
    for (const IndividualRecord& p : db_->realityPolicies(run_, 1, i.number))
      if (reality(p.parameters) > reality(top)) top = p.parameters;
  const IndividualRecord first = db_->individuals(run_, 3).front();
  for (std::size_t n = 0; n < top.size(); ++n) {
    const double step = (declared[n].maximum - declared[n].minimum) / 255;
    EXPECT_NEAR(top[n], first.parameters[n], 0.51 * step) << declared[n].name;
  }
  // Policies are nobody that L1 bred.
  for (int generation = 1; generation <= 3; ++generation) EXPECT_EQ(6u, db_->individuals(run_, generation).size());
}

TEST_F(RealityLearning, RunsByItselfWithTheStandInAndInTheSimulator) {
  for (const double where : {0.0, 1.0}) {
    spec_.realitySettings["evaluated_in"] = where;
    begin(where == 0 ? "reality" : "simulator");
    ASSERT_EQ(RunEnd::finished, go());
    EXPECT_EQ(4u, db_->realityIterations(run_).size()) << "two of three stages: not after the last";
    for (const MeasurementTask& t : db_->measurementTasks(run_)) EXPECT_TRUE(where == 0 || t.iteration == 0);
    for (const RealityIteration& i : db_->realityIterations(run_))
      for (const RealityPolicy& p : i.policies) {
        EXPECT_EQ(where == 0 ? 2 : 0, p.count);
        if (where == 1) {
          EXPECT_EQ(db_->individual(p.individual).fitness, *p.fitness);
        }
      }
  }
}

TEST_F(RealityLearning, IsDoneInTheStagesThatItsFieldsName) {
  struct Case {
    Values settings;
    std::vector<int> stages;
  };
  int number = 0;
  for (const Case& c : {Case{{{"after_last", 1}}, {1, 2, 3}}, Case{{{"first_stage", 2}}, {2}},
                        Case{{{"every_stages", 2}, {"after_last", 1}}, {1, 3}}, Case{{{"most_stages", 1}}, {1}}}) {
    spec_.realitySettings = c.settings;
    spec_.realitySettings["iterations"] = 1;
    spec_.realitySettings["evaluated_in"] = 1;
    begin("stages" + std::to_string(++number));
    ASSERT_EQ(RunEnd::finished, go());
    std::vector<int> found;
    for (const RealityIteration& i : db_->realityIterations(run_)) found.push_back(i.stage);
    EXPECT_EQ(c.stages, found);
  }
}

TEST_F(RealityLearning, EndsEarlyWhenPatienceIsOver) {
  spec_.reality = "person";
  spec_.realitySettings = {{"iterations", 9}, {"repeats", 1}, {"patience", 2}};
  ASSERT_EQ(RunEnd::waiting, go());
  measure([](const auto&) { return 0.0; });
  ASSERT_EQ(RunEnd::waiting, go());
  // The first iteration is the best; two more are waited for, then L1 goes on.
  double value = 10;
  while (db_->run(run_).stage == 0) {
    measure([&](const auto&) { return value; });
    value -= 1;
    ASSERT_EQ(RunEnd::waiting, go());
    ASSERT_GT(value, 0);
  }
  EXPECT_EQ(3u, db_->realityIterations(run_, 1).size());
}

TEST_F(RealityLearning, APersonEndsItAndWhatWasMeasuredIsKept) {
  spec_.reality = "person";
  spec_.realitySettings = {{"iterations", 9}, {"repeats", 1}};
  spec_.stages["total_generations"] = 3;
  ASSERT_EQ(RunEnd::waiting, go());
  EXPECT_THROW(db_->endRealityLearning(run_, "me"), InputError) << "it has not begun";
  measure([](const auto&) { return 0.5; });
  ASSERT_EQ(RunEnd::waiting, go());
  // One policy of four is measured, and it is better than anything before; then it is enough.
  const auto waiting = db_->realityPolicies(run_, 1, 1);
  const auto value = [&](std::size_t policy, double fitness) {
    db_->addMeasurement({.run = run_, .individual = waiting[policy].id, .value = fitness});
  };
  value(2, 7);
  ASSERT_EQ(RunEnd::waiting, go());
  db_->endRealityLearning(run_, "me");
  db_->endRealityLearning(run_, "me");
  ASSERT_EQ(RunEnd::waiting, go());
  EXPECT_EQ(1, db_->run(run_).stage) << "L3 is done and the next stage waits";

  const auto iterations = db_->realityIterations(run_, 1);
  ASSERT_EQ(1u, iterations.size());
  EXPECT_EQ(iterations[0].centreBefore, iterations[0].centreAfter) << "a quarter of the policies is no step";
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(k == 2, iterations[0].policies[k].fitness.has_value());
  const auto reports = realityReports(*db_, db_->run(run_), genotype());
  ASSERT_EQ(1u, reports.size());
  EXPECT_TRUE(reports[0].isFinished && reports[0].wasEnded);
  // The best of what was measured goes back.
  const IndividualRecord first = db_->individuals(run_, 3).front();
  const std::vector<Parameter> declared = genotype();
  for (std::size_t n = 0; n < declared.size(); ++n)
    EXPECT_NEAR(waiting[2].parameters[n], first.parameters[n],
                0.51 / 255 * (declared[n].maximum - declared[n].minimum));
  // Nobody asks for the rest any more.
  for (const MeasurementTask& t : db_->measurementTasks(run_, 1)) EXPECT_EQ(t.iteration > 0, isOver(t, iterations));
}

TEST_F(RealityLearning, AnIterationThatIsMeasuredWhenItIsEndedStillTakesItsStep) {
  spec_.reality = "person";
  spec_.realitySettings = {{"iterations", 9}, {"repeats", 1}};
  std::vector<std::string> found;
  for (const bool resumed : {false, true}) {
    begin(resumed ? "resumed" : "at once");
    ASSERT_EQ(RunEnd::waiting, go());
    measure([](const auto& p) { return p[0]; });
    ASSERT_EQ(RunEnd::waiting, go());
    measure([](const auto& p) { return p[0]; });
    db_->endRealityLearning(run_, "me");
    if (resumed) {
      // A process that was killed right after the step was stored: the next one finds L2 over.
      const StopFlag stop{true};
      ASSERT_EQ(RunEnd::stopped, continueRun(*db_, host, run_, stop, {.jobs = 2, .progress = {}}));
    }
    ASSERT_EQ(RunEnd::waiting, go());
    const auto iterations = db_->realityIterations(run_, 1);
    ASSERT_EQ(1u, iterations.size());
    EXPECT_NE(iterations[0].centreBefore, iterations[0].centreAfter);
    EXPECT_EQ(1, db_->run(run_).stage);
    found.push_back(exportCsv(*db_, run_, "individuals", genotype(), "m"));
  }
  EXPECT_EQ(found[0], found[1]);
}

TEST_F(RealityLearning, AllValuesVoidAreAskedForAgainAndSomeVoidAreLeftOut) {
  spec_.reality = "person";
  spec_.realitySettings = {{"iterations", 1}, {"repeats", 1}};
  ASSERT_EQ(RunEnd::waiting, go());
  measure([](const auto&) { return 0.5; });
  ASSERT_EQ(RunEnd::waiting, go());
  MeasurementRecord m;
  m.run = run_;
  m.isVoid = true;
  std::vector<Id> waiting;
  for (const MeasurementTask& t : db_->measurementTasks(run_, 1))
    if (t.iteration == 1) waiting.push_back(t.individual);
  for (const Id id : waiting) {
    m.individual = id;
    db_->addMeasurement(m);
  }
  ASSERT_EQ(RunEnd::waiting, go());
  EXPECT_THAT(db_->run(run_).message, testing::HasSubstr("all values are void"));
  m.isVoid = false;
  m.value = 0.7;
  m.individual = waiting.front();
  db_->addMeasurement(m);
  ASSERT_EQ(RunEnd::waiting, go());
  const RealityIteration done = db_->realityIterations(run_, 1).at(0);
  int known = 0;
  for (const RealityPolicy& p : done.policies) known += p.fitness.has_value();
  EXPECT_EQ(1, known);
  EXPECT_EQ(done.centreBefore, done.centreAfter) << "one value says nothing of a direction";
}

TEST_F(RealityLearning, L3GoesOnWhileAPersonTriesThePolicies) {
  spec_.reality = "person";
  spec_.stages["total_generations"] = 3;
  spec_.adaptationSettings["generations"] = 3;
  const auto reality = [](const std::vector<double>& p) { return p[0]; };
  std::vector<SimulatorSpec> versions;
  for (const std::string way : {"policies are tried", "L2 is ended at once", "L3 is to see them"}) {
    const bool ended = way == "L2 is ended at once", sees = way == "L3 is to see them";
    spec_.adaptationSettings["sees_policies"] = sees ? 1 : 0;
    begin(way);
    ASSERT_EQ(RunEnd::waiting, go());
    measure(reality);
    if (ended) {
      // Stopped before the first generation of L3, then no L2: one after the other.
      std::atomic<bool> stop{false};
      RunOptions options{.jobs = 2, .progress = {}};
      options.progress = [&](const RunProgress&) { stop = stop || db_->begunRealityIteration(run_, 1).has_value(); };
      ASSERT_EQ(RunEnd::stopped, continueRun(*db_, host, run_, stop, options));
      EXPECT_TRUE(db_->adaptations(run_, 1).empty());
      db_->endRealityLearning(run_, "me");
    } else {
      ASSERT_EQ(RunEnd::waiting, go());
      EXPECT_EQ(RunState::waiting, db_->run(run_).state);
      EXPECT_EQ(sees ? 0u : 3u, db_->adaptations(run_, 1).size());
      EXPECT_EQ(1u, db_->simulators(run_).size()) << "the version is made when L2 is over";
      EXPECT_EQ("measuring", progressFromJson(db_->run(run_).progressJson).stage) << "that is what a person is to see";
      measure(reality);
      ASSERT_EQ(RunEnd::waiting, go());
      measure(reality);
    }
    ASSERT_EQ(RunEnd::waiting, go());
    EXPECT_EQ(3u, db_->adaptations(run_, 1).size());
    ASSERT_EQ(2u, db_->simulators(run_).size());
    versions.push_back(db_->simulators(run_)[1].simulator);
  }
  EXPECT_EQ(versions[0], versions[1]) << "side by side as one after the other";
}

TEST_F(RealityLearning, PoliciesThatAreMeasuredMeanwhileAreTakenUpBeforeL3IsThrough) {
  spec_.reality = "person";
  spec_.adaptationSettings["generations"] = 4;
  ASSERT_EQ(RunEnd::waiting, go());
  measure([](const auto& p) { return p[0]; });
  // Somebody else enters the values of the first iteration while L3's first generation is simulated.
  bool measured = false;
  RunOptions options{.jobs = 2, .progress = {}};
  std::vector<std::size_t> bredWhenAsked;
  options.progress = [&](const RunProgress& p) {
    if (p.stage == "L2" && p.stageDone == 1 && bredWhenAsked.empty())
      bredWhenAsked.push_back(db_->adaptations(run_, 1).size());
    if (measured || db_->run(run_).state != RunState::waiting || !db_->begunRealityIteration(run_, 1)) return;
    measured = true;
    measure([](const auto& q) { return q[0]; });
  };
  const StopFlag never{false};
  ASSERT_EQ(RunEnd::waiting, continueRun(*db_, host, run_, never, options));
  EXPECT_TRUE(measured);
  EXPECT_EQ(1u, db_->realityIterations(run_, 1).size());
  ASSERT_EQ(1u, bredWhenAsked.size());
  EXPECT_EQ(1u, bredWhenAsked[0]) << "the second iteration waits for one generation, not for all of L3";
  EXPECT_EQ(4u, db_->adaptations(run_, 1).size());
}

TEST_F(RealityLearning, L3SeesThePoliciesOnlyWhereItIsToldTo) {
  spec_.stages["total_generations"] = 3;
  spec_.realitySettings["iterations"] = 1;
  for (const double sees : {0.0, 1.0}) {
    spec_.adaptationSettings["sees_policies"] = sees;
    begin("sees" + std::to_string(static_cast<int>(sees)));
    ASSERT_EQ(RunEnd::finished, go());
    EXPECT_EQ(sees == 1 ? 7 : 3, db_->gaps(run_).at(0).individuals);
  }
}

TEST_F(RealityLearning, NothingOfAHeldOutIndividualReachesL3ThroughPolicies) {
  spec_.reality = "person";
  spec_.stages["total_generations"] = 3;
  spec_.adaptationSettings["held_out"] = 1;
  spec_.adaptationSettings["sees_policies"] = 1;
  // Its first copy is the individual that it begins at, unaltered.
  spec_.realityLearner = {"ga", {{"population", 4}}, {}};
  spec_.realitySettings = {{"iterations", 1}, {"repeats", 1}};
  for (const double beginsAt : {0.0, 1.0}) {
    spec_.realitySettings["begins_at"] = beginsAt;
    begin("held out" + std::to_string(static_cast<int>(beginsAt)));
    ASSERT_EQ(RunEnd::waiting, go());
    std::vector<double> hidden;
    for (const MeasurementTask& t : db_->measurementTasks(run_, 1))
      if (t.heldOut) hidden = db_->individual(t.individual).parameters;
    ASSERT_FALSE(hidden.empty());
    // The one that is held out is the best in reality.
    measure([&](const auto& p) { return p == hidden ? 9.0 : 0.5; });
    ASSERT_EQ(RunEnd::waiting, go());
    for (const IndividualRecord& policy : db_->realityPolicies(run_, 1, 1)) EXPECT_NE(hidden, policy.parameters);
  }
}

TEST_F(RealityLearning, WhatItBeganAtGoesBackWhereNoPolicyWasBetter) {
  spec_.reality = "person";
  spec_.stages["total_generations"] = 3;
  spec_.realitySettings = {{"iterations", 1}, {"repeats", 1}};
  const std::vector<Parameter> declared = genotype();
  for (const double beginsAt : {0.0, 1.0}) {
    spec_.realitySettings["begins_at"] = beginsAt;
    begin("origin" + std::to_string(static_cast<int>(beginsAt)));
    ASSERT_EQ(RunEnd::waiting, go());
    measure([](const auto&) { return 5.0; });
    ASSERT_EQ(RunEnd::waiting, go());
    const std::vector<double> origin = db_->begunRealityIteration(run_, 1)->centreBefore;
    measure([](const auto&) { return 1.0; });
    ASSERT_EQ(RunEnd::waiting, go());
    const IndividualRecord first = db_->individuals(run_, 3).front();
    for (std::size_t n = 0; n < declared.size(); ++n)
      EXPECT_NEAR(origin[n], first.parameters[n], 0.51 / 255 * (declared[n].maximum - declared[n].minimum))
          << declared[n].name;
  }
}

TEST_F(RealityLearning, TheReportShowsTheArithmeticOfTheStepsThatWereTaken) {
  ASSERT_EQ(RunEnd::finished, go());
  const std::vector<Parameter> declared = genotype();
  const auto reports = realityReports(*db_, db_->run(run_), declared);
  ASSERT_EQ(4u, reports.size());
  for (const RealityReport& report : reports) {
    EXPECT_TRUE(report.isFinished);
    ASSERT_EQ(declared.size(), report.steps.size());
    double squares = 0;
    for (const StepRow& s : report.steps) squares += s.gradient.gradient * s.gradient.gradient;
    for (std::size_t n = 0; n < declared.size(); ++n) {
      const StepRow& s = report.steps[n];
      EXPECT_EQ(4, s.gradient.below.count + s.gradient.same.count + s.gradient.above.count);
      const double epsilon = 0.1 * (declared[n].maximum - declared[n].minimum);
      const double expected = squares > 0 ? epsilon * s.gradient.gradient / std::sqrt(squares) : 0;
      const double reached = std::clamp(s.centreBefore + expected, declared[n].minimum, declared[n].maximum);
      EXPECT_NEAR(declared[n].integer ? std::round(reached) : reached, *s.centreAfter,
                  1e-12 * (declared[n].maximum - declared[n].minimum) + 1e-12)
          << s.parameter.name;
    }
  }
}

TEST_F(RealityLearning, ExportsPoliciesAndSteps) {
  ASSERT_EQ(RunEnd::finished, go());
  const std::vector<Parameter> declared = genotype();
  const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
  EXPECT_EQ(1 + 4 * 4, lines(exportCsv(*db_, run_, "policies", declared, "m")));
  EXPECT_EQ(1 + 4 * static_cast<long>(declared.size()), lines(exportCsv(*db_, run_, "steps", declared, "m")));
  EXPECT_EQ(1 + 6 * 4, lines(exportCsv(*db_, run_, "individuals", declared, "m"))) << "L1's own";
}

TEST_F(RealityLearning, AnyLearnerMayStandInIt) {
  for (const PluginChoice& learner :
       {PluginChoice{"ga", {{"population", 4}}, {}}, PluginChoice{"cma_es", {{"population", 4}}, {}}}) {
    spec_.realityLearner = learner;
    begin(learner.name);
    ASSERT_EQ(RunEnd::finished, go());
    EXPECT_EQ(4u, db_->realityIterations(run_).size());
    for (const RealityReport& report : realityReports(*db_, db_->run(run_), genotype())) {
      EXPECT_EQ(4u, report.policies.size());
      EXPECT_TRUE(report.steps.empty());
    }
  }
}

TEST_F(RealityLearning, AnExperimentWithoutItKeepsItsTextAndWhatItsPluginRefusesIsRefusedAtOnce) {
  ExperimentSpec without = spec_;
  without.realityLearner = {};
  EXPECT_EQ(std::string::npos, toJsonText(without).find("reality_learning"));
  const ExperimentSpec again = experimentFromJson(toJsonText(spec_), "spec", "");
  EXPECT_EQ(spec_.realityLearner, again.realityLearner);
  EXPECT_EQ(spec_.realitySettings, again.realitySettings);
  spec_.realityLearner.settings["policies"] = 2;
  EXPECT_THROW(prepareFromFiles(spec_, host), InputError);
  spec_.realityLearner = {"gradient", {}, {}};
  EXPECT_THROW(prepareFromFiles(spec_, host), InputError);
}

}  // namespace
