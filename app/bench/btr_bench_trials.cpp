// What btr bench says of trials: one after the other, with ODE's own solver, their set-up, and many at once.
#include <cmath>

#include "app/bench/btr_bench_clock.h"
#include "app/bench/btr_bench_rows.h"
#include "core/run/setup/evaluator.h"
#include "core/sim/engine/lcp_hook.h"
#include "core/sim/trial.h"
#include "core/spec/random.h"

namespace btr::cli {
namespace {

constexpr int setUps = 200;
constexpr std::size_t populationOfABatch = 60;

std::string stepOf(const BenchStep& at) {
  return at.nearSubsteps > 1 ? printed("%g ms, %g near the ball", 1e3 * at.step_s, 1e3 * at.step_s / at.nearSubsteps)
                             : printed("%g ms", 1e3 * at.step_s);
}

/// CPU seconds per simulated second of all motions.
double once(const BenchTask& task, const BenchStep& at, bool ownSolver) {
  Scene scene = task.scene;
  scene.step_s = at.step_s;
  scene.nearSubsteps = at.nearSubsteps;
  const LcpHook before = LcpHook::ofThisThread();
  LcpHook::ofThisThread() = LcpHook{};
  LcpHook::ofThisThread().reduce = ownSolver;
  double simulated = 0;
  const double begin = threadSeconds();
  for (const auto& parameters : task.parameters)
    simulated += runTrial(scene, *task.controller, task.settings, parameters, 1, {.maximum_s = 60}).simulated_s;
  const double cpu = (threadSeconds() - begin) / simulated;
  LcpHook::ofThisThread() = before;
  return cpu;
}

}  // namespace

std::vector<BenchRow> taskRows(const BenchTask& task, const BenchResult& result, const BenchWork& work) {
  const std::string cpu = "CPU per simulated second";
  if (result.chosen < 0) return {{task.name, cpu, NAN, "ms", "", "", "no step is within 5 % of 0.25 ms"}};
  const BenchStep& at = result.steps[static_cast<std::size_t>(result.chosen)];
  double ours = 1e9, theirs = 1e9;
  for (int repeat = 0; repeat < work.repeats && work.goesOn(); ++repeat) {
    ours = std::min(ours, once(task, at, true));
    theirs = std::min(theirs, once(task, at, false));
  }
  const std::string exact = printed("off by %.1f %%, r.m.s. %.1f %%", 1e2 * at.deviation, 1e2 * at.rmsDeviation);
  return {{task.name, cpu, 1e3 * ours, "ms", stepOf(at), exact, "cheapest step whose median is within 5 % of 0.25 ms"},
          {task.name, "trials on one core", at.trialsPerSecond, "1/s", stepOf(at), exact, "set-up included"},
          {task.name, cpu + ", ODE's own solver", 1e3 * theirs, "ms", stepOf(at), "",
           printed("interleaved; %.2f times ours", theirs / ours)}};
}

std::vector<BenchRow> setUpRows(const BenchTask& kick, const BenchWork& work) {
  // A trial that ends as soon as it has begun.
  const TrialOptions options{.maximum_s = kick.scene.step_s};
  double best = 1e9;
  for (int repeat = 0; repeat < work.repeats && work.goesOn(); ++repeat) {
    const double begin = threadSeconds();
    for (int k = 0; k < setUps; ++k)
      runTrial(kick.scene, *kick.controller, kick.settings,
               kick.parameters[static_cast<std::size_t>(k) % kick.parameters.size()], 1, options);
    best = std::min(best, (threadSeconds() - begin) / setUps);
  }
  return {{"set-up", "CPU of a trial of one step", 1e3 * best, "ms", printed("%g ms", 1e3 * kick.scene.step_s), "",
           "a kick's world made and taken down; 0.2 ms is aimed at"}};
}

// A population of random kicks, as a generation evaluates it.
std::vector<BenchRow> batchRows(const BenchWork& work) {
  const PreparedExperiment prepared =
      prepareFromFiles(loadExperiment(work.resources + "/experiments/kick-short.json"), work.host);
  const SimulatorSpec simulator = firstSimulator(prepared).simulator;
  Random random(1);
  std::vector<TrialJob> jobs(populationOfABatch);
  for (TrialJob& job : jobs) {
    job.simulator = simulator;
    job.seed = 1;
    for (const Parameter& parameter : prepared.genotype) {
      const double value = random.uniform(parameter.minimum, parameter.maximum);
      job.parameters.push_back(parameter.integer || !parameter.choices.empty() ? std::round(value) : value);
    }
  }
  const auto speed = [&](int workers) {
    Evaluator evaluator(prepared, workers);
    double best = 1e9;
    for (int repeat = 0; repeat < work.repeats && work.goesOn(); ++repeat) {
      const double begin = wallSeconds();
      if (!evaluator.evaluate(jobs, false)) return 0.0;
      best = std::min(best, wallSeconds() - begin);
    }
    return static_cast<double>(jobs.size()) / best;
  };
  const double alone = speed(1), together = speed(0);
  const std::string step = printed("%g ms", 1e3 * prepared.sceneSpec.step_s);
  return {{"batch", "trials with one worker", alone, "1/s", step, "", "60 random kicks, wall time"},
          {"batch", printed("trials with %d workers", processorCount()), together, "1/s", step, "",
           printed("%.2f times one worker", together / alone)}};
}

}  // namespace btr::cli
