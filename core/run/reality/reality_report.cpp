#include "core/run/reality/reality_report.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/run/reality/reality_gap.h"
#include "core/spec/experiment_spec.h"

namespace btr {
namespace {

/// Whether the last policy of each iteration is the centre itself, which takes no part in the step.
bool measuresCentre(const RunRecord& run) {
  const ExperimentSpec spec = experimentFromJson(run.specJson, "run " + std::to_string(run.id), "");
  const auto word = spec.realityLearner.words.find("measure_centre");
  return word != spec.realityLearner.words.end() && word->second == "yes";
}

/// The change of each parameter; 0 where none of the policies changes it, nothing if they are no such steps.
std::optional<std::vector<double>> epsilonsOf(const std::vector<PolicyRow>& policies,
                                              std::span<const Parameter> genotype, const std::vector<double>& centre) {
  std::vector<double> epsilons(centre.size(), 0);
  for (std::size_t n = 0; n < centre.size(); ++n) {
    std::optional<double> below, above;
    for (const PolicyRow& p : policies) {
      const double value = p.parameters[n];
      if (value == centre[n]) continue;
      std::optional<double>& side = value < centre[n] ? below : above;
      if (side && *side != value) return std::nullopt;
      side = value;
      // A bound may cut one side short: the longer one is the change.
      if (value > genotype[n].minimum && value < genotype[n].maximum)
        epsilons[n] = std::abs(value - centre[n]);
      else
        epsilons[n] = std::max(epsilons[n], std::abs(value - centre[n]));
    }
  }
  return epsilons;
}

std::vector<StepRow> stepsOf(const std::vector<PolicyRow>& policies, std::span<const Parameter> genotype,
                             const RealityIteration& iteration, bool isFinished, bool withCentre) {
  const std::vector<double>& centre = iteration.centreBefore;
  const auto epsilons = epsilonsOf(policies, genotype, centre);
  if (!epsilons) return {};
  std::vector<std::vector<double>> changed;
  std::vector<double> fitness;
  for (const PolicyRow& p : policies) {
    changed.push_back(p.parameters);
    fitness.push_back(p.fitness.value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  if (withCentre) {
    changed.pop_back();
    fitness.pop_back();
  }
  const PolicyGradient gradient = policyGradient(genotype, centre, *epsilons, 1, changed, fitness);
  std::vector<StepRow> steps;
  for (std::size_t n = 0; n < genotype.size(); ++n) {
    StepRow& row = steps.emplace_back();
    row.parameter = genotype[n];
    row.centreBefore = centre[n];
    row.gradient = gradient.parameters[n];
    if (!isFinished) continue;
    row.centreAfter = iteration.centreAfter.at(n);
    row.gradient.step = *row.centreAfter - centre[n];
  }
  return steps;
}

}  // namespace

std::vector<RealityReport> realityReports(const Database& database, const RunRecord& run,
                                          std::span<const Parameter> genotype) {
  std::vector<RealityIteration> iterations = database.realityIterations(run.id);
  const std::size_t finished = iterations.size();
  if (const auto begun = database.begunRealityIteration(run.id, run.stage + 1)) iterations.push_back(*begun);
  std::vector<RealityReport> reports;
  if (iterations.empty()) return reports;

  const bool withCentre = measuresCentre(run);
  const std::vector<MeasurementTask> tasks = database.measurementTasks(run.id);
  const std::vector<MeasurementRecord> values = database.measurements(run.id);
  const auto isOpen = [&](const RealityIteration& i) {
    return std::ranges::any_of(tasks, [&](const MeasurementTask& t) {
      return t.stage == i.stage && t.iteration == i.number && !isSettled(t, values);
    });
  };
  std::map<Id, RealFitness> real;
  for (RealFitness& r : realFitness(tasks, values, run.stage + 1)) real.emplace(r.individual, std::move(r));
  for (const RealityIteration& iteration : iterations) {
    RealityReport& report = reports.emplace_back();
    report.stage = iteration.stage;
    report.number = iteration.number;
    report.isFinished = reports.size() <= finished;
    report.wasEnded = report.isFinished && isOpen(iteration);
    std::size_t slot = 0;
    for (const IndividualRecord& i : database.realityPolicies(run.id, iteration.stage, iteration.number)) {
      PolicyRow& policy = report.policies.emplace_back();
      policy.individual = i.id;
      policy.parameters = i.parameters;
      policy.simulated = i.fitness;
      for (std::size_t n = 0; n < iteration.centreBefore.size(); ++n)
        policy.changes.push_back((i.parameters[n] > iteration.centreBefore[n]) -
                                 (i.parameters[n] < iteration.centreBefore[n]));
      // What the learner was told stays; of an iteration that waits, what is known by now.
      if (report.isFinished) {
        const RealityPolicy& told = iteration.policies.at(slot++);
        policy.fitness = told.fitness;
        policy.standardError = told.standardError;
        policy.count = told.count;
      } else if (const auto found = real.find(i.id); found != real.end()) {
        policy.fitness = found->second.mean;
        policy.standardError = found->second.standardDeviation / std::sqrt(found->second.count);
        policy.count = found->second.count;
      }
    }
    if (iteration.centreBefore.size() == genotype.size())
      report.steps = stepsOf(report.policies, genotype, iteration, report.isFinished, withCentre);
  }
  return reports;
}

}  // namespace btr
