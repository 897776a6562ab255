#include "core/run/reality/gait_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/run/reality/reality_gap.h"
#include "core/sim/worker_pool.h"
#include "core/spec/error.h"

namespace btr {
namespace {

using nlohmann::json;

std::vector<Parameter> adaptedParameters(const std::vector<std::string>& names) {
  std::vector<Parameter> adapted;
  for (const std::string& name : names)
    if (!find(simulatorParameters(), name)) throw InputError("--adapt", name, "the name of a simulator parameter");
  for (const Parameter& p : simulatorParameters()) {
    const bool named = std::find(names.begin(), names.end(), p.name) != names.end();
    if (names.empty() ? !p.name.ends_with("_mass_kg") : named) adapted.push_back(p);
  }
  return adapted;
}

/// Simulates gaits in simulators on worker processes.
class GaitTrials {
 public:
  GaitTrials(const std::vector<PreparedGait>& gaits, int jobs)
      : pool_(jobs > 0 ? jobs : processorCount(), [&gaits](const std::string& text) {
          const json job = json::parse(text);
          const PreparedGait& gait = gaits.at(job.at("gait").get<std::size_t>());
          const SimulatorSpec simulator = simulatorFromJson(job.at("simulator").get<std::string>(), "job");
          const PreparedExperiment& e = gait.experiment;
          const TrialResult result = e.trial(e.scene(simulator), gait.parameters, 1, false);
          return json{{"fitness", e.fitnessOf(result)}, {"detail", e.detailOf(result)}}.dump();
        }) {}

  struct Outcome {
    double fitness = 0;
    std::string detail;
  };
  /// One outcome for each simulator and gait, simulator by simulator. Nothing if stopped.
  std::optional<std::vector<Outcome>> run(const std::vector<SimulatorSpec>& simulators,
                                          const std::vector<std::size_t>& gaits, const std::atomic<bool>& stop) {
    std::vector<std::string> jobs;
    for (const SimulatorSpec& simulator : simulators)
      for (const std::size_t gait : gaits)
        jobs.push_back(json{{"gait", gait}, {"simulator", toJsonText(simulator)}}.dump());
    const auto replies = pool_.run(jobs, stop);
    if (replies.size() != jobs.size()) return std::nullopt;
    std::vector<Outcome> outcomes;
    for (const WorkerPool::Reply& reply : replies) {
      if (!reply.ok) {
        outcomes.push_back({0, reply.failure});
        continue;
      }
      const json answer = json::parse(reply.bytes);
      outcomes.push_back({answer.at("fitness").get<double>(), answer.at("detail").get<std::string>()});
    }
    return outcomes;
  }

 private:
  WorkerPool pool_;
};

SimulatorSpec simulatorOf(const std::vector<Parameter>& adapted, const std::vector<double>& values) {
  SimulatorSpec simulator;
  for (std::size_t i = 0; i < adapted.size(); ++i) simulator.values[adapted[i].name] = values[i];
  return simulator;
}

/// Root mean square of simulated/real − 1.
double errorOf(const std::vector<PreparedGait>& gaits, const std::vector<std::size_t>& which,
               const GaitTrials::Outcome* outcomes) {
  std::vector<double> ones, ratios;
  for (std::size_t i = 0; i < which.size(); ++i) {
    ones.push_back(1);
    ratios.push_back(outcomes[i].fitness / gaits[which[i]].spec.real);
  }
  return gapOf(ones, ratios, GapNorm::rootMeanSquare);
}

}  // namespace

PreparedGait prepareGait(const GaitSpec& gait, const PluginHost& host) {
  ExperimentSpec experiment;
  experiment.name = gait.name;
  experiment.scene = gait.scene;
  experiment.controller = gait.controller;
  experiment.fitness = gait.fitness;
  // Who measured a real dog's speed did not count points out of reach.
  if (find(host.fitness(gait.fitness.name)->settings(), "infeasible_penalty"))
    experiment.fitness.settings.try_emplace("infeasible_penalty", 0);
  experiment.learner.name = experiment.adaptation.name = "ga";
  experiment.directory = gait.directory;
  experiment.stages["trial_maximum_s"] = 600;  // a gait's own duration ends it
  PreparedGait prepared{gait, prepareFromFiles(experiment, host), {}};
  prepared.parameters = resolve(prepared.experiment.genotype, gait.parameters, "gait \"" + gait.name + "\"");
  return prepared;
}

std::optional<GaitCheck> checkGaits(const std::vector<GaitSpec>& specs, const std::vector<bool>& heldOut,
                                    const PluginHost& host, const GaitCheckOptions& options,
                                    const std::atomic<bool>& stop) {
  std::vector<PreparedGait> gaits;
  std::vector<std::size_t> all, shown, hidden;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    gaits.push_back(prepareGait(specs[i], host));
    all.push_back(i);
    if (specs[i].measured) (heldOut[i] ? hidden : shown).push_back(i);
  }
  if (shown.empty()) throw InputError("gaits: none is left to fit, all are held out or were not measured");
  const std::vector<Parameter> adapted = adaptedParameters(options.adapted);
  GaitTrials trials(gaits, options.jobs);

