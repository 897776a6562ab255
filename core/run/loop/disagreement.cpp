#include "core/run/loop/disagreement.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "core/run/reality/spread.h"

namespace btr {
namespace {

double squaredDistance(std::span<const Parameter> declared, std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < declared.size(); ++i) {
    const double range = declared[i].maximum - declared[i].minimum;
    if (range > 0) sum += (a[i] - b[i]) / range * ((a[i] - b[i]) / range);
  }
  return sum;
}

/// What is stored of the adaptation that made a version.
struct Made {
  std::optional<double> error;  ///< of the version, in the adaptation's own norm
  std::string evidenceSha256;   ///< as in its generations
};
Made madeFrom(const SimulatorRecord& version) {
  const auto evidence = nlohmann::json::parse(version.evidence, nullptr, false);
  Made made;
  if (!evidence.is_object()) return made;
  if (evidence.contains("error")) made.error = evidence["error"].get<double>();
  made.evidenceSha256 = evidence.value("sha256", "");
  return made;
}

}  // namespace

std::vector<std::vector<double>> equallyGood(const std::vector<AdaptationCandidate>& all,
                                             std::span<const Parameter> adapted, std::size_t count, double ratio,
                                             double reference) {
  std::vector<const AdaptationCandidate*> sorted;
  std::set<std::vector<double>> seen;
  for (const AdaptationCandidate& c : all)
    if (seen.insert(c.parameters).second) sorted.push_back(&c);
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto* a, const auto* b) { return a->error < b->error; });
  const auto end = std::find_if(sorted.begin(), sorted.end(),
                                [&](const AdaptationCandidate* c) { return !(c->error <= ratio * reference); });
  sorted.resize(std::max<std::size_t>(static_cast<std::size_t>(end - sorted.begin()), sorted.empty() ? 0 : 1));

  // The best first, then one after another the farthest from those that are chosen.
  std::vector<std::vector<double>> chosen;
  std::vector<double> nearest(sorted.size(), std::numeric_limits<double>::infinity());
  std::size_t next = 0;
  while (chosen.size() < std::min(count, sorted.size())) {
    chosen.push_back(sorted[next]->parameters);
    for (std::size_t i = 0; i < sorted.size(); ++i)
      nearest[i] = std::min(nearest[i], squaredDistance(adapted, sorted[i]->parameters, chosen.back()));
    next = static_cast<std::size_t>(std::max_element(nearest.begin(), nearest.end()) - nearest.begin());
  }
  return chosen;
}

std::vector<std::vector<double>> drawnAround(std::span<const Parameter> adapted, std::span<const double> centre,
                                             std::size_t count, double spread, Random& random) {
  std::vector<std::vector<double>> drawn(count);
  for (std::vector<double>& vector : drawn)
    for (std::size_t i = 0; i < adapted.size(); ++i) {
      const double reach = spread * (adapted[i].maximum - adapted[i].minimum);
      vector.push_back(random.uniform(std::max(adapted[i].minimum, centre[i] - reach),
                                      std::min(adapted[i].maximum, centre[i] + reach)));
    }
  return drawn;
}

std::vector<SimulatorSpec> candidateSimulators(const RunContext& context, int stage) {
  const SimulatorRecord newest = context.simulator();
  const std::vector<Parameter>& adapted = context.prepared.adapted;
  const auto others = static_cast<std::size_t>(context.stageSetting("candidate_simulators")) - 1;
  std::vector<double> present;
  for (const Parameter& p : adapted) present.push_back(valueOf(simulatorParameters(), newest.simulator.values, p.name));

  std::vector<AdaptationCandidate> last;
  const Made made = madeFrom(newest);
  if (newest.madeBy == "L3")
    for (const AdaptationRecord& generation : context.database.adaptations(context.record.id, stage - 1))
      for (const AdaptationCandidate& c : generation.candidates)
        if (c.parameters != present && generation.evidenceSha256 == made.evidenceSha256) last.push_back(c);
  std::vector<std::vector<double>> vectors;
  if (last.empty()) {
    Random random = Random::forPurpose(context.record.seed, "candidate simulators", static_cast<std::uint64_t>(stage));
    const double spread = valueOf(stageParameters(), context.prepared.spec.stages, "candidate_spread");
    vectors = drawnAround(adapted, present, others, spread, random);
  } else {
    const double best = std::ranges::min(last, {}, &AdaptationCandidate::error).error;
    const double ratio = valueOf(stageParameters(), context.prepared.spec.stages, "candidate_error_ratio");
    vectors = equallyGood(last, adapted, others, ratio, made.error.value_or(best));
  }
  std::vector<SimulatorSpec> candidates{newest.simulator};
  for (const std::vector<double>& values : vectors)
    candidates.push_back(context.prepared.adaptedTo(newest.simulator, values));
  return candidates;
}

std::optional<std::vector<Disagreement>> disagreements(RunContext& context, const std::vector<IndividualRecord>& among,
                                                       const std::vector<SimulatorSpec>& candidates) {
  std::vector<Disagreement> all;
  std::vector<TrialJob> jobs;
  for (const IndividualRecord& i : among) {
    if (!isFinished(i.outcome)) continue;
    all.push_back({i, 0, 0});
    for (const SimulatorSpec& simulator : candidates) jobs.push_back({simulator, i.parameters, i.trialSeed, false});
  }
  const auto replies = context.evaluate(jobs);
  if (!replies) return std::nullopt;
  for (std::size_t k = 0; k < all.size(); ++k) {
    std::vector<double> fitness;
    for (std::size_t c = 0; c < candidates.size(); ++c)
      if (const TrialReply& reply = (*replies)[k * candidates.size() + c]; isFinished(reply.outcome))
        fitness.push_back(reply.fitness);
    const Spread spread = spreadOf(fitness);
    all[k].deviation = spread.deviation;
    all[k].candidates = spread.count;
  }
  std::erase_if(all, [](const Disagreement& d) { return d.candidates < 2; });
  std::stable_sort(all.begin(), all.end(),
                   [](const Disagreement& a, const Disagreement& b) { return a.deviation > b.deviation; });
  return all;
}

}  // namespace btr
