// An experiment made ready from files, stored as a run, and made ready again from what was stored.
#include "core/run/setup/prepared_experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/run/setup/evaluator.h"
#include "core/sim/contact/collision.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"
#include "tests/genotypes.h"
#include "tests/plugin/built_plugins.h"
#include "tests/refusal.h"

namespace {

using namespace btr;
using testing::HasSubstr;

using test::host;

PreparedExperiment kick() {
  return prepareFromFiles(loadExperiment(SOURCE_DIR "/resources/experiments/kick-short.json"), host());
}

TEST(RunRecord, HoldsEverythingThatARunDependsOn) {
  const PreparedExperiment prepared = kick();
  const RunRecord run = makeRunRecord(prepared, 7, 42);
  EXPECT_EQ(run.experiment, 7);
  EXPECT_EQ(run.seed, 42u);
  EXPECT_EQ(run.reality, "stand_in");
  EXPECT_EQ(run.state, RunState::ready);
  ASSERT_EQ(run.files.size(), 1u);
  EXPECT_EQ(run.files[0].name, "../robots/ers7.wrl");
  EXPECT_EQ(run.files[0].content, readFile(SOURCE_DIR "/resources/robots/ers7.wrl"));
  EXPECT_EQ(run.files[0].sha256, sha256(run.files[0].content));
  EXPECT_EQ(run.specSha256, sha256(run.specJson + run.sceneJson + run.files[0].name + run.files[0].sha256));
}

TEST(RunRecord, ItsHashTellsSpecificationsSceneAndModelsApartAndSeedsNot) {
  const PreparedExperiment prepared = kick();
  const std::string hash = makeRunRecord(prepared, 1, 1).specSha256;
  EXPECT_EQ(makeRunRecord(prepared, 2, 9).specSha256, hash);

  PreparedExperiment other = kick();
  other.specInWords.stages["repeats"] = 3;
  EXPECT_NE(makeRunRecord(other, 1, 1).specSha256, hash);
  other = kick();
  other.sceneSpec.floor->friction += 1e-9;
  EXPECT_NE(makeRunRecord(other, 1, 1).specSha256, hash);
  other = kick();
  other.files[0].sha256 = sha256("another robot");
  EXPECT_NE(makeRunRecord(other, 1, 1).specSha256, hash);
}

/// A fitness whose formula divides by nothing.
class NoNumber final : public Fitness {
  std::string unit() const override { return "m"; }
  std::string meaning() const override { return "nothing"; }
  std::vector<Parameter> settings() const override { return {}; }
  double evaluate(const TrialResult&, const Values&, const Values&) const override { return std::nan(""); }
  double ofFailure() const override { return -3; }
};

TEST(PreparedExperiment, ATrialWhoseFitnessIsNoNumberHasFailedAndSaysSo) {
  PreparedExperiment prepared = kick();
  prepared.fitness = std::make_shared<NoNumber>();
  prepared.spec.fitness = {"torn", {}};
  std::vector<double> usual;
  for (const Parameter& p : prepared.genotype) usual.push_back(p.byDefault);
  for (const bool fitnessOnly : {false, true}) {
    const TrialReply reply = runTrialJob(prepared, {prepared.spec.simulator, usual, 1, false, {}, fitnessOnly});
    EXPECT_EQ("no fitness", reply.outcome);
    EXPECT_EQ("the fitness plugin \"torn\" gave no finite number", reply.detail);
    EXPECT_EQ(-3, reply.fitness);
  }
}

ExperimentSpec ownRobot() { return loadExperiment(SOURCE_DIR "/resources/experiments/own-robot-walk.json"); }

std::vector<std::string> namesOf(const std::vector<Parameter>& parameters) {
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters) names.push_back(parameter.name);
  return names;
}

// A robot of one's own has neither an AIBO's head nor its legs.
TEST(AnotherRobot, HasTheParametersThatMeanSomethingInItsScene) {
  const std::vector<std::string> floors{"friction", "gravity_m_s2", "slip1_m_s_n", "slip2_m_s_n"};
  ExperimentSpec spec = ownRobot();
  spec.adapted.clear();
  const PreparedExperiment prepared = prepareFromFiles(spec, host());
  EXPECT_EQ(namesOf(prepared.parameters), floors);
  EXPECT_EQ(namesOf(prepared.adapted), floors);
  for (const auto& [name, value] : firstSimulator(prepared).simulator.values)
    EXPECT_THAT(floors, testing::Contains(name));
  EXPECT_EQ(namesOf(kick().parameters), namesOf(simulatorParameters()));
}

TEST(AnotherRobot, WhatSaysOnlyTheUsualOfAnAiboIsPassedOver) {
  ExperimentSpec spec = ownRobot();
  for (const Parameter& p : simulatorParameters()) spec.simulator.values[p.name] = p.byDefault;
  EXPECT_EQ(4u, prepareFromFiles(spec, host()).spec.simulator.values.size());
  spec.simulator.values["body_mass_kg"] = 0.7;
  EXPECT_THAT(test::refusal([&] { prepareFromFiles(spec, host()); }),
              testing::AllOf(HasSubstr("experiment /simulator/values: body_mass_kg is not allowed"),
                             HasSubstr("only for robots whose model has a body")));
}

TEST(AnotherRobot, AParameterThatMeansNothingCannotBeAdapted) {
  ExperimentSpec spec = ownRobot();
  spec.adapted.push_back("servo_p_nm_rad");
  EXPECT_THAT(test::refusal([&] { prepareFromFiles(spec, host()); }),
              testing::AllOf(HasSubstr("experiment /adaptation/parameters: servo_p_nm_rad is not allowed"),
                             HasSubstr("only for robots with legs")));
}

