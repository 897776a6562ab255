// Any learner may stand in any stage, and what was stored before there was a choice goes on as it did.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/run/loop/back_to_reality.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/json_reader.h"

namespace {

namespace fs = std::filesystem;
using namespace btr;

class AnyLearner : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }

  static ExperimentSpec smallKick() {
    ExperimentSpec spec = loadExperiment(SOURCE_DIR "/resources/experiments/kick-short.json");
    spec.learner.settings["population"] = 6;
    spec.adaptation.settings["population"] = 4;
    spec.adaptationSettings["generations"] = 2;
    spec.stages = {
        {"first_generations", 2}, {"next_generations", 2}, {"total_generations", 4}, {"measured_individuals", 3}};
    return spec;
  }

  /// All numbers that a run found.
  static std::string results(const Database& db, Id run) {
    nlohmann::json all;
    for (const GenerationRecord& g : db.generations(run)) all.push_back({g.number, g.best, g.mean, g.trials, g.reused});
    for (const IndividualRecord& i : db.individuals(run)) all.push_back({i.parameters, i.fitness, i.traceSha256});
    for (const MeasurementRecord& m : db.measurements(run)) all.push_back({m.individual, m.value, m.isVoid});
    for (const SimulatorRecord& s : db.simulators(run)) all.push_back(toJsonText(s.simulator));
    for (int stage = 1; stage <= 2; ++stage)
      for (const AdaptationRecord& a : db.adaptations(run, stage))
        for (const AdaptationCandidate& c : a.candidates) all.push_back({c.parameters, c.error});
    return all.dump();
  }

  PluginHost host{PLUGIN_DIR};

 private:
  fs::path folder_ = fs::temp_directory_path() / ("btr-any-" + std::to_string(getpid()));
};

TEST_F(AnyLearner, RunsToTheEndInL1AndInL3WithAnyNumberOfWorkers) {
  struct Choice {
    PluginChoice learner, adaptation;
  };
  for (const Choice& choice :
       {Choice{{"pgrl", {{"policies", 5}}, {}}, {"cma_es", {{"population", 4}}, {}}},
        Choice{{"cma_es", {{"population", 5}}, {}}, {"pgrl", {{"policies", 4}, {"epsilon_friction", 0.2}}, {}}}}) {
    ExperimentSpec spec = smallKick();
    spec.learner = choice.learner;
    spec.adaptation = choice.adaptation;
    std::vector<std::string> found;
    for (const int jobs : {1, 3}) {
      Database db = Database::open(at(spec.learner.name + std::to_string(jobs) + ".db"), Database::Mode::create);
      const StopFlag never{false};
      const Id run = startRun(db, host, spec, 1);
      ASSERT_EQ(RunEnd::finished, continueRun(db, host, run, never, {.jobs = jobs, .progress = {}}));
      EXPECT_EQ(3u, db.simulators(run).size());
      found.push_back(results(db, run));
    }
    EXPECT_EQ(found[0], found[1]);
  }
}

TEST_F(AnyLearner, SettingsOfSimulatorParametersThatAreNotAdaptedPlayNoPart) {
  ExperimentSpec spec = smallKick();
  spec.adaptation = {"pgrl", {{"policies", 4}, {"epsilon_friction", 0.2}}, {}};
  spec.adapted = {"gravity_m_s2"};
  const PreparedExperiment prepared = prepareFromFiles(spec, host);
  EXPECT_EQ((Values{{"policies", 4}}), prepared.spec.adaptation.settings);
  EXPECT_EQ(0.2, prepared.specInWords.adaptation.settings.at("epsilon_friction"));
}

TEST_F(AnyLearner, ACentredLearnerAdaptsFromTheParentsValues) {
  ExperimentSpec spec = smallKick();
  spec.adaptation = {"pgrl", {{"policies", 3}, {"measure_centre", 1}}, {}};
  Database db = Database::open(at("centre.db"), Database::Mode::create);
  const StopFlag never{false};
  const Id run = startRun(db, host, spec, 1);
  ASSERT_EQ(RunEnd::finished, continueRun(db, host, run, never, {.jobs = 2, .progress = {}}));
  const PreparedExperiment prepared = prepareFromRun(db.run(run), host);
  for (int stage = 1; stage <= 2; ++stage) {
    std::vector<double> parent;
    for (const Parameter& p : prepared.adapted)
      parent.push_back(db.simulators(run)[static_cast<std::size_t>(stage - 1)].simulator.values.at(p.name));
    EXPECT_EQ(parent, db.adaptations(run, stage).front().candidates.back().parameters);
  }
}

TEST_F(AnyLearner, TheShippedRunIsFoundAgainByItsExperimentAndItsLearnerGoesThroughItsGenerationsToTheBit) {
  fs::copy_file(SOURCE_DIR "/experiments.db", at("shipped.db"));
  const Database db = Database::open(at("shipped.db"), Database::Mode::readWrite);
  const RunRecord stored = db.run(1);
  const PreparedExperiment prepared = prepareFromRun(stored, host);
  EXPECT_EQ(stored.specSha256, makeRunRecord(prepared, 1, stored.seed).specSha256);

  // What was simulated is taken as it was stored: a finer world may simulate otherwise, the search may not go
  // otherwise.
  const auto learner = host.learner(prepared.spec.learner.name);
  Random random = Random::forPurpose(stored.seed, "L1");
  learner->start(prepared.genotype, prepared.spec.learner.settings, random);
  for (int number = 1; number <= stored.generation; ++number) {
    const std::vector<IndividualRecord> individuals = db.individuals(1, number);
    const std::vector<Candidate> candidates = learner->ask(random);
    ASSERT_EQ(individuals.size(), candidates.size());
    std::vector<double> fitness;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      ASSERT_EQ(individuals[i].chromosome, candidates[i].chromosome) << "generation " << number;
      ASSERT_EQ(individuals[i].parameters, candidates[i].parameters) << "generation " << number;
      fitness.push_back(individuals[i].fitness);
    }
    learner->tell(fitness);
  }
  EXPECT_EQ(db.lastGeneration(1)->learnerState, learner->state());
  EXPECT_EQ(db.lastGeneration(1)->randomState, random.state());
}

}  // namespace
