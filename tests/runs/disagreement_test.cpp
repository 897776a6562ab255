// What to measure next: individuals about which simulators disagree that explain the measurements about equally well.
#include "core/run/loop/disagreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/run/export.h"
#include "core/run/reality/reality_gap.h"
#include "core/spec/error.h"
#include "tests/runs/small_kick_run.h"

namespace {

using namespace btr;
using Vector = std::vector<double>;

const std::vector<Parameter> plane{{"x", "m", "", 0, 10, 5}, {"y", "", "", -1, 1, 0}};

AdaptationCandidate candidate(Vector parameters, double error) { return {"", std::move(parameters), error}; }

TEST(EquallyGood, LeavesOutWhatIsWorseThanTheRatioAndTakesEachVectorOnce) {
  const std::vector<AdaptationCandidate> all{candidate({1, 0}, 0.31), candidate({2, 0}, 0.2), candidate({3, 0}, 0.3),
                                             candidate({2, 0}, 0.2)};
  EXPECT_EQ((std::vector<Vector>{{2, 0}, {3, 0}}), equallyGood(all, plane, 5, 1.5, 0.2));
}

TEST(EquallyGood, IsTheBestOneWhereNoneIsGoodEnough) {
  EXPECT_EQ((std::vector<Vector>{{2, 0}}),
            equallyGood({candidate({1, 0}, 0.5), candidate({2, 0}, 0.4)}, plane, 5, 1.5, 0.2));
  EXPECT_TRUE(equallyGood({}, plane, 5, 1.5, 0.2).empty());
}

TEST(EquallyGood, PrefersThoseFarApartMeasuredInRanges) {
  // From the best at the origin: 0.3, 0.5 and 0.45 ranges away; the third lies near the second.
  const std::vector<AdaptationCandidate> all{candidate({0, 0}, 0.1), candidate({3, 0}, 0.11), candidate({0, 1}, 0.12),
                                             candidate({0, 0.9}, 0.13)};
  EXPECT_EQ((std::vector<Vector>{{0, 0}, {0, 1}, {3, 0}}), equallyGood(all, plane, 3, 2, 0.1));
}

TEST(DrawnAround, StaysWithinItsShareOfTheRangeAndTheBoundsAndIsTheSameForTheSameSeed) {
  Random one(3), two(3);
  const auto drawn = drawnAround(plane, Vector{9.8, 0}, 200, 0.1, one);
  EXPECT_EQ(drawn, drawnAround(plane, Vector{9.8, 0}, 200, 0.1, two));
  ASSERT_EQ(200u, drawn.size());
  std::set<double> different;
  for (const Vector& v : drawn) {
    EXPECT_TRUE(v[0] >= 8.8 && v[0] <= 10 && std::abs(v[1]) <= 0.2) << v[0] << ' ' << v[1];
    different.insert(v[0]);
  }
  EXPECT_EQ(200u, different.size());
}

TEST(Reason, KeepsItsNumbersWhileTheSimulatedFitnessIsHidden) {
  MeasurementTask best, disagreeing, policy;
  best.rank = 3;
  disagreeing.disagreement = 0.21;
  disagreeing.candidates = 6;
  policy.iteration = 2;
  EXPECT_EQ("best, rank 3", reasonOf(best, "m", true));
  EXPECT_EQ("candidate simulators disagree: ± 0.21 m over 6", reasonOf(disagreeing, "m", true));
  EXPECT_EQ("best", reasonOf(best, "m", false));
  EXPECT_EQ("candidate simulators disagree", reasonOf(disagreeing, "m", false));
  EXPECT_EQ("policy of L2", reasonOf(policy, "m", true));
  // A task that was stored before reasons were.
  EXPECT_EQ("best", reasonOf({}, "m", true));
}

/// Ten of a generation (or `population`), of which four are measured: two of the best and two with the largest
/// disagreement.
class Disagreeing : public testing::Test {
 protected:
  static test::SmallKickRun run(int jobs, int disagreeing = 2, double heldOut = 0, int population = 10) {
    return test::SmallKickRun(
        population, 4,
        [&](nlohmann::json& text) {
          text["stages"]["disagreeing_individuals"] = disagreeing;
          text["stages"]["candidate_simulators"] = 3;
          text["adaptation"]["learner"]["settings"]["population"] = 6;
          text["adaptation"]["settings"]["generations"] = 2;
          text["adaptation"]["settings"]["held_out"] = heldOut;
        },
        jobs);
  }
  /// A value for each individual that waits, `more` for those held out.
  static void measure(test::SmallKickRun& r, double more = 0) {
    const int stage = r.database_.run(r.run_).stage + 1;
    for (const MeasurementTask& t : r.database_.measurementTasks(r.run_, stage))
      r.database_.addMeasurement(
          {.run = r.run_, .individual = t.individual, .value = 0.5 + 0.05 * t.position + (t.heldOut ? more : 0)});
  }
  static std::string tasks(const test::SmallKickRun& r) {
    nlohmann::json all;
    for (const MeasurementTask& t : r.database_.measurementTasks(r.run_))
      all.push_back({t.stage, t.individual, t.position, t.heldOut, t.rank, t.disagreement.value_or(-1), t.candidates});
    return all.dump();
  }
};

TEST_F(Disagreeing, AreMeasuredBesideTheBestAndTheirSpreadIsThatOfTheCandidatesTrials) {
  test::SmallKickRun r = run(2);
  ASSERT_EQ(RunEnd::waiting, r.goOn());
  const StopFlag never{false};
  const RunOptions options{.jobs = 1, .progress = {}};
  const RunContext context(r.database_, r.host_, r.run_, never, options);
  const std::vector<SimulatorSpec> candidates = candidateSimulators(context, 1);
  ASSERT_EQ(3u, candidates.size());
  EXPECT_EQ(r.database_.simulators(r.run_)[0].simulator, candidates[0]) << "the newest one is among them";
  for (const SimulatorSpec& simulator : candidates)
    for (const Parameter& p : simulatorParameters())
      EXPECT_LE(std::abs(simulator.values.at(p.name) - candidates[0].values.at(p.name)),
                0.1 * (p.maximum - p.minimum) * (1 + 1e-12))
          << p.name;

  // The spread of everybody, from trials of our own.
  const auto everybody = r.database_.bestIndividuals(r.run_, 99, 1, 1);
  ASSERT_GT(everybody.size(), 4u);
  std::map<Id, double> deviation;
  for (const IndividualRecord& i : everybody) {
    Vector fitness;
    for (const SimulatorSpec& simulator : candidates)
      fitness.push_back(context.prepared.fitnessOf(
          context.prepared.trial(context.prepared.scene(simulator), i.parameters, i.trialSeed, false)));
    const double mean = (fitness[0] + fitness[1] + fitness[2]) / 3;
    double squares = 0;
    for (const double f : fitness) squares += (f - mean) * (f - mean);
    deviation[i.id] = std::sqrt(squares / 2);
  }

  std::set<Id> best, disagreeing;
  double smallest = INFINITY;
  for (const MeasurementTask& t : r.database_.measurementTasks(r.run_, 1)) {
    if (!t.disagreement) {
      EXPECT_EQ(everybody[static_cast<std::size_t>(t.rank) - 1].id, t.individual);
      best.insert(t.individual);
      continue;
    }
    EXPECT_EQ(3, t.candidates);
    EXPECT_NEAR(deviation.at(t.individual), *t.disagreement, 1e-9);
    disagreeing.insert(t.individual);
    smallest = std::min(smallest, *t.disagreement);
  }
  EXPECT_EQ(2u, best.size());
  EXPECT_EQ(2u, disagreeing.size());
  EXPECT_GT(smallest, 0);
  for (const auto& [id, spread] : deviation)
    if (!best.contains(id) && !disagreeing.contains(id)) {
      EXPECT_LE(spread, smallest + 1e-9);
    }
}

TEST_F(Disagreeing, HaveAfterAnAdaptationItsGoodCandidatesToDisagree) {
  // So many that some hit the ball: about those that miss it all simulators agree.
  test::SmallKickRun r = run(2, 2, 0, 30);
  ASSERT_EQ(RunEnd::waiting, r.goOn());
  measure(r);
  ASSERT_EQ(RunEnd::waiting, r.goOn());
  const StopFlag never{false};
  const RunOptions options{.jobs = 1, .progress = {}};
  const RunContext context(r.database_, r.host_, r.run_, never, options);
  const SimulatorRecord newest = r.database_.latestSimulator(r.run_);
  ASSERT_EQ("L3", newest.madeBy);
  const double error = nlohmann::json::parse(newest.evidence).at("error").get<double>();
  const std::vector<SimulatorSpec> candidates = candidateSimulators(context, 2);
  ASSERT_GE(candidates.size(), 2u);
  EXPECT_EQ(newest.simulator, candidates[0]);
  std::vector<AdaptationCandidate> all;
  for (const AdaptationRecord& a : r.database_.adaptations(r.run_, 1))
    all.insert(all.end(), a.candidates.begin(), a.candidates.end());
  for (std::size_t c = 1; c < candidates.size(); ++c) {
    const auto found = std::ranges::find_if(all, [&](const AdaptationCandidate& a) {
      return context.prepared.adaptedTo(newest.simulator, a.parameters) == candidates[c];
    });
    ASSERT_NE(all.end(), found);
    if (candidates.size() > 2) {
      EXPECT_LE(found->error, 1.5 * error);
    }
  }
  int chosen = 0;
  for (const MeasurementTask& t : r.database_.measurementTasks(r.run_, 2)) chosen += t.disagreement.has_value();
  EXPECT_GE(chosen, 1);
}

TEST_F(Disagreeing, AreTheSameForAnyNumberOfWorkers) {
  std::vector<std::string> found;
  for (const int jobs : {1, 4}) {
    test::SmallKickRun r = run(jobs);
    ASSERT_EQ(RunEnd::waiting, r.goOn());
    measure(r);
    ASSERT_EQ(RunEnd::waiting, r.goOn());
    found.push_back(tasks(r));
  }
  EXPECT_EQ(found[0], found[1]);
}

TEST_F(Disagreeing, CanBeAllOrNobody) {
  test::SmallKickRun all = run(2, 4), nobody = run(2, 0);
  ASSERT_EQ(RunEnd::waiting, all.goOn());
  ASSERT_EQ(RunEnd::waiting, nobody.goOn());
  // Whom all candidates agree about is none of them: the best fill up.
  const auto tasks = all.database_.measurementTasks(all.run_);
  EXPECT_EQ(4u, tasks.size());
  EXPECT_TRUE(std::ranges::any_of(tasks, [](const auto& t) { return t.disagreement.has_value(); }));
  for (const MeasurementTask& t : tasks) EXPECT_TRUE(!t.disagreement || *t.disagreement > 0);
  for (const MeasurementTask& t : nobody.database_.measurementTasks(nobody.run_)) EXPECT_FALSE(t.disagreement);
  EXPECT_THROW(run(2, 5), InputError);
}

TEST_F(Disagreeing, TheirReasonIsExportedWithWhatWasMeasured) {
  test::SmallKickRun r = run(2);
  ASSERT_EQ(RunEnd::waiting, r.goOn());
  measure(r);
  const std::string csv = exportCsv(r.database_, r.run_, "measurements", {}, "m");
  EXPECT_NE(std::string::npos, csv.find(",reason,rank,disagreement_m,candidates,"));
  EXPECT_NE(std::string::npos, csv.find("\"best, rank 2\",2,,0,"));
  EXPECT_NE(std::string::npos, csv.find("candidate simulators disagree: ± "));
}

TEST_F(Disagreeing, AHeldOutIndividualsValueChangesNoBitOfTheAdaptation) {
  std::vector<std::string> adaptations;
  std::vector<double> heldOutGaps;
  for (const double more : {0.0, 3.0}) {
    test::SmallKickRun r = run(2, 2, 2);
    ASSERT_EQ(RunEnd::waiting, r.goOn());
    measure(r, more);
    ASSERT_EQ(RunEnd::waiting, r.goOn());
    nlohmann::json all;
    for (const AdaptationRecord& a : r.database_.adaptations(r.run_, 1)) {
      all.push_back({a.number, a.bestError, a.meanError, a.randomState, a.learnerState});
      for (const AdaptationCandidate& c : a.candidates) all.push_back({c.chromosome, c.parameters, c.error});
    }
    const SimulatorRecord made = r.database_.latestSimulator(r.run_);
    all.push_back({toJsonText(made.simulator), made.evidence});
    for (const IndividualRecord& i : r.database_.individuals(r.run_)) all.push_back({i.parameters, i.fitness});
    const GapRecord gap = r.database_.gaps(r.run_).at(0);
    all.push_back({gap.before, gap.after, gap.standardError, gap.individuals});
    EXPECT_EQ(2, gap.individuals);
    EXPECT_EQ(2, gap.heldOutIndividuals);
    adaptations.push_back(all.dump());
    heldOutGaps.push_back(gap.heldOutBefore.value());
  }
  EXPECT_EQ(adaptations[0], adaptations[1]);
  EXPECT_NE(heldOutGaps[0], heldOutGaps[1]) << "the gap on them is another one";
}

}  // namespace
