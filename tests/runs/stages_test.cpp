// Between the stages: who may be measured, what happens when nobody is left, and an L3 whose evidence changed
// meanwhile.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/run/setup/prepared_experiment.h"
#include "tests/refusal.h"
#include "tests/runs/small_kick_run.h"

namespace {

using namespace btr;
using nlohmann::json;
using testing::HasSubstr;

/// A value for each individual of the stage that waits: what it had in the simulator and `more`.
void measureAll(test::SmallKickRun& r, double more) {
  const int stage = r.database_.run(r.run_).stage + 1;
  for (const MeasurementTask& t : r.database_.measurementTasks(r.run_, stage))
    r.database_.addMeasurement({.run = r.run_, .individual = t.individual, .value = t.simulatedFitness + more});
}

void smallAdaptation(json& text) {
  text["adaptation"]["learner"]["settings"]["population"] = 4;
  text["adaptation"]["settings"]["generations"] = 2;
}

TEST(Adaptation, ThatGoesOnAfterAMeasuredValueChangedComparesCandidatesByTheNewValuesAlone) {
  // The same run twice, as far as L3, which the first ends with its first generation.
  const auto oneGeneration = [](json& text) {
    smallAdaptation(text);
    text["adaptation"]["settings"]["generations"] = 1;
  };
  test::SmallKickRun before(6, 3, oneGeneration), after(6, 3, smallAdaptation);
  ASSERT_EQ(RunEnd::waiting, before.goOn());
  ASSERT_EQ(RunEnd::waiting, after.goOn());
  measureAll(before, 0);
  ASSERT_EQ(RunEnd::waiting, before.goOn());
  const AdaptationRecord begun = before.database_.adaptations(before.run_, 1).at(0);
  ASSERT_LT(begun.bestError, 2);

  // It was stopped there, and the values turned out to be four metres too small.
  after.database_.addAdaptation(begun);
  measureAll(after, 4);
  ASSERT_EQ(RunEnd::waiting, after.goOn());
  const SimulatorRecord version = after.database_.simulators(after.run_).back();
  const GapRecord gap = after.database_.gaps(after.run_).at(0);
  EXPECT_DOUBLE_EQ(json::parse(version.evidence).at("error").get<double>(), gap.after);
  EXPECT_LE(gap.after, gap.before);
  EXPECT_GT(gap.after, 2) << "no kick goes four metres farther";
}

TEST(Measuring, ChoosesNobodyWhoseTrialDidNotComeToItsEnd) {
  // Motions take different times: some of the drawn ones are longer than a trial that the default one just fits into.
  const PluginHost host(PLUGIN_DIR);
  const PreparedExperiment prepared =
      prepareFromFiles(loadExperiment(SOURCE_DIR "/resources/experiments/kick-short.json"), host);
  std::vector<double> usual;
  for (const Parameter& p : prepared.genotype) usual.push_back(p.byDefault);
  const Scene scene = prepared.scene(prepared.spec.simulator);
  const double duration = prepared.controller->begin(scene, prepared.spec.controller.settings, usual)->duration();
  test::SmallKickRun r(20, 10, [&](json& text) { text["stages"]["trial_maximum_s"] = duration; });
  ASSERT_EQ(RunEnd::waiting, r.goOn());
  int failed = 0;
  for (const IndividualRecord& i : r.database_.individuals(r.run_, 1)) failed += i.outcome != "finished";
  ASSERT_GT(failed, 0);
  ASSERT_LT(failed, 20);
  for (const MeasurementTask& t : r.database_.measurementTasks(r.run_, 1))
    EXPECT_EQ("finished", r.database_.individual(t.individual).outcome);
}

TEST(Measuring, PassesAStageInWhichEverybodyWasMeasuredBefore) {
  test::SmallKickRun r(2, 2, [](json& text) {
    text["learner"]["settings"]["crossover"] = 0;
    text["learner"]["settings"]["mutation"] = 0;
    smallAdaptation(text);
  });
  ASSERT_EQ(RunEnd::waiting, r.goOn());
  measureAll(r, 0.1);
  EXPECT_EQ(RunEnd::finished, r.goOn());
  EXPECT_EQ(2, r.database_.run(r.run_).stage);
  EXPECT_EQ(1u, r.database_.gaps(r.run_).size()) << "nothing new was measured: no update";
}

TEST(PreparedExperiment, RefusesATrialThatEndsBeforeTheMotion) {
  const PluginHost host(PLUGIN_DIR);
  ExperimentSpec spec = loadExperiment(SOURCE_DIR "/resources/experiments/walk-short.json");
  spec.stages["trial_maximum_s"] = 20;
  spec.controller.settings["duration_s"] = 20;
  EXPECT_NO_THROW(prepareFromFiles(spec, host));
  spec.controller.settings["duration_s"] = 20.1;
  EXPECT_THAT(test::refusal([&] { prepareFromFiles(spec, host); }),
              testing::AllOf(HasSubstr("stages/trial_maximum_s"), HasSubstr("20 s"), HasSubstr("at least 20.1")));
}

}  // namespace
