// The experiments that come with the program.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/spec/comparison_spec.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"
#include "core/spec/scene_spec.h"

namespace btr {
namespace {

ExperimentSpec example(const std::string& name) {
  return loadExperiment(std::string(SOURCE_DIR) + "/resources/experiments/" + name);
}

TEST(ExampleExperiments, KickHasAllSettingsOfThePaper) {
  const ExperimentSpec kick = example("kick.json");
  const auto stage = [&](const std::string& name) { return valueOf(stageParameters(), kick.stages, name); };
  EXPECT_EQ("kick", kick.controller.name);
  EXPECT_EQ(0.75, kick.learner.settings.at("crossover"));
  EXPECT_EQ(0.015, kick.learner.settings.at("mutation"));
  EXPECT_EQ(8, kick.learner.settings.at("bits"));
  EXPECT_EQ(50, stage("first_generations"));
  EXPECT_EQ(100, stage("next_generations"));
  EXPECT_EQ(500, stage("total_generations"));
  EXPECT_EQ(10, stage("measured_individuals"));
  EXPECT_EQ(10, valueOf(adaptationParameters(), kick.adaptationSettings, "generations"));
  EXPECT_TRUE(kick.adapted.empty());
  EXPECT_EQ("person", kick.reality);
}

TEST(ExampleExperiments, TheShortKickMeasuresThreeTimesByTheStandIn) {
  const ExperimentSpec kick = example("kick-short.json");
  const auto stage = [&](const std::string& name) { return valueOf(stageParameters(), kick.stages, name); };
  EXPECT_EQ(150, stage("total_generations"));
  EXPECT_EQ(150, stage("first_generations") + 2 * stage("next_generations"));
  EXPECT_EQ("stand_in", kick.reality);
}

TEST(ExampleExperiments, WalkHasAllSettingsOfThePaper) {
  const ExperimentSpec walk = example("walk.json");
  EXPECT_EQ("walk", walk.controller.name);
  EXPECT_EQ(20, walk.controller.settings.at("duration_s"));
  EXPECT_EQ(0.7, walk.learner.settings.at("crossover"));
  EXPECT_EQ(0.005, walk.learner.settings.at("mutation"));
  EXPECT_EQ(8, walk.learner.settings.at("bits"));
  EXPECT_EQ(10, valueOf(stageParameters(), walk.stages, "measured_individuals"));
  // The paper minimises the norm of the differences of the ten.
  EXPECT_EQ(1, valueOf(adaptationParameters(), walk.adaptationSettings, "norm"));
  EXPECT_TRUE(walk.adapted.empty());
  EXPECT_EQ("person", walk.reality);
  EXPECT_EQ("stand_in", example("walk-short.json").reality);
}

TEST(ExampleExperiments, BeginWithTheStartingValuesOfAllTwelveParameters) {
  for (const char* name : {"kick.json", "kick-short.json", "walk.json", "walk-short.json"}) {
    const Values given = example(name).simulator.values;
    for (const Parameter& parameter : simulatorParameters())
      EXPECT_EQ(parameter.byDefault, given.at(parameter.name)) << name << " " << parameter.name;
  }
}

TEST(ExampleExperiments, TheirScenesCanBeRead) {
  for (const char* name : {"kick.json", "kick-short.json", "walk.json", "walk-short.json"}) {
    const ExperimentSpec spec = example(name);
    const SceneSpec scene = loadScene(spec.directory + "/" + spec.scene);
    EXPECT_EQ(1u, scene.robots.size());
    EXPECT_EQ(spec.controller.name == "kick" ? 1u : 0u, scene.balls.size());
  }
}

// Else a chart would show more than one cause.
TEST(ExampleExperiments, WhatIsComparedDiffersInRecordingsAlone) {
  for (const char* name : {"worn-knee.json", "worn-knee-kept.json", "other-engine.json", "other-engine-walk.json"}) {
    const ComparisonSpec comparison = loadComparison(std::string(SOURCE_DIR) + "/resources/comparisons/" + name);
    ASSERT_GE(comparison.arms.size(), 2u);
    nlohmann::json first;
    for (const ComparisonSpec::Arm& arm : comparison.arms) {
      const std::string path = comparison.directory + "/" + arm.experiment;
      const ExperimentSpec spec = loadExperiment(path);
      EXPECT_EQ(arm.name != "parameters alone", spec.recordings.wanted()) << path;
      nlohmann::json rest = nlohmann::json::parse(readFile(path));
      rest.erase("name");
      rest.erase("recordings");
      if (first.is_null()) first = rest;
      EXPECT_EQ(first, rest) << path;
    }
  }
}

}  // namespace
}  // namespace btr
