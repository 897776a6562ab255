// What a job of the analysis could not do is a result or ends the analysis, with one job and with several.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/refused_jobs.h"
#include "core/sim/effect.h"
#include "core/spec/error.h"
#include "tests/gap/recorded_hinge.h"
#include "tests/refusal.h"

namespace btr {
namespace {

using testing::HasSubstr;

enum class Failing { refused, memory, fault };

void fail(Failing how) {
  if (how == Failing::refused) throw InputError("mass_kg", "-1", "above 0");
  if (how == Failing::memory) throw std::bad_alloc();
  throw std::out_of_range("index 7 of 3");
}

/// The sentence of a JobFault, "" if there is none.
std::string faultOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const JobFault& fault) {
    return fault.what();
  }
  return "";
}

std::vector<JobResult> run(int jobs, Failing how) {
  return parallel(jobs, 4, [how](std::size_t i) {
    if (i == 2) fail(how);
    return std::vector<double>{static_cast<double>(i)};
  });
}

TEST(JobFailures, ARefusedInputIsAResultAndTheOtherJobsHaveTheirs) {
  for (const int jobs : {1, 3}) {
    const std::vector<JobResult> results = run(jobs, Failing::refused);
    ASSERT_EQ(results.size(), 4u);
    for (const std::size_t i : {0, 1, 3}) {
      ASSERT_TRUE(results[i].ok());
      EXPECT_THAT(results[i].numbers, testing::ElementsAre(static_cast<double>(i)));
    }
    EXPECT_EQ(results[2].refused, "mass_kg: -1 is not allowed; above 0");
  }
}

TEST(JobFailures, MemoryThatRunsOutAndFaultsOfTheProgramEndTheWork) {
  const std::string memory = faultOf([] { run(1, Failing::memory); }), fault = faultOf([] { run(1, Failing::fault); });
  EXPECT_THAT(memory, HasSubstr("ran out of memory"));
  EXPECT_THAT(fault, HasSubstr("index 7 of 3"));
  EXPECT_EQ(faultOf([] { run(3, Failing::memory); }), memory);
  EXPECT_EQ(faultOf([] { run(3, Failing::fault); }), fault);
}

TEST(JobFailures, AWorkerThatIsKilledEndsTheWork) {
  const auto work = [] {
    parallel(2, 3, [](std::size_t i) {
      if (i == 1) std::raise(SIGKILL);
      return std::vector<double>{0};
    });
  };
  EXPECT_THAT(faultOf(work), HasSubstr("a worker process of the analysis was lost"));
}

TEST(JobFailures, WhatTheSceneRefusesIsCountedByWhatAndWhy) {
  RefusedJobs refused;
  EXPECT_THAT(refused.notes(), testing::IsEmpty());
  for (int i = 0; i < 3; ++i) refused.add("fit", "no such mass");
  refused.add("score", "no such mass");
  EXPECT_EQ(refused.notes().size(), 2u);
  EXPECT_THAT(refused.notes()[0], HasSubstr("3 fits were left out"));
  EXPECT_THAT(refused.notes()[1], HasSubstr("1 score was left out"));
}

/// An effect that cannot be simulated at any size but none.
class Broken final : public Effect {
 public:
  explicit Broken(Failing how) : how_(how) {}
  std::vector<Parameter> parameters() const override {
    return {{"size", "N·m", "breaks whatever has it", 0, 1, 0.1, 0.0}};
  }
  Place place() const override { return Place::joint; }
  void changeScene(Scene&, const std::string&, std::span<const double> values) const override {
    if (values[0] != 0) fail(how_);
  }

 private:
  Failing how_;
};

EffectLibrary withBroken(Failing how) {
  EffectLibrary library = btr::library();
  const EffectFactory others = library.make;
  library.make = [others, how](const std::string& name) -> std::shared_ptr<const Effect> {
    if (name == "broken") return std::make_shared<Broken>(how);
    return others(name);
  };
  library.names.push_back("broken");
  return library;
}

GapReport analysed(Failing how, int jobs) {
  AnalysisOptions options;
  options.jobs = jobs;
  options.effects = {"coulomb_friction", "broken"};
  return analyse(recordedFrom({{}, {{"coulomb_friction", "rig.hinge", {{"torque_nm", 0.05}}}}}), withBroken(how),
                 options);
}

TEST(JobFailures, AnEffectThatTheSceneRefusesIsNamedAsSuchAndTheOthersAreJudged) {
  for (const int jobs : {1, 3}) {
    const GapReport report = analysed(Failing::refused, jobs);
    EXPECT_EQ(report.verdict, GapReport::Verdict::missingPhysics) << report.sentence;
    std::string reason;
    for (const GapReport::Effect& effect : report.tried)
      if (effect.effect == "broken") reason = effect.reason;
    EXPECT_THAT(reason, HasSubstr("the scene refuses it"));
  }
}

TEST(JobFailures, NoVerdictRestsOnAFaultOfTheProgram) {
  for (const Failing how : {Failing::memory, Failing::fault}) {
    const std::string one = faultOf([&] { analysed(how, 1); });
    EXPECT_NE(one, "");
    EXPECT_EQ(faultOf([&] { analysed(how, 3); }), one);
  }
}

}  // namespace
}  // namespace btr
