#include "core/cluster/coordinator.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <deque>
#include <thread>

#include "core/cluster/build_identity.h"
#include "core/run/setup/evaluator.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/parameter.h"
#include "tests/cluster/descendants.h"
#include "tests/cluster/foremen.h"
#include "tests/cluster/played_rank.h"
#include "tests/refusal.h"

namespace {

using namespace btr;
using test::descendants;
using test::goOn;
using test::withForemen;

/// Kicks of a short experiment, drawn at random.
class Kicks {
 public:
  explicit Kicks(int count)
      : host_(PLUGIN_DIR),
        prepared_(prepareFromFiles(loadExperiment(SOURCE_DIR "/resources/experiments/kick-short.json"), host_)) {
    Random random(5);
    for (int i = 0; i < count; ++i) {
      TrialJob job;
      job.simulator = firstSimulator(prepared_).simulator;
      for (const Parameter& p : prepared_.genotype)
        job.parameters.push_back(p.minimum + (p.maximum - p.minimum) * random.uniform());
      job.seed = 11;
      jobs_.push_back(job);
    }
  }
  std::vector<std::string> shasWith(Workforce* workforce) const {
    Evaluator evaluator(prepared_, 1, workforce);
    const auto replies = evaluator.evaluate(jobs_, goOn);
    std::vector<std::string> shas;
    if (replies)
      for (const TrialReply& reply : *replies) shas.push_back(reply.traceSha256 + reply.detail);
    return shas;
  }
  const PluginHost& host() const { return host_; }
  const PreparedExperiment& prepared() const { return prepared_; }
  const std::vector<TrialJob>& jobs() const { return jobs_; }

