// What `btr bench` measures.
#include "core/sim/bench.h"
#include "core/sim/trot.h"
#include "core/spec/error.h"

namespace btr {
namespace {

// Kicks with the left foreleg at a ball that lies 14 cm from the neck, to the left: accumulation and release of LF, RF,
// LR, RR (three joints each), then the number of points. They were taken from 400 drawn at random about one good kick:
// the ones that send the ball further than 0.4 m and whose way is the same within 3 % at 0.25, 0.5 and 1 ms. (Most of
// the others hit at a glance: a tenth of a millimetre decides where the ball goes, and no step is small enough.)
constexpr double kicks[][25] = {
    {-0.006, 0.25, 1.849,  -0.184, -0.019, 1.335,  -0.36, 0.006, 1.609,  -0.376, 0.05,  1.637, 0.738,
     0.029,  1.43, -0.242, 0.013,  1.385,  -0.398, 0.021, 1.584, -0.352, 0.042,  1.573, 5},
    {-0.845, 0.248, 1.462,  -0.223, 0.016, 1.363,  -0.332, 0.037, 1.632,  -0.336, -0.02, 1.597, 1.663,
     0.121,  0.832, -0.232, 0.02,   1.393, -0.386, 0.042,  1.656, -0.393, 0.006,  1.628, 10},
    {-0.431, 0.242, 1.319,  -0.277, -0.024, 1.389,  -0.418, 0.06,  1.576,  -0.405, 0.04,  1.63, 1.628,
     0.209,  0.603, -0.217, 0.044,  1.351,  -0.403, 0.034,  1.603, -0.411, 0.043,  1.591, 11},
    {-0.741, 0.268, 1.376,  -0.263, 0.016, 1.315,  -0.344, -0.022, 1.658,  -0.333, 0.041, 1.569, 1.768,
     -0.079, 0.287, -0.238, 0.042,  1.355, -0.354, -0.029, 1.632,  -0.379, 0.019,  1.585, 6},
    {-0.467, 0.257, 1.37,   -0.256, -0.017, 1.31,   -0.336, -0.033, 1.631,  -0.39, 0.041, 1.632, 1.605,
     0.29,   1.292, -0.226, 0.015,  1.34,   -0.356, -0.025, 1.648,  -0.408, 0.043, 1.641, 8},
    {-0.562, 0.237,  1.201, -0.232, -0.033, 1.377,  -0.372, 0.059, 1.578, -0.348, -0.005, 1.576, 0.81,
     0.162,  -0.073, -0.2,  0.048,  1.384,  -0.417, 0.05,   1.562, -0.33, 0.03,   1.639,  5},
    {-0.422, 0.333, 1.415, -0.257, 0.044, 1.361,  -0.359, 0.001, 1.589,  -0.356, -0.02, 1.57, 0.751,
     0.031,  0.99,  -0.24, 0.003,  1.339, -0.339, 0.015,  1.622, -0.405, 0.031,  1.569, 2},
    {-0.359, 0.374, 1.527,  -0.264, 0.06,  1.383,  -0.39, -0.022, 1.617,  -0.399, 0.035, 1.65, 1.835,
     -0.043, 1.487, -0.276, -0.014, 1.324, -0.337, 0.041, 1.655,  -0.399, -0.009, 1.619, 3},
    {-0.619, 0.346, 1.526,  -0.272, 0.058, 1.388,  -0.395, 0.006, 1.588,  -0.345, 0.013, 1.615, 1.84,
     0.125,  1.268, -0.245, -0.033, 1.318, -0.417, 0.022,  1.647, -0.358, 0.039,  1.645, 10},
    {-0.03, -0.024, 1.88, -0.209, -0.021, 1.351,  -0.33, 0.052, 1.619,  -0.36,  0.008, 1.577, 1.233,
     -0.08, 0.07,   -0.2, 0.027,  1.319,  -0.345, 0.018, 1.617, -0.329, -0.028, 1.613, 6},
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
  task.settings = {{"distance_m", 0.14}, {"bearing_rad", 0.4}};
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
