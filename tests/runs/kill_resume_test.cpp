// kill -9 at any moment: the run that goes on gives the same bits as the one that nobody disturbed.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/plugin/plugin_host.h"
#include "core/spec/json_reader.h"
#include "core/spec/random.h"
#include "core/store/database.h"
#include "tests/runs/child_program.h"

namespace {

namespace fs = std::filesystem;
using namespace btr;

class KilledRun : public testing::Test {
 protected:
  explicit KilledRun(std::string experiment = "kick-short.json") : experiment_(std::move(experiment)) {}
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("btr-kill-" + std::to_string(getpid()));
    fs::create_directories(folder_);
    // The short experiment, smaller still: 3 × 4 generations of 8, three measurement stages, small adaptations, kicks
    // that are soon over.
    nlohmann::json spec = nlohmann::json::parse(readFile(SOURCE_DIR "/resources/experiments/" + experiment_));
    if (experiment_ == "kick-short.json") spec["controller"]["settings"].update({{"hold_s", 0}, {"return_s", 0.1}});
    if (experiment_ == "walk-short.json") {
      spec["controller"]["settings"]["duration_s"] = 1;
      spec["reality_learning"]["learner"]["settings"]["policies"] = 4;
      spec["reality_learning"]["settings"]["iterations"] = 1;
    }
    spec["scene"] = fs::absolute(fs::path(SOURCE_DIR "/resources/experiments") / spec["scene"].get<std::string>())
                        .lexically_normal();
    spec["learner"]["settings"]["population"] = 8;
    spec["adaptation"]["learner"]["settings"]["population"] = 4;
    spec["adaptation"]["settings"]["generations"] = 3;
    spec["stages"]["first_generations"] = 4;
    spec["stages"]["next_generations"] = 4;
    spec["stages"]["total_generations"] = 12;
    spec["stages"]["measured_individuals"] = 4;
    spec["reality"] = "stand_in";
    writeFile(spec_(), spec.dump());
  }