 private:
  PluginHost host_;
  PreparedExperiment prepared_;
  std::vector<TrialJob> jobs_;
};

TEST(Coordinator, GivesTheBitsOfOneProcessWhateverTheNumberOfForemen) {
  const Kicks kicks(12);
  const std::vector<std::string> alone = kicks.shasWith(nullptr);
  for (const int foremen : {1, 3}) {
    Coordinator coordinator(nullptr, kicks.host(), withForemen(foremen));
    EXPECT_EQ(alone, kicks.shasWith(&coordinator));
    EXPECT_EQ(alone, kicks.shasWith(&coordinator));
    long jobs = 0;
    for (const PlaceReport& place : coordinator.report()) jobs += place.jobs;
    EXPECT_EQ(24, jobs);
  }
}

// Whoever is killed, foreman or worker. A job that is lost three times would rightly be refused: two a time.
TEST(Coordinator, GivesTheSameBitsWhenItsProcessesAreKilled) {
  const Kicks kicks(12);
  const std::vector<std::string> alone = kicks.shasWith(nullptr);
  Coordinator coordinator(nullptr, kicks.host(), withForemen(2));
  Evaluator evaluator(kicks.prepared(), 1, &coordinator);
  Random random(9);
  for (int round = 0; round < 10; ++round) {
    int killed = 0;
    const auto replies = evaluator.evaluate(kicks.jobs(), goOn, [&](std::size_t) {
      const std::vector<pid_t> all = descendants();
      if (all.empty() || killed == 2) return;
      kill(all[static_cast<std::size_t>(random.uniform() * static_cast<double>(all.size()))], SIGKILL);
      ++killed;
    });
    ASSERT_TRUE(replies);
    std::vector<std::string> shas;
    for (const TrialReply& reply : *replies) shas.push_back(reply.traceSha256 + reply.detail);
    EXPECT_EQ(alone, shas);
    EXPECT_EQ(2, killed);
  }
}

TEST(Coordinator, StartsAForemanAnewThatHangs) {
  const Kicks kicks(12);
  const std::vector<std::string> alone = kicks.shasWith(nullptr);
  CoordinatorOptions options = withForemen(1);
  options.secondsPerJob = options.grace_s = 1;
  Coordinator coordinator(nullptr, kicks.host(), options);
  Evaluator evaluator(kicks.prepared(), 1, &coordinator);
  bool isStopped = false;
  const auto replies = evaluator.evaluate(kicks.jobs(), goOn, [&](std::size_t) {
    for (const pid_t process : isStopped ? std::vector<pid_t>{} : descendants()) kill(process, SIGSTOP);
    isStopped = true;
  });
  ASSERT_TRUE(replies);
  std::vector<std::string> shas;
  for (const TrialReply& reply : *replies) shas.push_back(reply.traceSha256 + reply.detail);
  EXPECT_EQ(alone, shas);
  EXPECT_EQ(1, coordinator.report().front().losses);
}

TEST(Coordinator, LeavesNoProcessBehind) {
  const Kicks kicks(2);
  {
    Coordinator coordinator(nullptr, kicks.host(), withForemen(2));
    kicks.shasWith(&coordinator);
    EXPECT_FALSE(descendants().empty());
  }
  for (int i = 0; i < 10000 && !descendants().empty(); ++i) std::this_thread::yield();
  EXPECT_TRUE(descendants().empty());
}

TEST(Coordinator, StopsAndGoesOnWithOtherWork) {
  const Kicks kicks(8);
  Coordinator coordinator(nullptr, kicks.host(), withForemen(2));
  std::atomic<bool> stop{false};
  Evaluator evaluator(kicks.prepared(), 1, &coordinator);
  EXPECT_FALSE(evaluator.evaluate(kicks.jobs(), stop, [&](std::size_t) { stop = true; }));
  EXPECT_EQ(kicks.shasWith(nullptr), kicks.shasWith(&coordinator));
}

TEST(Coordinator, SaysWhyItsForemenDoNotBegin) {
  const Kicks kicks(1);
  CoordinatorOptions options = withForemen(1);
  options.command = {"/bin/false"};
  Coordinator coordinator(nullptr, kicks.host(), options);
  EXPECT_EQ("rank 0 (host " + hostName() +
                "): no place is left that works (its process ended (exit code 1)); what was stored is kept: the same "
                "command goes on",
            test::refusal([&] { kicks.shasWith(&coordinator); }));
}

TEST(Coordinator, RefusesARankWithAnotherBuildByNameAndHost) {
  const Kicks kicks(1);
  Parts other{"0", "hello"};
  for (std::string entry : buildIdentity(kicks.host())) {
    if (entry.starts_with("library libbtr_core.so")) entry.back() = entry.back() == '0' ? '1' : '0';
    other.push_back(entry);
  }
  CoordinatorOptions options = withForemen(0);
  Coordinator coordinator(std::make_unique<test::PlayedRank>(std::deque<Parts>{{"crew", "lab7", "1", ""}, other}),
                          kicks.host(), options);
  EXPECT_EQ("rank 1 (host lab7): its library libbtr_core.so is another one; install the same build on every machine",
            test::refusal([&] { kicks.shasWith(&coordinator); }));
}

TEST(Coordinator, RefusesARankThatWasAskedForSomethingElse) {
  const Kicks kicks(1);
  CoordinatorOptions options = withForemen(0);
  options.words = "run a.json";
  Coordinator coordinator(std::make_unique<test::PlayedRank>(std::deque<Parts>{{"crew", "lab7", "1", "run b.json"}}),
                          kicks.host(), options);
  EXPECT_EQ(
      "rank 1 (host lab7): it was started with other words than rank 0; for a run of its own on each rank set "
      "UCHILSIM_ALONE=1",
      test::refusal([&] { kicks.shasWith(&coordinator); }));
}

TEST(Coordinator, NamesARankThatNeverBegins) {
  const Kicks kicks(1);
  CoordinatorOptions options = withForemen(0);
  options.patience_s = 0;
  Coordinator coordinator(std::make_unique<test::PlayedRank>(std::deque<Parts>{}), kicks.host(), options);
  EXPECT_EQ("rank 1 did not begin in time", test::refusal([&] { kicks.shasWith(&coordinator); }));
}

}  // namespace
