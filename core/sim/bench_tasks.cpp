// What `btr bench` measures.
#include "core/sim/bench.h"
#include "core/sim/trot.h"
#include "core/spec/error.h"

namespace btr {
namespace {

// Kicks with the left foreleg at a ball that lies 14 cm from the neck, to the left: accumulation and release of LF, RF,
// LR, RR (three joints each), then the number of points. The first ten of those drawn at random about a plain swing of
// the leg that send the ball further than 0.4 m.
constexpr double kicks[][25] = {
    {-0.081, 0.226, 1.371,  -0.205, -0.029, 1.312, -0.349, 0.011, 1.566,  -0.322, 0.051, 1.607, 1.385,
     0.112,  0.434, -0.211, -0.028, 1.39,   -0.36, 0.012,  1.651, -0.361, -0.022, 1.561, 4},
    {-0.953, 0.119,  1.452, -0.235, -0.038, 1.319,  -0.323, 0.023, 1.626,  -0.365, 0.026, 1.65, 1.262,
     -0.044, -0.256, -0.23, 0.022,  1.331,  -0.398, 0.029,  1.598, -0.399, 0.005,  1.592, 6},
    {0.219, 0.215, 1.435,  -0.196, 0.026, 1.31,   -0.342, 0.048, 1.658,  -0.401, -0.016, 1.64, 1.279,
     0.013, 0.472, -0.235, -0.028, 1.339, -0.375, 0.007,  1.65,  -0.408, -0.015, 1.617,  10},
    {-0.915, 0.305, 1.544,  -0.232, -0.038, 1.375, -0.321, 0.011, 1.586,  -0.375, -0.009, 1.637, 1.666,
     0.179,  1.428, -0.271, 0.032,  1.373,  -0.34, 0.006,  1.57,  -0.407, 0.012,  1.567,  12},
    {-0.497, 0.274, 1.287,  -0.213, 0.002, 1.371,  -0.405, -0.028, 1.63,   -0.325, -0.028, 1.654, 1.329,
     -0.023, 0.049, -0.203, -0.034, 1.312, -0.348, 0.043,  1.63,   -0.363, 0.046,  1.583,  9},
    {-0.937, -0.001, 1.328,  -0.199, 0.055, 1.337,  -0.417, -0.008, 1.602,  -0.417, 0.046, 1.607, 1.424,
     0.287,  0.811,  -0.262, -0.004, 1.356, -0.416, 0.009,  1.636,  -0.353, 0.023,  1.573, 6},
    {-0.778, 0.287, 1.604,  -0.223, 0.048, 1.373,  -0.326, -0.029, 1.638, -0.359, -0.029, 1.587, 1.062,
     0.034,  0.727, -0.252, -0.025, 1.351, -0.332, 0.016,  1.602,  -0.32, 0.008,  1.609,  12},
    {-0.358, 0.174, 1.47,   -0.205, 0.013, 1.338,  -0.353, -0.013, 1.61,   -0.396, 0.047, 1.621, 1.475,
     0.225,  0.961, -0.228, 0.054,  1.357, -0.419, -0.028, 1.621,  -0.374, -0.01,  1.588, 8},
    {-0.322, -0.004, 1.846,  -0.274, -0.022, 1.387,  -0.328, -0.001, 1.626,  -0.37, 0.048, 1.65, 1.718,
     -0.003, 1.214,  -0.275, 0.015,  1.351,  -0.322, -0.036, 1.652,  -0.413, 0.028, 1.566, 3},
    {-0.298, 0.194, 1.703,  -0.199, 0.031, 1.355,  -0.338, 0.016, 1.638,  -0.352, 0.057, 1.642, 1.523,
     0.122,  1.003, -0.229, 0.054,  1.395, -0.349, -0.002, 1.632, -0.388, -0.036, 1.595, 6},
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
