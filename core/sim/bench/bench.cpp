#include "core/sim/bench/bench.h"

#include <ctime>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/sim/trial.h"

namespace btr {
namespace {

constexpr double finest_s = 0.00025;
constexpr double allowed = 0.05;

double outcomeOf(const TrialResult& result) {
  if (result.balls.empty()) return (result.baseEnd_m - result.baseStart_m).head<2>().norm();
  return (result.balls[0].rest_m - result.balls[0].start_m).head<2>().norm();
}

/// Outcomes of all motions at one step, none if it was stopped; the time is that of the fastest repeat.
std::vector<double> measure(const BenchTask& task, BenchStep& at, int repeats, const std::function<bool()>& goesOn) {
  Scene scene = task.scene;
  scene.step_s = at.step_s;
  scene.nearSubsteps = at.nearSubsteps;
  const TrialOptions options{.maximum_s = 60};
  std::vector<double> outcomes;
  double best = 1e9, simulated = 0;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    outcomes.clear();
    simulated = 0;
    const double begin = threadSeconds();
    for (const auto& parameters : task.parameters) {
      if (goesOn && !goesOn()) return {};
      const auto result = runTrial(scene, *task.controller, task.settings, parameters, 1, options);
      outcomes.push_back(result.outcome == TrialResult::Outcome::finished ? outcomeOf(result) : NAN);
      simulated += result.simulated_s;
    }
    best = std::min(best, threadSeconds() - begin);
  }
  at.cpuPerSimulated = best / simulated;
  at.trialsPerSecond = static_cast<double>(task.parameters.size()) / best;
  at.outcome_m = 0;
  for (const double outcome : outcomes) at.outcome_m += outcome / static_cast<double>(outcomes.size());
  return outcomes;
}

std::string text(const char* format, auto... values) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, values...);
  return buffer;
}

std::string stepText(const BenchStep& step) {
  std::string result = text("%g ms", 1e3 * step.step_s);
  if (step.nearSubsteps > 1) result += text(" / %d near the ball", step.nearSubsteps);
  return result;
}

}  // namespace

double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Deviation deviationOf(const std::vector<double>& outcomes, const std::vector<double>& converged) {
  std::vector<double> off;
  double squares = 0;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    off.push_back(std::abs(outcomes[i] / converged[i] - 1));
    squares += off.back() * off.back();
  }
  if (off.empty() || std::isnan(squares)) return {NAN, NAN};
  std::sort(off.begin(), off.end());
  const std::size_t half = off.size() / 2;
  return {off.size() % 2 ? off[half] : (off[half - 1] + off[half]) / 2,
          std::sqrt(squares / static_cast<double>(off.size()))};
}

BenchResult benchmark(const BenchTask& task, int repeats, const std::function<void(const std::string&)>& progress,
                      const std::function<bool()>& goesOn) {
  BenchResult result;
  result.name = task.name;
  result.converged.step_s = finest_s;
  const auto converged = measure(task, result.converged, 1, goesOn);
  if (converged.empty()) return result;
  if (progress) progress(task.name + ": converged outcome known");

  std::vector<std::pair<double, int>> tried;
  for (const double step : {0.008, 0.004, 0.002, 0.001, 0.0005}) {
    // Where there is a ball, also with steps of 0.5 or 1 ms near it.
    for (const int near : {1, 4, 8, 16})
      if (near == 1 || (!task.scene.balls.empty() && step / near >= 0.00049 && step / near <= 0.0011))
        tried.emplace_back(step, near);
  }
  for (const auto& [step, near] : tried) {
    BenchStep at{.step_s = step, .nearSubsteps = near};
    const auto outcomes = measure(task, at, repeats, goesOn);
    if (outcomes.empty()) return result;
    const Deviation off = deviationOf(outcomes, converged);
    at.deviation = off.median;
    at.rmsDeviation = off.rms;
    result.steps.push_back(at);
    const bool good = at.deviation <= allowed;  // false for a trial that failed (not a number)
    const auto better = [&](const BenchStep& other) { return at.cpuPerSimulated < other.cpuPerSimulated; };
    if (good && (result.chosen < 0 || better(result.steps[static_cast<std::size_t>(result.chosen)])))
      result.chosen = static_cast<int>(result.steps.size()) - 1;
    if (progress) progress(task.name + ": " + stepText(at));
  }
  return result;
}

std::string benchTable(const std::vector<BenchResult>& results) {
  std::string table =
      "task   step                     CPU ms per simulated s   simulated s per s   trials per s   outcome m   off by "
      "  (r.m.s.)\n";
  const auto line = [&](const std::string& name, const BenchStep& at, const char* mark) {
    table += text("%-6s %-24s %22.2f %19.0f %14.1f %11.3f %7.1f%% %9.1f%%%s\n", name.c_str(), stepText(at).c_str(),
                  1e3 * at.cpuPerSimulated, 1 / at.cpuPerSimulated, at.trialsPerSecond, at.outcome_m,
                  1e2 * at.deviation, 1e2 * at.rmsDeviation, mark);
  };
  for (const auto& result : results) {
    if (result.chosen >= 0)
      line(result.name, result.steps[static_cast<std::size_t>(result.chosen)], "  <- fastest within 5%");
    for (std::size_t i = 0; i < result.steps.size(); ++i)
      if (static_cast<int>(i) != result.chosen) line("", result.steps[i], "");
    line("", result.converged, "  converged");
  }
  return table +
         "One core, thread CPU time, set-up of each trial included. Off by: median over the motions; r.m.s. beside "
         "it.\n";
}

}  // namespace btr
