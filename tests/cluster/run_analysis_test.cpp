// The gap analysis inside a run, made by all ranks together.
#include <gtest/gtest.h>
#include <signal.h>

#include <nlohmann/json.hpp>

#include "core/cluster/build_identity.h"
#include "core/cluster/coordinator.h"
#include "core/run/reality/recorded_analysis.h"
#include "core/run/reality/recorded_robot.h"
#include "core/run/setup/evaluator.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"
#include "core/spec/random.h"
#include "core/spec/system/cancelled.h"
#include "tests/cluster/descendants.h"
#include "tests/cluster/foremen.h"
#include "tests/cluster/joined_ranks.h"
#include "tests/cluster/played_rank.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr::run_analysis_test {
namespace {

using test::descendants;
using test::withForemen;

/// A hung dog whose knee has friction that the simulator lacks, kicks and is recorded.
class KneeWithFriction {
 public:
  KneeWithFriction() : host_(PLUGIN_DIR) {
    const std::string place = SOURCE_DIR "/resources/experiments";
    auto text = nlohmann::json::parse(readFile(place + "/kick-short.json"));
    text["controller"]["settings"] = {{"accumulate_s", 0.1}, {"hold_s", 0.0}, {"return_s", 0.1}};
    text["recordings"] = {{"settings", {{"after_stage", 1}, {"maximum_effects", 1}}},
                          {"effects", {"viscous_friction", "coulomb_friction"}},
                          {"joints", {"ers7.LF_J3"}}};
    prepared_ = prepareFromFiles(experimentFromJson(text.dump(), "kick", place), host_);

    analysis_.simulator = firstSimulator(prepared_).simulator;
    analysis_.pose = RobotPose::hungUp;
    analysis_.seed = 7;
    SimulatorSpec robot = analysis_.simulator;
    robot.effects.push_back({"coulomb_friction", "ers7.LF_J3", {{"torque_nm", 0.15}}});
    Random random(3);
    for (const Parameter& p : prepared_.genotype)
      kick_.push_back(p.minimum + (p.maximum - p.minimum) * random.uniform());
    const std::string csv = folder_.file("kick.csv");
    const Scene scene = recordedScene(prepared_, robot, analysis_.pose);
    writeRecording(prepared_.trial(scene, kick_, 1, true).trace, csv, analysis_.pose, random);
    analysis_.recordings.push_back({"kick.csv", readFile(csv), ""});
  }

  const PluginHost& host() const { return host_; }
  const PreparedExperiment& prepared() const { return prepared_; }
  const RecordedAnalysis& analysis() const { return analysis_; }

  /// Simulator and evidence, as text.
  static std::string textOf(const RecordedFinding& finding) {
    return toJsonText(finding.simulator) + '\n' + finding.evidence;
  }
  std::string ofOneProcess() const {
    return textOf(analyseRecorded(prepared_, host_, analysis_, problemOf(prepared_, analysis_), 1, {}));
  }
  std::string of(Coordinator& coordinator, const AnalysisProgress& progress = {}) const {
    return textOf(coordinator.analyse(prepared_, analysis_, progress, [] { return true; }));
  }
  /// What a trial comes to.
  std::string shaWith(Workforce* workforce) const {
    Evaluator evaluator(prepared_, 1, workforce);
    const auto replies =
        evaluator.evaluate({{.simulator = analysis_.simulator, .parameters = kick_, .seed = 11}}, test::goOn);
    return replies ? replies->front().traceSha256 + replies->front().detail : "stopped";
  }

