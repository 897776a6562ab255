// The same robot, servo law and tasks in our loop and in MuJoCo, interleaved in one run: CPU time of this thread per
// simulated second, each at the cheapest step whose outcomes are within 5 % (root mean square over the motions) of the
// same engine's own at 0.25 ms.
#include <ctime>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "core/plugin/plugin_host.h"
#include "core/sim/engine/lcp_hook.h"
#include "core/sim/trial.h"
#include "tests/bench/mujoco_engine.h"

namespace btr::bench {
namespace {

double cpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// One way of running one task; returns the outcome of each motion and adds the simulated time.
struct Rival {
  std::string name;
  std::string step;
  std::function<std::vector<double>(double& simulated)> run;
  double cpu = 1e9, deviation = NAN, outcome = 0;
};

Rival ours(const BenchTask& task, double step, int near, bool ownSolver) {
  char label[64];
  std::snprintf(label, sizeof label, near > 1 ? "%g ms, %g near" : "%g ms", 1e3 * step, 1e3 * step / near);
  return {ownSolver ? "ours" : "ours, libode's LCP", label, [&task, step, near, ownSolver](double& simulated) {
            Scene scene = task.scene;
            scene.step_s = step;
            scene.nearSubsteps = near;
            LcpHook::ofThisThread() = LcpHook{};
            LcpHook::ofThisThread().reduce = ownSolver;
            std::vector<double> outcomes;
            for (const auto& parameters : task.parameters) {
              const auto result = runTrial(scene, *task.controller, task.settings, parameters, 1, {.maximum_s = 60});
              const Eigen::Vector3d way = result.balls.empty()
                                              ? Eigen::Vector3d(result.baseEnd_m - result.baseStart_m)
                                              : Eigen::Vector3d(result.balls[0].rest_m - result.balls[0].start_m);
              outcomes.push_back(way.head<2>().norm());
              simulated += result.simulated_s;
            }
            return outcomes;
          }};
}

Rival theirs(const BenchTask& task, MujocoEngine& engine, const MujocoWay& way) {
  char label[64];
  std::snprintf(label, sizeof label, way.nearStep_s > 0 ? "%g ms, %g near" : "%g ms", 1e3 * way.step_s,
                1e3 * way.nearStep_s);
  return {way.name, label, [&task, &engine, way](double& simulated) {
            std::vector<double> outcomes;
            for (const auto& parameters : task.parameters) {
              const auto outcome = engine.run(parameters, way);
              outcomes.push_back(outcome.way_m);
              simulated += outcome.simulated_s;
            }
            return outcomes;
          }};
}

/// The cheapest of `steps` that is within 5 % of `converged`.
Rival cheapest(Rival converged, std::vector<Rival> steps) {
  double simulated = 0;
  const auto reference = converged.run(simulated);
  Rival best = std::move(converged);
  best.deviation = 0;
  for (const double outcome : reference) best.outcome += outcome / static_cast<double>(reference.size());
  for (Rival& rival : steps) {
    simulated = 0;
    const double begin = cpuSeconds();
    const auto outcomes = rival.run(simulated);
    rival.cpu = (cpuSeconds() - begin) / simulated;
    for (const double outcome : outcomes) rival.outcome += outcome / static_cast<double>(outcomes.size());
    rival.deviation = deviationOf(outcomes, reference).median;
    std::printf("    %-22s %-16s %8.2f ms/s, off by %.1f%%\n", rival.name.c_str(), rival.step.c_str(), 1e3 * rival.cpu,
                1e2 * rival.deviation);
    if (rival.deviation <= 0.05 && rival.cpu < best.cpu) best = rival;
  }
  best.cpu = 1e9;
  return best;
}

void compare(const BenchTask& task, int repeats) {
  MujocoEngine engine(task);
  const bool ball = !task.scene.balls.empty();
  std::printf("%s\n", task.name.c_str());
  std::vector<Rival> rivals;
  for (const bool own : {true, false}) {
    std::vector<Rival> steps;
    for (const double step : {0.008, 0.004, 0.002, 0.001, 0.0005})
      for (const int near : {1, 4, 8})
        if (near == 1 || (ball && step / near >= 0.00049 && step / near <= 0.0011))
          steps.push_back(ours(task, step, near, own));
    rivals.push_back(cheapest(ours(task, 0.00025, 1, own), std::move(steps)));
  }
  for (const bool implicit : {false, true}) {
    const std::string name = implicit ? "MuJoCo tuned" : "MuJoCo explicit";
    std::vector<Rival> steps;
    for (const double step : {0.008, 0.004, 0.002, 0.001, 0.0005})
      for (const double near : {0.0, 0.001, 0.0005})
        if (near == 0 || (implicit && ball && near < step))
          steps.push_back(theirs(task, engine, {name, implicit, step, near}));
    rivals.push_back(cheapest(theirs(task, engine, {name, implicit, 0.00025, 0}), std::move(steps)));
  }
  // Interleaved, so that all see the same machine.
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (Rival& rival : rivals) {
      double simulated = 0;
      const double begin = cpuSeconds();
      rival.run(simulated);
      rival.cpu = std::min(rival.cpu, (cpuSeconds() - begin) / simulated);
    }
  std::printf("\n  %-22s %-16s %16s %10s %12s %8s\n", "engine", "step", "CPU ms per sim s", "times ours", "outcome m",
              "off by");
  for (const Rival& rival : rivals)
    std::printf("  %-22s %-16s %16.2f %10.2f %12.3f %7.1f%%\n", rival.name.c_str(), rival.step.c_str(), 1e3 * rival.cpu,
                rival.cpu / rivals[0].cpu, rival.outcome, 1e2 * rival.deviation);
  std::printf("\n");
}

}  // namespace
}  // namespace btr::bench

int main() {
  const btr::PluginHost host(PLUGIN_DIR);
  const auto kick = host.controller("kick");
  const auto kickScene = btr::loadScene(SOURCE_DIR "/resources/scenes/kick.json");
  const auto walkScene = btr::loadScene(SOURCE_DIR "/resources/scenes/walk.json");
  btr::bench::compare(btr::walkTask(walkScene, btr::loadModels(walkScene)), 8);
  btr::bench::compare(btr::kickTask(kickScene, btr::loadModels(kickScene), *kick), 8);
}