  /// The same with L2 after the first two stages: its policies twice measured, what it finds seen by L3 and given back.
  void learnInReality() {
    nlohmann::json spec = nlohmann::json::parse(readFile(spec_()));
    spec["reality_learning"] = {{"learner", {{"name", "pgrl"}, {"settings", {{"policies", 5}, {"epsilon", 0.1}}}}},
                                {"settings", {{"iterations", 2}, {"repeats", 2}, {"copies", 0.75}}}};
    spec["stages"]["disagreeing_individuals"] = 2;
    spec["stages"]["candidate_simulators"] = 3;
    spec["adaptation"]["settings"]["sees_policies"] = "yes";
    writeFile(spec_(), spec.dump());
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string spec_() const { return (folder_ / "experiment.json").string(); }
  std::string database(const std::string& name) const { return (folder_ / (name + ".db")).string(); }

  pid_t start(const std::string& db, const char* jobs) const {
    return startBtr({"run", spec_(), "--db", db, "--jobs", jobs});
  }

  /// Everything in the database that is a result, as text; wall-clock times are not.
  static std::string results(const std::string& path) {
    const Database db = Database::open(path, Database::Mode::readOnly);
    nlohmann::json all;
    for (const GenerationRecord& g : db.generations(1)) {
      all["generations"].push_back({g.number, g.simulator, g.best, g.mean, g.worst, g.trials, g.reused, g.failed});
      for (const IndividualRecord& i : db.individuals(1, g.number))
        all["individuals"].push_back({i.id, i.generation, i.slot, i.simulator, i.chromosome, i.parameters, i.fitness,
                                      i.outcome, i.detail, i.sameAs, i.trialSeed, i.traceSha256});
    }
    for (const MeasurementTask& t : db.measurementTasks(1))
      all["tasks"].push_back({t.stage, t.individual, t.position, t.simulatedFitness, t.wantedRepeats, t.heldOut,
                              t.iteration, t.rank, t.disagreement.value_or(-1), t.candidates});
    for (const RealityIteration& r : db.realityIterations(1)) {
      all["iterations"].push_back({r.stage, r.number, r.centreBefore, r.centreAfter, r.randomState, r.learnerState});
      for (const IndividualRecord& i : db.realityPolicies(1, r.stage, r.number))
        all["policies"].push_back({i.id, i.generation, i.slot, i.iteration, i.parameters, i.fitness, i.traceSha256});
      for (const RealityPolicy& p : r.policies)
        all["told"].push_back({p.individual, p.fitness.value_or(-1e9), p.standardError, p.count});
    }
    for (const MeasurementRecord& m : db.measurements(1))
      all["measurements"].push_back({m.individual, m.value, m.isVoid, m.source});
    for (const SimulatorRecord& s : db.simulators(1))
      all["simulators"].push_back({s.number, s.parent, toJsonText(s.simulator), s.madeBy, s.evidence});
    for (const GapRecord& g : db.gaps(1))
      all["gaps"].push_back({g.stage, g.before, g.after, g.newBefore, g.newAfter, g.individuals});
    for (int stage = 1; stage <= 3; ++stage)
      for (const AdaptationRecord& a : db.adaptations(1, stage)) {
        all["adaptations"].push_back({a.stage, a.number, a.bestError, a.meanError});
        for (const AdaptationCandidate& c : a.candidates)
          all["candidates"].push_back({c.chromosome, c.parameters, c.error});
      }
    return all.dump();
  }

  /// Kills runs after a drawn time until `kills` were; then the last one is left to finish. A run that finishes before
  /// its time is compared and begun anew.
  void killAndCompare(const std::string& expected, int kills) const {
    Random random(20040711);
    int done = 0, runs = 0;
    while (true) {
      const std::string db = database("killed" + std::to_string(runs));
      const pid_t pid = start(db, done % 2 ? "2" : "1");
      if (done < kills) {
        usleep(static_cast<useconds_t>(random.uniform(0, 400'000)));
        kill(pid, SIGKILL);
      }
      const int end = endOf(pid);
      if (end == -SIGKILL) {
        ++done;
        continue;
      }
      ASSERT_EQ(0, end) << "after " << done << " kills";
      ASSERT_EQ(expected, results(db)) << "after " << done << " kills";
      ++runs;
      if (done >= kills) break;
    }
  }

 private:
  const std::string experiment_;
  fs::path folder_;
};

class KilledWalk : public KilledRun {
 protected:
  KilledWalk() : KilledRun("walk-short.json") {}
};

TEST_F(KilledRun, GoesOnWithTheSameBitsAfterAtLeastFiftyKills) {
  ASSERT_EQ(0, endOf(start(database("undisturbed"), "1")));
  const std::string expected = results(database("undisturbed"));

  killAndCompare(expected, 50);
}

TEST_F(KilledRun, GoesOnWithTheSameBitsAlsoInTheMidstOfLearningInReality) {
  learnInReality();
  ASSERT_EQ(0, endOf(start(database("undisturbed"), "1")));
  killAndCompare(results(database("undisturbed")), 25);
  const Database db = Database::open(database("undisturbed"), Database::Mode::readOnly);
  EXPECT_EQ(4u, db.realityIterations(1).size()) << "two iterations in the first two of three stages";
  const auto tasks = db.measurementTasks(1);
  EXPECT_TRUE(std::ranges::any_of(tasks, [](const auto& t) { return t.disagreement.has_value(); }));
}

TEST_F(KilledRun, GoesOnWithTheSameBitsWhicheverLearnersStandInTheStages) {
  learnInReality();
  nlohmann::json spec = nlohmann::json::parse(readFile(spec_()));
  spec["learner"] = {{"name", "cma_es"}, {"settings", {{"population", 6}}}};
  spec["adaptation"]["learner"] = {{"name", "pgrl"}, {"settings", {{"policies", 4}}}};
  spec["reality_learning"]["learner"] = {{"name", "ga"}, {"settings", {{"population", 4}}}};
  writeFile(spec_(), spec.dump());
  ASSERT_EQ(0, endOf(start(database("undisturbed"), "1")));
  killAndCompare(results(database("undisturbed")), 12);
}

TEST_F(KilledRun, HasTheSameBitsWithOneAndWithFourWorkers) {
  ASSERT_EQ(0, endOf(start(database("one"), "1")));
  ASSERT_EQ(0, endOf(start(database("four"), "4")));
  EXPECT_EQ(results(database("one")), results(database("four")));
}

TEST_F(KilledWalk, GoesOnWithTheSameBitsOnAnyNumberOfWorkers) {
  ASSERT_EQ(0, endOf(start(database("one"), "1")));
  const std::string expected = results(database("one"));
  EXPECT_NE(std::string::npos, expected.find("falls 0"));  // what the fitness tells besides is stored, too
  // The search begins around the start gait: it is the first individual, as near as 8 bits allow.
  const Database db = Database::open(database("one"), Database::Mode::readOnly);
  const auto genotype = PluginHost(PLUGIN_DIR).controller("walk")->genotype();
  const auto first = db.individuals(1, 1);
  ASSERT_FALSE(first.empty());
  for (std::size_t i = 0; i < genotype.size(); ++i)
    EXPECT_NEAR(genotype[i].byDefault, first[0].parameters[i],
                0.51 / 255 * (genotype[i].maximum - genotype[i].minimum));
  ASSERT_EQ(0, endOf(start(database("four"), "4")));
  EXPECT_EQ(expected, results(database("four")));
  killAndCompare(expected, 10);
}

TEST_F(KilledRun, StopsCleanlyOnInterruptAndGoesOn) {
  ASSERT_EQ(0, endOf(start(database("undisturbed"), "2")));
  const pid_t pid = start(database("interrupted"), "2");
  usleep(300'000);
  kill(pid, SIGINT);
  const int end = endOf(pid);
  // Either it was early enough to be stopped (3), or the run had finished (0).
  EXPECT_TRUE(end == 3 || end == 0) << end;
  ASSERT_EQ(0, endOf(start(database("interrupted"), "2")));
  EXPECT_EQ(results(database("undisturbed")), results(database("interrupted")));
}

}  // namespace
