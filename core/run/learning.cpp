// L1: a learner evolves controllers in the newest simulator.
#include <algorithm>
#include <chrono>
#include <map>
#include <numeric>

#include "core/run/run_context.h"

namespace btr {
namespace {

/// What is known of a parameter vector in the current simulator. `slot` of this generation if it has no id yet.
struct Known {
  double fitness;
  std::string outcome, detail, traceSha256;
  Id id;
};
using Memory = std::map<std::vector<double>, Known>;

Memory remember(const RunContext& context, Id simulator) {
  Memory memory;
  for (const IndividualRecord& i : context.database.individualsOfSimulator(context.record.id, simulator))
    memory.try_emplace(i.parameters, Known{i.fitness, i.outcome, i.detail, i.traceSha256, i.id});
  return memory;
}

/// Evaluates candidates, each parameter vector once, and fills the generation. False if stopped.
bool fill(RunContext& context, GenerationRecord& generation, const std::vector<Candidate>& candidates,
          const SimulatorSpec& simulator, Memory& memory) {
  // Simulate what nobody has simulated in this simulator before, each vector once.
  std::vector<TrialJob> jobs;
  std::map<std::vector<double>, std::size_t> jobOf, firstSlot;
  for (const Candidate& candidate : candidates)
    if (!memory.contains(candidate.parameters) && jobOf.try_emplace(candidate.parameters, jobs.size()).second)
      jobs.push_back({simulator, candidate.parameters, context.trialSeed(), false});
  const auto replies = context.evaluate(jobs);
  if (!replies) return false;

  for (std::size_t slot = 0; slot < candidates.size(); ++slot) {
    const Candidate& candidate = candidates[slot];
    IndividualRecord individual;
    individual.run = context.record.id;
    individual.generation = generation.number;
    individual.slot = static_cast<int>(slot);
    individual.simulator = generation.simulator;
    individual.chromosome = candidate.chromosome;
    individual.parameters = candidate.parameters;
    individual.trialSeed = context.trialSeed();
    if (const auto known = memory.find(candidate.parameters); known != memory.end()) {
      individual.fitness = known->second.fitness;
      individual.outcome = known->second.outcome;
      individual.detail = known->second.detail;
      individual.traceSha256 = known->second.traceSha256;
      individual.sameAs = known->second.id;
      ++generation.reused;
    } else {
      const TrialReply& reply = (*replies)[jobOf.at(candidate.parameters)];
      individual.fitness = reply.fitness;
      individual.outcome = reply.outcome;
      individual.detail = reply.detail;
      individual.traceSha256 = reply.traceSha256;
      const auto [first, isFirst] = firstSlot.try_emplace(candidate.parameters, slot);
      if (isFirst) {
        ++generation.trials;
      } else {
        individual.sameAs = sameAsSlot(static_cast<int>(first->second));
        ++generation.reused;
      }
    }
    if (individual.outcome != toText(TrialResult::Outcome::finished)) ++generation.failed;
    generation.individuals.push_back(std::move(individual));
  }
  return true;
}

/// Where L2 has given something back since generation `number`, the search begins afresh around it.
void beginFromReality(const RunContext& context, Learner& learner, int number) {
  const int stage = context.database.run(context.record.id).stage;
  if (stage == 0 || number != context.measuredAfter(stage)) return;
  const auto best = givenBack(context, stage);
  if (!best) return;
  Random random = Random::forPurpose(context.record.seed, "permutations", static_cast<std::uint64_t>(stage));
  learner.start(context.prepared.genotype, context.prepared.spec.learner.settings, random);
  learner.beginAt(*best, {context.realitySetting("copies"), context.realitySetting("flip")}, random);
}

}  // namespace

bool learnUntil(RunContext& context, int lastGeneration) {
  Database& db = context.database;
  const Id run = context.record.id;
  const auto learner = context.host.learner(context.prepared.spec.learner.name);
  Random random = Random::forPurpose(context.record.seed, "L1");
  learner->start(context.prepared.genotype, context.prepared.spec.learner.settings, random);
  if (const auto& start = context.prepared.spec.start)
    learner->beginAt(context.prepared.start, {start->share, start->flip}, random);

  int number = 0;
  if (const auto last = db.lastGeneration(run)) {
    random.setState(last->randomState);
    learner->setState(last->learnerState);
    number = last->number;
  }
  if (number >= lastGeneration) return true;
  beginFromReality(context, *learner, number);

  const SimulatorRecord simulator = context.simulator();
  Memory memory = remember(context, simulator.id);
  const int firstOfStage = number;
  const int stageStart = simulator.madeAfterGeneration;
  db.setRunState(run, RunState::learning, "");
  const auto begun = std::chrono::steady_clock::now();
  context.progress.stage = "L1";
  context.progress.message.clear();
  context.progress.generation = number;
  context.progress.stageDone = number - stageStart;
  context.progress.stageTotal = lastGeneration - stageStart;

  while (number < lastGeneration) {
    const auto generationBegun = std::chrono::steady_clock::now();
    GenerationRecord generation;
    generation.run = run;
    generation.number = number + 1;
    generation.simulator = simulator.id;
    if (!fill(context, generation, learner->ask(random), simulator.simulator, memory)) return false;

    std::vector<double> fitness;
    for (const IndividualRecord& individual : generation.individuals) fitness.push_back(individual.fitness);
    learner->tell(fitness);
    generation.best = *std::max_element(fitness.begin(), fitness.end());
    generation.worst = *std::min_element(fitness.begin(), fitness.end());
    generation.mean = std::accumulate(fitness.begin(), fitness.end(), 0.0) / static_cast<double>(fitness.size());
    generation.randomState = random.state();
    generation.learnerState = learner->state();
    generation.finishedAt = utcNow();
    const auto now = std::chrono::steady_clock::now();
    generation.seconds = std::chrono::duration<double>(now - generationBegun).count();
    db.addGeneration(generation);
    for (const IndividualRecord& i : generation.individuals)
      if (i.sameAs == 0) memory.try_emplace(i.parameters, Known{i.fitness, i.outcome, i.detail, i.traceSha256, i.id});
    ++number;

    context.progress.generation = number;
    context.progress.stageDone = number - stageStart;
    context.progress.best = generation.best;
    context.progress.mean = generation.mean;
    const double each = std::chrono::duration<double>(now - begun).count() / (number - firstOfStage);
    context.progress.secondsLeft = each * (context.progress.totalGenerations - number);
    context.publish(false);
  }
  context.publish(true);
  return true;
}

}  // namespace btr