TEST(PreparedExperiment, FromItsRunIsTheSameToTheLastBit) {
  const PreparedExperiment first = kick();
  const RunRecord run = makeRunRecord(first, 1, 5);
  const PreparedExperiment again = prepareFromRun(run, host());
  EXPECT_EQ(toJsonText(again.specInWords), toJsonText(first.specInWords));
  EXPECT_EQ(again.genotype.size(), first.genotype.size());
  EXPECT_EQ(makeRunRecord(again, 1, 5).specSha256, run.specSha256);

  const std::vector<double> middle = test::middleOf(first.genotype);
  const auto result = [&](const PreparedExperiment& prepared) {
    return prepared.trial(prepared.scene(prepared.spec.simulator), middle, 11, true);
  };
  const TrialResult one = result(first), two = result(again);
  EXPECT_EQ(one.trace.values, two.trace.values);
  EXPECT_EQ(first.fitnessOf(one), again.fitnessOf(two));
}

// A goal of a mesh stands in the kick's way: what the ball meets must not hang on a file that somebody moves.
TEST(PreparedExperiment, KeepsTheMeshesOfItsRobots) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("uchilsim-goal-" + std::to_string(getpid()));
  fs::create_directories(folder / "meshes");
  writeFile((folder / "meshes/wall.obj").string(),
            "v 0 -1 0\nv 0 1 0\nv 0 1 1\nv 0 -1 1\nv 0.1 -1 0\nv 0.1 1 0\nv 0.1 1 1\nv 0.1 -1 1\n"
            "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n");
  writeFile((folder / "goal.urdf").string(),
            "<robot name='goal'><link name='wall'><collision><geometry><mesh filename='meshes/wall.obj'/></geometry>"
            "</collision><visual><geometry><mesh filename='meshes/paint.dae'/></geometry></visual></link></robot>");
  ExperimentSpec spec = loadExperiment(SOURCE_DIR "/resources/experiments/kick-short.json");
  SceneSpec scene = loadScene(SOURCE_DIR "/resources/scenes/kick.json");
  scene.robots[0].model = SOURCE_DIR "/resources/robots/ers7.wrl";
  RobotSpec goal;
  goal.name = "goal";
  goal.model = "goal.urdf";
  goal.base = "fixed";
  goal.position_m = {0.6, 0, 0};
  scene.robots.push_back(goal);
  writeFile((folder / "scene.json").string(), toJsonText(scene));
  spec.directory = folder.string();
  spec.scene = "scene.json";

  const PreparedExperiment first = prepareFromFiles(spec, host());
  const RunRecord run = makeRunRecord(first, 1, 5);
  fs::remove_all(folder);
  ASSERT_EQ(run.files.size(), 3u);
  EXPECT_EQ(run.files[2].name, "goal.urdf: meshes/wall.obj");
  const PreparedExperiment again = prepareFromRun(run, host());
  const std::vector<double> middle = test::middleOf(first.genotype);
  const auto result = [&](const PreparedExperiment& prepared) {
    return prepared.trial(prepared.scene(prepared.spec.simulator), middle, 11, true);
  };
  EXPECT_EQ(result(first).trace.values, result(again).trace.values);
  for (const PreparedExperiment* prepared : {&first, &again}) {
    const auto& wall = prepared->models.at("goal.urdf")->links[0].shapes;
    ASSERT_EQ(wall.size(), 1u);
    ASSERT_TRUE(wall[0].hull);
    EXPECT_EQ(wall[0].hull->points.size(), 8u);
  }
  // The paint is only missed by the eye.
  EXPECT_THAT(runLosses(run, host()), testing::IsEmpty());
}

// Every trial would finish with fitness 0, and hours would pass.
TEST(PreparedExperiment, RefusesAKickWithoutABall) {
  ExperimentSpec spec = loadExperiment(SOURCE_DIR "/resources/experiments/walk-short.json");
  spec.fitness = {"kick_distance", {}, {}};
  EXPECT_THAT(test::refusal([&] { prepareFromFiles(spec, host()); }),
              HasSubstr("kick_distance: the scene has no ball; choose a scene with one"));
}

TEST(PreparedExperiment, NeedsNoFilesOnceItIsStored) {
  RunRecord run = makeRunRecord(kick(), 1, 5);
  run.files[0].content = "#VRML V2.0 utf8\n";
  EXPECT_THROW(prepareFromRun(run, host()), InputError) << "the stored text is what counts";
  run.files.clear();
  EXPECT_THROW(prepareFromRun(run, host()), InputError);
}

TEST(PreparedExperiment, RefusesWhatCannotBeRun) {
  const auto refusal = [](const std::function<void(ExperimentSpec&)>& change) -> std::string {
    ExperimentSpec spec = loadExperiment(SOURCE_DIR "/resources/experiments/kick-short.json");
    change(spec);
    try {
      prepareFromFiles(spec, host());
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal([](ExperimentSpec& s) { s.controller.name = "dance"; }), HasSubstr("dance"));
  EXPECT_THAT(refusal([](ExperimentSpec& s) { s.learner.settings["population"] = -4; }), HasSubstr("population"));
  EXPECT_THAT(refusal([](ExperimentSpec& s) { s.simulator.values["friction"] = 99; }), HasSubstr("friction"));
  EXPECT_THAT(refusal([](ExperimentSpec& s) { s.simulator.values["robots.ers7.servos.LF_J9.p"] = 1; }),
              HasSubstr("LF_J9"));
  EXPECT_THAT(refusal([](ExperimentSpec& s) { s.scene = "../scenes/nowhere.json"; }), HasSubstr("nowhere.json"));
}

}  // namespace