 private:
  PluginHost host_;
  TemporaryFolder folder_;
  PreparedExperiment prepared_;
  RecordedAnalysis analysis_;
  std::vector<double> kick_;
};

long jobsOf(const std::vector<PlaceReport>& places) {
  long jobs = 0;
  for (const PlaceReport& place : places) jobs += place.jobs;
  return jobs;
}

TEST(RunAnalysis, FindsWhatOneProcessFindsWhoeverWorks) {
  const KneeWithFriction knee;
  const std::string alone = knee.ofOneProcess(), trial = knee.shaWith(nullptr);
  EXPECT_NE(alone.find("coulomb_friction"), std::string::npos) << alone;
  for (const auto& [ranks, foremen] :
       {std::pair{1, 1}, std::pair{1, 2}, std::pair{2, 1}, std::pair{3, 1}, std::pair{2, 2}}) {
    const std::string name = std::to_string(ranks) + " ranks of " + std::to_string(foremen);
    test::JoinedRanks all(ranks, withForemen(foremen));
    Coordinator coordinator(all.first(), knee.host(), withForemen(foremen));
    // Trials before it and after it: the ranks are lent and come back.
    EXPECT_EQ(trial, knee.shaWith(&coordinator)) << name;
    EXPECT_EQ(alone, knee.of(coordinator)) << name;
    EXPECT_EQ(trial, knee.shaWith(&coordinator)) << name;
    const std::vector<PlaceReport> places = coordinator.analysisReport();
    EXPECT_EQ(static_cast<std::size_t>(ranks), places.size()) << name;
    for (const PlaceReport& place : places) EXPECT_EQ(foremen, place.workers) << name;
    EXPECT_EQ(ranks * foremen > 1, jobsOf(places) > 0) << name;
    EXPECT_EQ(2, jobsOf(coordinator.report())) << name;
    EXPECT_TRUE(coordinator.notes().empty()) << name;
  }
}

// The first rank evaluates nothing where there are many: then another leads.
TEST(RunAnalysis, DoesWithoutAForemanOfTheFirstRank) {
  const KneeWithFriction knee;
  test::JoinedRanks all(3, withForemen(1));
  Coordinator coordinator(all.first(), knee.host(), withForemen(0));
  EXPECT_EQ(knee.ofOneProcess(), knee.of(coordinator));
  EXPECT_EQ(2u, coordinator.analysisReport().size());
}

// Whoever is killed: who leads, another, one that only waits, a worker. The third loss of a job would rightly be
// refused.
TEST(RunAnalysis, FindsTheSameWhenItsProcessesAreKilled) {
  const KneeWithFriction knee;
  const std::string alone = knee.ofOneProcess(), trial = knee.shaWith(nullptr);
  test::JoinedRanks all(2, withForemen(2));
  Coordinator coordinator(all.first(), knee.host(), withForemen(2));
  Random random(4);
  int killedOfAll = 0;
  for (int round = 0; round < 4; ++round) {
    int killed = 0;
    double next = random.uniform();
    const auto progress = [&](const std::string&, double share) {
      const std::vector<pid_t> processes = descendants();
      if (processes.empty() || killed == 2 || share < next) return true;
      kill(processes[static_cast<std::size_t>(random.uniform() * static_cast<double>(processes.size()))], SIGKILL);
      next = random.uniform();
      ++killed;
      return true;
    };
    EXPECT_EQ(alone, knee.of(coordinator, progress)) << round;
    EXPECT_EQ(trial, knee.shaWith(&coordinator)) << round;
    killedOfAll += killed;
  }
  EXPECT_GE(killedOfAll, 4);
}

// It is started anew where it holds a piece or leads, else not waited for; the trials that follow begin it anew.
TEST(RunAnalysis, FindsTheSameWhenAForemanHangs) {
  const KneeWithFriction knee;
  const std::string alone = knee.ofOneProcess(), trial = knee.shaWith(nullptr);
  CoordinatorOptions options = withForemen(1);
  options.secondsPerPart = 0;
  options.secondsPerJob = 1;
  options.grace_s = 2;
  options.patience_s = 10;
  for (const std::size_t foreman : {0u, 1u}) {
    test::JoinedRanks all(2, options);
    Coordinator coordinator(all.first(), knee.host(), options);
    bool isStopped = false;
    const auto progress = [&](const std::string&, double) {
      if (!isStopped) kill(descendants().at(foreman), SIGSTOP);  // foremen are older than their workers
      isStopped = true;
      return true;
    };
    EXPECT_EQ(alone, knee.of(coordinator, progress)) << foreman;
    EXPECT_EQ(trial, knee.shaWith(&coordinator)) << foreman;
  }
}

TEST(RunAnalysis, EndsEarlyAndTheRanksGoOnWithOtherWork) {
  const KneeWithFriction knee;
  test::JoinedRanks all(2, withForemen(1));
  Coordinator coordinator(all.first(), knee.host(), withForemen(1));
  EXPECT_THROW(knee.of(coordinator, [](const std::string&, double share) { return share < 0.3; }), Cancelled);
  EXPECT_EQ(knee.shaWith(nullptr), knee.shaWith(&coordinator));
  EXPECT_EQ(knee.ofOneProcess(), knee.of(coordinator));
}

TEST(RunAnalysis, RefusesWhatOneProcessRefusesInTheSameWords) {
  const KneeWithFriction knee;
  RecordedAnalysis few = knee.analysis();
  few.recordings.front().csv.resize(few.recordings.front().csv.find('\n') + 1);
  const std::string alone = test::refusal(
      [&] { analyseRecorded(knee.prepared(), knee.host(), few, problemOf(knee.prepared(), few), 1, {}); });
  Coordinator coordinator(nullptr, knee.host(), withForemen(1));
  const std::string shared = test::refusal([&] { coordinator.analyse(knee.prepared(), few, {}, [] { return true; }); });
  // Each process unpacks the recording into a folder of its own.
  const auto withoutFolder = [](const std::string& text) { return text.substr(text.find("kick.csv")); };
  EXPECT_NE("accepted", alone);
  EXPECT_EQ(withoutFolder(alone), withoutFolder(shared));
}

TEST(RunAnalysis, RefusesARankWithAnotherBuildByNameAndHost) {
  const KneeWithFriction knee;
  Parts hello{"0", "hello"}, ready{"0", "ready", "1", "1", pack({"file kick.csv 0"})};
  for (const std::string& entry : buildIdentity(knee.host())) {
    hello.push_back(entry);
    ready.push_back(entry);
    if (entry.starts_with("plugin fitness/")) ready.back().back() = entry.back() == '0' ? '1' : '0';
  }
  Coordinator coordinator(
      std::make_unique<test::PlayedRank>(std::deque<Parts>{{"crew", "lab7", "1", ""}, hello, ready}), knee.host(),
      withForemen(0));
  const std::string refusal = test::refusal([&] { knee.of(coordinator); });
  EXPECT_TRUE(refusal.starts_with("rank 1 (host lab7): its plugin fitness/")) << refusal;
  EXPECT_TRUE(refusal.ends_with("is another one; install the same build on every machine")) << refusal;
}

}  // namespace
}  // namespace btr::run_analysis_test
