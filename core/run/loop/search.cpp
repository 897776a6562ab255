#include "core/run/loop/search.h"
#include "core/run/loop/learner_state.h"

#include <algorithm>
#include <numeric>

namespace btr {

std::uint64_t trialSeedOf(const RunRecord& run) { return Random::forPurpose(run.seed, "trial").next() >> 1; }

Search::Search(const Database& database, const PluginHost& host, const PreparedExperiment& prepared,
               const RunRecord& run, const SimulatorRecord& simulator)
    : prepared_(prepared),
      run_(run.id),
      simulator_(simulator),
      trialSeed_(trialSeedOf(run)),
      learner_(host.learner(prepared.spec.learner.name)),
      random_(Random::forPurpose(run.seed, "L1")) {
  learner_->start(prepared.genotype, prepared.spec.learner.settings, random_);
  if (const auto& start = prepared.spec.start) learner_->beginAt(prepared.start, {start->share, start->flip}, random_);
  if (const auto last = database.lastGeneration(run_)) {
    goOnFrom(*last, random_, *learner_);
    number_ = last->number;
  }
  for (const IndividualRecord& i : database.individualsOfSimulator(run_, simulator.id))
    known_.try_emplace(i.parameters, Known{i.fitness, i.outcome, i.detail, i.traceSha256, i.id});
}

void Search::beginAgain(std::span<const double> at, const Permutations& permutations, Random& random) {
  learner_->start(prepared_.genotype, prepared_.spec.learner.settings, random);
  learner_->beginAt(at, permutations, random);
}

std::vector<TrialJob> Search::ask() {
  candidates_ = learner_->ask(random_);
  jobOf_.clear();
  std::vector<TrialJob> jobs;
  for (const Candidate& candidate : candidates_)
    if (!known_.contains(candidate.parameters) && jobOf_.try_emplace(candidate.parameters, jobs.size()).second)
      jobs.push_back({simulator_.simulator, candidate.parameters, trialSeed_, false});
  return jobs;
}

GenerationRecord Search::fill(const std::vector<TrialReply>& replies) const {
  GenerationRecord generation;
  generation.run = run_;
  generation.number = number_ + 1;
  generation.simulator = simulator_.id;
  std::map<std::vector<double>, std::size_t> firstSlot;
  for (std::size_t slot = 0; slot < candidates_.size(); ++slot) {
    const Candidate& candidate = candidates_[slot];
    IndividualRecord individual;
    individual.run = run_;
    individual.generation = generation.number;
    individual.slot = static_cast<int>(slot);
    individual.simulator = generation.simulator;
    individual.chromosome = candidate.chromosome;
    individual.parameters = candidate.parameters;
    individual.trialSeed = trialSeed_;
    if (const auto known = known_.find(candidate.parameters); known != known_.end()) {
      individual.fitness = known->second.fitness;
      individual.outcome = known->second.outcome;
      individual.detail = known->second.detail;
      individual.traceSha256 = known->second.traceSha256;
      individual.sameAs = known->second.id;
      ++generation.reused;
    } else {
      const TrialReply& reply = replies[jobOf_.at(candidate.parameters)];
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
    if (!isFinished(individual.outcome)) ++generation.failed;
    generation.individuals.push_back(std::move(individual));
  }
  std::vector<double> fitness;
  for (const IndividualRecord& individual : generation.individuals) fitness.push_back(individual.fitness);
  generation.best = *std::ranges::max_element(fitness);
  generation.worst = *std::ranges::min_element(fitness);
  generation.mean = std::accumulate(fitness.begin(), fitness.end(), 0.0) / static_cast<double>(fitness.size());
  return generation;
}

void Search::tell(GenerationRecord& generation, std::span<const double> fitness) {
  learner_->tell(fitness);
  keepState(generation, random_, *learner_);
  generation.finishedAt = utcNow();
}

void Search::remember(const GenerationRecord& generation) {
  number_ = generation.number;
  for (const IndividualRecord& i : generation.individuals)
    if (i.sameAs == 0) known_.try_emplace(i.parameters, Known{i.fitness, i.outcome, i.detail, i.traceSha256, i.id});
}

}  // namespace btr
