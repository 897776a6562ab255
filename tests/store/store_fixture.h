#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/store/database.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr {

/// A folder of its own for each test, removed behind it.
class StoreTest : public testing::Test {
 protected:
  std::string pathOf(const std::string& name) const { return (folder_ / name).string(); }
  std::string file() const { return pathOf("kick.db"); }
  Database create() const { return Database::open(file(), Database::Mode::create); }

  const TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

using test::refusal;

inline ExperimentRecord kickExperiment() {
  return {.id = 0, .name = "kick", .specJson = R"({"name": "kick"})", .createdAt = "", .note = ""};
}

inline RunRecord runOf(Id experiment, std::uint64_t seed = 1) {
  RunRecord run;
  run.experiment = experiment;
  run.seed = seed;
  run.specJson = R"({"name": "kick"})";
  run.specSha256 = "abc";
  run.sceneJson = "{}";
  run.reality = "person";
  return run;
}

/// Experiment and run, ready for generation 1. The run is 1, its simulator version 0 has the id 1.
inline Id startRun(Database& database) {
  return database.addRun(runOf(database.addExperiment(kickExperiment())), SimulatorRecord{});
}

/// A generation whose chromosomes and fitness follow from its number.
inline GenerationRecord generationOf(Id run, int number, int individuals = 30, int parameters = 25) {
  GenerationRecord generation;
  generation.run = run;
  generation.number = number;
  generation.simulator = 1;
  generation.randomState = "random " + std::to_string(number);
  generation.learnerState = "learner " + std::to_string(number);
  for (int slot = 0; slot < individuals; ++slot) {
    IndividualRecord individual;
    individual.slot = slot;
    for (int bit = 0; bit < 8 * parameters; ++bit)
      individual.chromosome += ((number * 31 + slot) >> (bit % 16) & 1) ? '1' : '0';
    individual.parameters.assign(static_cast<std::size_t>(parameters), 1.0 / (number + slot));
    individual.fitness = number + slot / 100.0;
    individual.trialSeed = 0x8000000000000000u + static_cast<std::uint64_t>(slot);
    generation.individuals.push_back(individual);
  }
  generation.best = number + (individuals - 1) / 100.0;
  generation.worst = number;
  generation.mean = number + (individuals - 1) / 200.0;
  generation.trials = individuals;
  return generation;
}

}  // namespace btr