  GaitCheck check;
  const auto before = trials.run({check.before}, all, stop);
  const auto start = trials.run({check.before}, shown, stop);
  if (!before || !start) return std::nullopt;
  check.errorBefore = errorOf(gaits, shown, start->data());

  // As L3: the learner maximises how much smaller an error is than the generation's worst.
  const auto learner = host.learner("ga");
  Random random = Random::forPurpose(options.seed, "gaits");
  learner->start(adapted, {{"population", static_cast<double>(options.population)}}, random);
  std::map<std::vector<double>, double> known;
  double best = check.errorBefore;
  for (int generation = 1; generation <= options.generations; ++generation) {
    const std::vector<Candidate> candidates = learner->ask(random);
    std::vector<SimulatorSpec> fresh;
    std::vector<std::vector<double>> freshValues;
    for (const Candidate& c : candidates)
      if (known.try_emplace(c.parameters, 0).second) {
        fresh.push_back(simulatorOf(adapted, c.parameters));
        freshValues.push_back(c.parameters);
      }
    const auto outcomes = trials.run(fresh, shown, stop);
    if (!outcomes) return std::nullopt;
    for (std::size_t i = 0; i < fresh.size(); ++i) {
      const double error = known[freshValues[i]] = errorOf(gaits, shown, outcomes->data() + i * shown.size());
      if (error < best) {
        best = error;
        check.after = fresh[i];
      }
    }
    double worst = 0;
    for (const Candidate& c : candidates) worst = std::max(worst, known.at(c.parameters));
    std::vector<double> fitness;
    for (const Candidate& c : candidates) fitness.push_back(worst - known.at(c.parameters));
    learner->tell(fitness);
    if (options.progress) options.progress(generation, best);
  }
  check.errorAfter = best;

  const auto after = trials.run({check.after}, all, stop);
  const auto hiddenBefore = trials.run({check.before}, hidden, stop),
             hiddenAfter = trials.run({check.after}, hidden, stop);
  if (!after || !hiddenBefore || !hiddenAfter) return std::nullopt;
  check.heldOutBefore = errorOf(gaits, hidden, hiddenBefore->data());
  check.heldOutAfter = errorOf(gaits, hidden, hiddenAfter->data());
  for (const std::size_t i : all) {
    const PreparedExperiment& e = gaits[i].experiment;
    check.gaits.push_back({specs[i].name, e.sceneSpec.robots.front().name, e.fitness->unit(), specs[i].real,
                           (*before)[i].fitness, (*after)[i].fitness, specs[i].measured, heldOut[i],
                           (*before)[i].detail, (*after)[i].detail});
  }
  return check;
}

}  // namespace btr
