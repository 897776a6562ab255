// L1: a learner evolves controllers in the newest simulator.
#include <chrono>

#include "core/run/loop/run_context.h"
#include "core/run/loop/search.h"

namespace btr {
namespace {

/// Where L2 has given something back since generation `number`, the search begins afresh around it.
void beginFromReality(const RunContext& context, Search& search) {
  const int stage = context.database.run(context.record.id).stage;
  if (stage == 0 || search.generation() != context.measuredAfter(stage)) return;
  const auto best = givenBack(context, stage);
  if (!best) return;
  Random random = Random::forPurpose(context.record.seed, "permutations", static_cast<std::uint64_t>(stage));
  search.beginAgain(*best, {context.realitySetting("copies"), context.realitySetting("flip")}, random);
}

}  // namespace

bool learnUntil(RunContext& context, int lastGeneration) {
  Database& db = context.database;
  const Id run = context.record.id;
  const SimulatorRecord simulator = context.simulator();
  Search search(db, context.host, context.prepared, context.record, simulator);
  if (search.generation() >= lastGeneration) return true;
  beginFromReality(context, search);

  const int firstOfStage = search.generation();
  const int stageStart = simulator.madeAfterGeneration;
  db.setRunState(run, RunState::learning, "");
  context.progress.stage = "L1";
  context.progress.message.clear();
  context.progress.generation = firstOfStage;
  context.progress.stageDone = firstOfStage - stageStart;
  context.progress.stageTotal = lastGeneration - stageStart;

  while (search.generation() < lastGeneration) {
    const auto generationBegun = std::chrono::steady_clock::now();
    const auto replies = context.evaluate(search.ask());
    if (!replies) return false;
    GenerationRecord generation = search.fill(*replies);
    std::vector<double> fitness;
    for (const IndividualRecord& individual : generation.individuals) fitness.push_back(individual.fitness);
    search.tell(generation, fitness);
    const auto now = std::chrono::steady_clock::now();
    generation.seconds = std::chrono::duration<double>(now - generationBegun).count();
    db.addGeneration(generation);
    search.remember(generation);

    context.progress.generation = generation.number;
    context.progress.stageDone = generation.number - stageStart;
    context.progress.best = generation.best;
    context.progress.mean = generation.mean;
    context.planned.learnersPopulation = static_cast<int>(replies->size());
    context.estimateTimeLeft(generation.number, db.run(run).stage + 1, 0);
    context.publish(false);
  }
  context.publish(true);
  return true;
}

}  // namespace btr
