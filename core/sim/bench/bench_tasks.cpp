// What `btr bench` measures.
#include "core/sim/bench/bench.h"
#include "core/sim/trot.h"
#include "core/spec/error.h"

namespace btr {
namespace {

// The ten kicks that a run of resources/experiments/kick-short.json (seed 1) had measured after its first 50
// generations: accumulation and release of LF, RF, LR, RR (three joints each), then the number of points.
constexpr double kicks[][25] = {
    {1.377, 0.476, 1.675, -0.898, 0.665, -0.364, 0.586,  0.69,  1.513, -1.053, 0.7,   1.776, -0.477,
     0.292, 1.891, 0.001, -0.082, 1.142, -0.251, -0.027, 1.175, 0.776, 0.55,   0.525, 11},
    {1.365, 0.476, 1.675, -0.898, 0.665,  -0.364, 0.586,  0.69,  1.546, -0.777, 0.7,   1.776, -0.477,
     0.258, 1.891, -0.09, -0.073, -0.012, -0.061, -0.023, 1.175, 0.491, 0.546,  0.459, 11},
    {1.411, 0.745, 1.629, -0.898, 0.665, -0.003, 0.724,  0.669, 1.842,  0.525, 0.697, 1.299, 0.979,
     0.829, 1.891, -0.09, -0.082, 1.142, -0.251, -0.057, 0.912, -0.053, 0.7,   0.558, 13},
    {1.365, 0.468, 1.665, -0.898, 0.858, -0.292, 0.707,  0.478, 1.859,  0.534, 0.69,  1.332, -0.477,
     0.833, 1.891, -0.09, -0.149, 1.142, -0.268, -0.057, 0.879, -0.061, 0.7,   0.566, 11},
    {1.365, 0.476, 1.819, -0.807, 0.724, -0.292, 0.724,  0.424,  1.875, 0.948, 0.697, 0.492, -0.545,
     0.292, 1.891, -0.09, -0.082, 1.287, -0.303, -0.027, -0.175, 0.051, 0.577, 1.579, 11},
    {1.411, 0.476, 1.629,  -0.898, 0.665,  -0.364, 0.586,  0.669, 1.842,  0.534, 0.7,   1.266, -0.841,
     0.833, 1.891, -0.727, -0.09,  -0.012, -0.061, -0.057, 0.912, -0.053, 0.697, 0.558, 13},
    {1.309, 0.468, 1.684,  -0.898, 0.665, -0.292, 0.965,  0.424, 1.875, 0.672, 0.697, 1.513, -0.295,
     0.292, 1.891, -0.704, 0.12,   1.142, -0.303, -0.013, 0.064, 0.603, 0.434, 0.467, 20},
    {1.365, 0.493, 1.684, -0.898, 0.724, -0.292, 0.698,  0.478,  1.859, 0.534, 0.669, 1.249, -0.545,
     0.258, 1.891, -0.09, -0.082, 1.287, 0.802,  -0.027, -0.175, 0.051, 0.577, 1.579, 11},
    {1.434, 0.476, 1.792, -0.898, 0.732, -0.292, 0.724,  0.396, 1.842, 0.534, 0.697,  1.332, -0.477,
     0.833, 1.891, -0.09, -0.082, 1.142, -0.924, -0.034, 1.175, 0.905, 0.11,  -0.134, 8},
    {1.365, 0.468, 1.665, -0.898, 0.858, -0.292, 0.707,  0.478, 1.859, 0.534, 0.7,   1.249, -0.477,
     0.292, 1.891, -0.09, -0.082, 1.287, -0.268, -0.027, 0.879, 0.051, 0.577, 0.525, 11},
};

Scene sceneOf(const SceneSpec& spec, const ModelSet& models) {
  // The simulator that experiments begin with.
  SimulatorSpec simulator;
  for (const auto& parameter : simulatorParameters()) simulator.values[parameter.name] = parameter.byDefault;
  return makeScene(spec, models, simulator, [](const std::string& name) -> std::shared_ptr<const Effect> {
    throw InputError("bench: effect " + name + " is not part of a measurement");
  });
}

}  // namespace

BenchTask kickTask(const SceneSpec& kickScene, const ModelSet& models, const Controller& kick) {
  BenchTask task{.name = "kick", .scene = sceneOf(kickScene, models), .controller = &kick};
  task.settings = {{"distance_m", 0.14},  {"bearing_rad", 0}, {"direction_rad", 0},
                   {"accumulate_s", 0.3}, {"hold_s", 0.05},   {"return_s", 0.3}};
  for (const auto& parameters : kicks) task.parameters.emplace_back(std::begin(parameters), std::end(parameters));
  kick.arrange(task.scene, task.settings);
  return task;
}

BenchTask walkTask(const SceneSpec& walkScene, const ModelSet& models) {
  static const Trot trot;
  BenchTask task{.name = "walk", .scene = sceneOf(walkScene, models), .controller = &trot};
  task.settings = {{"duration_s", 10}};
  task.parameters.emplace_back();
  trot.arrange(task.scene, task.settings);
  return task;
}

}  // namespace btr
