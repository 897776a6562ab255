// The same robot, servo law and motions in our loop and in MuJoCo, interleaved in one run: CPU time of this thread per
// trial, set-up included and ended at the same event, each engine at every step beside how far its outcomes are from
// its own converged ones.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "core/plugin/plugin_host.h"
#include "core/sim/engine/lcp_hook.h"
#include "core/sim/trial.h"
#include "tests/bench/engine_tasks.h"
#include "tests/bench/mujoco_engine.h"

namespace btr::bench {
namespace {

constexpr double finest_s = 0.0000625;
constexpr double allowed = 0.05;
constexpr double steps_s[] = {0.008, 0.004, 0.002, 0.001, 0.0005, 0.00025, 0.000125};

/// One way of stepping; `run` returns the way of the ball or robot in each motion and adds the simulated time.
struct Way {
  std::string engine, step;
  std::function<std::vector<double>(double& simulated)> run;
  double cpu_s = std::numeric_limits<double>::infinity();  ///< of one trial, the least of the repeats
  double simulated_s = 0, outcome_m = 0;                   ///< means over the motions
  Deviation off = {};
};

/// |outcome − converged| in parts of the root mean square of the converged ones, so that a kick that misses the ball
/// does not divide by nothing; not a number if a motion failed.
Deviation deviationByScale(const std::vector<double>& outcomes, const std::vector<double>& converged) {
  double squares = 0;
  for (const double outcome : converged) squares += outcome * outcome;
  const double scale = std::sqrt(squares / static_cast<double>(converged.size()));
  std::vector<double> here, there;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    here.push_back(scale + outcomes[i] - converged[i]);
    there.push_back(scale);
  }
  return deviationOf(here, there);
}

std::string label(double step_s, double near_s) {
  char text[64];
  if (near_s < step_s)
    std::snprintf(text, sizeof text, "%g ms, %g near", 1e3 * step_s, 1e3 * near_s);
  else
    std::snprintf(text, sizeof text, "%g ms", 1e3 * step_s);
  return text;
}

Way ours(const BenchTask& task, double step_s, int near, bool ownSolver) {
  return {ownSolver ? "ours" : "ours, libode's LCP", label(step_s, step_s / near),
          [&task, step_s, near, ownSolver](double& simulated) {
            Scene scene = task.scene;
            scene.step_s = step_s;
            scene.nearSubsteps = near;
            LcpHook::ofThisThread() = LcpHook{};
            LcpHook::ofThisThread().reduce = ownSolver;
            std::vector<double> outcomes;
            for (const auto& parameters : task.parameters) {
              const auto result = runTrial(scene, *task.controller, task.settings, parameters, 1, {.maximum_s = 60});
              const Eigen::Vector3d way = result.balls.empty()
                                              ? Eigen::Vector3d(result.baseEnd_m - result.baseStart_m)
                                              : Eigen::Vector3d(result.balls[0].rest_m - result.balls[0].start_m);
              outcomes.push_back(result.outcome == TrialResult::Outcome::finished ? way.head<2>().norm() : NAN);
              simulated += result.simulated_s;
            }
            return outcomes;
          }};
}

Way theirs(const BenchTask& task, MujocoEngine& engine, const MujocoWay& way) {
  return {way.name, label(way.step_s, way.nearStep_s > 0 ? way.nearStep_s : way.step_s),
          [&task, &engine, way](double& simulated) {
            std::vector<double> outcomes;
            for (const auto& parameters : task.parameters) {
              const auto outcome = engine.run(parameters, way);
              outcomes.push_back(outcome.way_m);
              simulated += outcome.simulated_s;
            }
            return outcomes;
          }};
}

/// An engine with all its ways of stepping.
struct Engine {
  std::string name;
  Way converged;
  std::vector<Way> ways;
};

Engine ourEngine(const BenchTask& task, bool ownSolver) {
  Engine engine{ownSolver ? "ours" : "ours, libode's LCP", ours(task, finest_s, 1, ownSolver), {}};
  for (const double step : steps_s)
    for (const int near : {1, 2, 4, 8, 16})
      if (near == 1 || (!task.scene.balls.empty() && step / near >= 0.00024 && step / near <= 0.0011))
        engine.ways.push_back(ours(task, step, near, ownSolver));
  return engine;
}

Engine theirEngine(const BenchTask& task, MujocoEngine& mujoco, bool implicit) {
  const std::string name = implicit ? "MuJoCo tuned" : "MuJoCo explicit";
  Engine engine{name, theirs(task, mujoco, {name, implicit, finest_s, 0}), {}};
  for (const double step : steps_s)
    for (const double near : {0.0, 0.001, 0.0005, 0.00025})
      if (near == 0 || (implicit && !task.scene.balls.empty() && near < step))
        engine.ways.push_back(theirs(task, mujoco, {name, implicit, step, near}));
  return engine;
}

std::vector<double> timed(Way& way) {
  double simulated = 0;
  const double begin = threadSeconds();
  auto outcomes = way.run(simulated);
  way.cpu_s = std::min(way.cpu_s, (threadSeconds() - begin) / static_cast<double>(outcomes.size()));
  way.simulated_s = simulated / static_cast<double>(outcomes.size());
  return outcomes;
}

void measure(Way& way, const std::vector<double>& converged) {
  const auto outcomes = timed(way);
  way.outcome_m = 0;
  for (const double outcome : outcomes) way.outcome_m += outcome / static_cast<double>(outcomes.size());
  way.off = deviationByScale(outcomes, converged);
}

/// The cheapest way whose deviation, as `of` reads it, is at most 5 %; nullptr if there is none.
const Way* cheapest(const Engine& engine, double Deviation::*of) {
  const Way* best = nullptr;
  for (const Way& way : engine.ways)
    if (way.off.*of <= allowed && (!best || way.cpu_s < best->cpu_s)) best = &way;
  return best;
}

/// True where a way may be the cheapest once it is timed again.
bool mayBeCheapest(const Engine& engine, const Way& way) {
  for (const auto of : {&Deviation::median, &Deviation::rms})
    if (const Way* best = cheapest(engine, of); best && way.off.*of <= allowed && way.cpu_s < 1.5 * best->cpu_s)
      return true;
  return false;
}

void row(const Way& way, double unit) {
  std::printf("  %-20s %-18s %13.3f %8.2f %14.2f %12.3f %9.1f%% %9.1f%%\n", way.engine.c_str(), way.step.c_str(),
              1e3 * way.cpu_s, way.cpu_s / unit, 1e3 * way.cpu_s / way.simulated_s, way.outcome_m, 1e2 * way.off.median,
              1e2 * way.off.rms);
}

void heading(const char* what) {
  std::printf("\n%s\n  %-20s %-18s %13s %8s %14s %12s %10s %10s\n", what, "engine", "step", "ms a trial", "ratio",
              "ms a sim. s", "outcome m", "median off", "r.m.s. off");
}

void chosen(const std::vector<Engine>& engines, const char* what, double Deviation::*of) {
  heading(what);
  const Way* reference = cheapest(engines.front(), of);
  for (const Engine& engine : engines) {
    const Way* best = cheapest(engine, of);
    if (best)
      row(*best, reference ? reference->cpu_s : best->cpu_s);
    else
      std::printf("  %-20s none of its steps\n", engine.name.c_str());
  }
}

void compare(const BenchTask& task, int repeats) {
  MujocoEngine mujoco(task);
  std::vector<Engine> engines;
  for (const bool own : {true, false}) engines.push_back(ourEngine(task, own));
  for (const bool implicit : {true, false}) engines.push_back(theirEngine(task, mujoco, implicit));
  for (Engine& engine : engines) {
    double simulated = 0;
    const auto converged = engine.converged.run(simulated);
    for (Way& way : engine.ways) measure(way, converged);
  }
  // In turns, so that all see the same machine.
  for (int repeat = 1; repeat < repeats; ++repeat)
    for (Engine& engine : engines)
      for (Way& way : engine.ways)
        if (mayBeCheapest(engine, way)) timed(way);
  std::printf("%s: %zu motions; converged is %g ms of the same engine\n", task.name.c_str(), task.parameters.size(),
              1e3 * finest_s);
  chosen(engines, "cheapest whose median is within 5 %", &Deviation::median);
  chosen(engines, "cheapest whose r.m.s. is within 5 %", &Deviation::rms);
  heading("all");
  for (const Engine& engine : engines)
    for (const Way& way : engine.ways) row(way, engines.front().ways.front().cpu_s);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace
}  // namespace btr::bench

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 5;
  const btr::PluginHost host(PLUGIN_DIR);
  const auto kick = host.controller("kick");
  const auto halfEllipse = host.controller("half_ellipse");
  btr::bench::compare(btr::bench::manyKicks(*kick), repeats);
  btr::bench::compare(btr::bench::manyWalks(*halfEllipse), repeats);
}
