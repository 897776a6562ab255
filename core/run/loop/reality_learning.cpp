// L2: a learner tries policies in reality, beginning at the best individual of a measurement stage.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "core/run/loop/learner_state.h"
#include "core/run/loop/run_context.h"
#include "core/run/reality/reality_gap.h"

namespace btr {
namespace {

bool isLast(const RunContext& context, int stage) {
  return context.measuredAfter(stage) >= context.stageSetting("total_generations");
}

/// Whether the experiment wants L2 in this stage.
bool isDue(const RunContext& context, int stage) {
  if (context.prepared.spec.realityLearner.name.empty()) return false;
  const int since = stage - static_cast<int>(context.realitySetting("first_stage"));
  const int every = static_cast<int>(context.realitySetting("every_stages"));
  const double most = context.realitySetting("most_stages");
  if (since < 0 || since % every != 0 || (most > 0 && since / every >= most)) return false;
  return !isLast(context, stage) || context.realitySetting("after_last") == 1;
}

bool isMeasured(const RunContext& context) { return context.realitySetting("evaluated_in") == 0; }

/// The individual that L2 begins at, with its real fitness if it has one.
struct Origin {
  std::vector<double> parameters;
  double fitness = -std::numeric_limits<double>::infinity();
};

/// The best measured so far, or the one of this stage that the simulator thinks best; 0 if there is none. Of a stage's
/// policies none counts for itself. Where L3 sees policies, L2 stays away from individuals that L3 must not know.
Id begunAt(const RunContext& context, int stage, const std::vector<RealFitness>& real, bool heldOutToo) {
  const Database& db = context.database;
  Id best = 0;
  double most = 0;
  const auto consider = [&](Id individual, double value, bool heldOut) {
    if ((heldOut && !heldOutToo) || (best != 0 && value <= most)) return;
    best = individual;
    most = value;
  };
  if (context.realitySetting("begins_at") == 1)
    for (const MeasurementTask& t : db.measurementTasks(context.record.id, stage))
      if (t.iteration == 0) consider(t.individual, t.simulatedFitness, t.heldOut);
  if (best == 0)
    for (const RealFitness& r : real)
      if (r.iteration == 0 || r.stage < stage) consider(r.individual, r.mean, r.heldOut);
  return best;
}

Origin originOf(const RunContext& context, int stage) {
  const Database& db = context.database;
  const Id run = context.record.id;
  const std::vector<RealFitness> real = realFitness(db.measurementTasks(run), db.measurements(run), stage);
  Id best = begunAt(context, stage, real, context.adaptationSetting("sees_policies") == 0);
  if (best == 0) best = begunAt(context, stage, real, true);
  const IndividualRecord individual = db.individual(best);
  Origin origin{individual.parameters};
  if (!isMeasured(context)) origin.fitness = individual.fitness;
  for (const RealFitness& r : real)
    if (isMeasured(context) && r.individual == best) origin.fitness = r.mean;
  return origin;
}

/// The best policy of the iterations so far.
struct BestPolicy {
  Id individual = 0;
  int iteration = 0;
  double fitness = -std::numeric_limits<double>::infinity();
};

BestPolicy bestOf(const std::vector<RealityIteration>& iterations) {
  BestPolicy best;
  for (const RealityIteration& i : iterations)
    for (const RealityPolicy& p : i.policies)
      if (p.fitness && *p.fitness > best.fitness) best = {p.individual, i.number, *p.fitness};
  return best;
}

bool isOver(const RunContext& context, int stage, const std::vector<RealityIteration>& iterations) {
  if (context.database.isRealityLearningEnded(context.record.id, stage)) return true;
  const auto done = static_cast<int>(iterations.size());
  const auto patience = static_cast<int>(context.realitySetting("patience"));
  return done >= static_cast<int>(context.realitySetting("iterations")) ||
         (patience > 0 && done - bestOf(iterations).iteration >= patience);
}

/// Simulates the policies in the newest simulator (their traces are what a replay shows) and stores them with their
/// tasks, in a drawn order. False if stopped.
bool begin(RunContext& context, const RealityIteration& begun, const std::vector<Candidate>& candidates) {
  const SimulatorRecord simulator = context.simulator();
  std::vector<TrialJob> jobs;
  for (const Candidate& c : candidates) jobs.push_back({simulator.simulator, c.parameters, context.trialSeed(), true});
  const auto replies = context.evaluate(jobs);
  if (!replies) return false;
  std::vector<IndividualRecord> policies;
  std::vector<std::string> traces;
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const TrialReply& reply = (*replies)[k];
    IndividualRecord& policy = policies.emplace_back();
    policy.simulator = simulator.id;
    policy.chromosome = candidates[k].chromosome;
    policy.parameters = candidates[k].parameters;
    policy.trialSeed = context.trialSeed();
    policy.fitness = reply.fitness;
    policy.outcome = reply.outcome;
    policy.detail = reply.detail;
    policy.traceSha256 = reply.traceSha256;
    traces.push_back(keptTrace(reply.packedTrace));
  }
  std::vector<std::size_t> order(policies.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto purpose = static_cast<std::uint64_t>(begun.stage) << 32 | static_cast<std::uint64_t>(begun.number);
  Random random = Random::forPurpose(context.record.seed, "L2 order", purpose);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  const int repeats = isMeasured(context) ? static_cast<int>(context.realitySetting("repeats")) : 0;
  context.database.beginRealityIteration(begun, policies, traces, order, repeats);
  return true;
}

/// What the learner is told of each policy. One that was not measured as often as wanted counts as not measured: its
/// mean would be compared with means of more values.
std::vector<RealityPolicy> results(const RunContext& context, int stage, int number) {
  const Database& db = context.database;
  const Id run = context.record.id;
  const std::vector<RealFitness> real = isMeasured(context)
                                            ? realFitness(db.measurementTasks(run, stage), db.measurements(run), stage)
                                            : std::vector<RealFitness>();
  const std::vector<MeasurementRecord> values = db.measurements(run);
  std::set<Id> settled;
  for (const MeasurementTask& task : db.measurementTasks(run, stage))
    if (isSettled(task, values)) settled.insert(task.individual);
  std::vector<RealityPolicy> policies;
  for (const IndividualRecord& i : db.realityPolicies(run, stage, number)) {
    RealityPolicy& policy = policies.emplace_back();
    policy.individual = i.id;
    if (!isMeasured(context)) policy.fitness = i.fitness;
    for (const RealFitness& r : real)
      if (r.individual == i.id && settled.contains(i.id)) {
        policy.fitness = r.mean;
        policy.count = r.count;
        policy.standardError = r.standardDeviation / std::sqrt(r.count);
      }
  }
  return policies;
}

}  // namespace

StageEnd learnInReality(RunContext& context, int stage) {
  if (!isDue(context, stage)) return StageEnd::done;
  Database& db = context.database;
  const Id run = context.record.id;
  std::vector<RealityIteration> iterations = db.realityIterations(run, stage);
  const auto begun = db.begunRealityIteration(run, stage);
  if (!begun && isOver(context, stage, iterations)) return StageEnd::done;

  const auto learner = context.host.learner(context.prepared.spec.realityLearner.name);
  Random random = Random::forPurpose(context.record.seed, "L2", static_cast<std::uint64_t>(stage));
  learner->start(context.prepared.genotype, context.prepared.spec.realityLearner.settings, random);
  // An iteration that was begun keeps its policies, whatever has become of the measurements that it came from.
  if (begun || !iterations.empty()) {
    goOnFrom(begun ? *begun : iterations.back(), random, *learner);
  } else {
    learner->beginAt(originOf(context, stage).parameters, {1, context.realitySetting("flip")}, random);
  }

  for (bool open = begun.has_value(); open || !isOver(context, stage, iterations); open = false) {
    const int number = static_cast<int>(iterations.size()) + 1;
    context.progress.stage = "L2";
    context.progress.message.clear();
    context.progress.stageDone = number - 1;
    context.progress.stageTotal = static_cast<int>(context.realitySetting("iterations"));
    context.publish(true);
    RealityIteration iteration;
    iteration.run = run;
    iteration.stage = stage;
    iteration.number = number;
    iteration.centreBefore = learner->centre();
    if (!begun || begun->number != number) {
      db.setRunState(run, RunState::learning, "");
      const std::vector<Candidate> candidates = learner->ask(random);
      keepState(iteration, random, *learner);
      if (!begin(context, iteration, candidates)) return StageEnd::stopped;
    }
    const bool isComplete = !isMeasured(context) || completeMeasuring(context, stage, number);
    if (!isComplete && context.stopped()) return StageEnd::stopped;
    if (!isComplete && !db.isRealityLearningEnded(run, stage)) return StageEnd::waiting;

    // Of an iteration that a person ended before all was measured, what was measured stays; no step is taken.
    iteration.policies = results(context, stage, number);
    std::vector<double> fitness;
    for (const RealityPolicy& p : iteration.policies)
      fitness.push_back(p.fitness.value_or(std::numeric_limits<double>::quiet_NaN()));
    if (isComplete)
      learner->tell(fitness);
    else
      context.progress.message.clear();
    iteration.centreAfter = learner->centre();
    keepState(iteration, random, *learner);
    iteration.finishedAt = utcNow();
    db.addRealityIteration(iteration);
    iterations.push_back(std::move(iteration));
  }
  context.progress.stageDone = static_cast<int>(iterations.size());
  context.publish(true);
  return StageEnd::done;
}

std::optional<std::vector<double>> givenBack(const RunContext& context, int stage) {
  if (!isDue(context, stage) || context.realitySetting("copies") == 0) return std::nullopt;
  const std::vector<RealityIteration> iterations = context.database.realityIterations(context.record.id, stage);
  if (iterations.empty()) return std::nullopt;
  if (context.realitySetting("gives_back") == 1 && !iterations.back().centreAfter.empty())
    return iterations.back().centreAfter;
  // Where no policy was better than the individual it began at, that one goes back.
  const Origin origin = originOf(context, stage);
  const BestPolicy best = bestOf(iterations);
  if (best.individual == 0 || best.fitness <= origin.fitness) return origin.parameters;
  return context.database.individual(best.individual).parameters;
}

}  // namespace btr
