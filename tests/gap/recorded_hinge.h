#pragma once
// Recordings of a hinge with a servo that are made here, so that what is missing is known.
#include <gtest/gtest.h>

#include <cmath>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/start_state.h"
#include "core/gap/search/analysis.h"
#include "core/spec/random.h"
#include "tests/gap/scene_of.h"
#include "tests/plugin/built_plugins.h"

namespace btr {

using test::host;
inline EffectLibrary library() { return {host().effectFactory(), host().effects()}; }

/// The rig's hinge with a servo; p and d are what the user does not trust. The rail stays where it is.
inline SceneSpec hingeScene() {
  const TemporaryFolder folder;
  folder.write("rig.urdf", rigUrdf);
  return sceneFromJson(R"({"format": "uchilsim-scene-1", "step_s": 0.001, "control_period_s": 0.01, "robots": [
    {"name": "rig", "model": "rig.urdf", "base": "fixed", "position_m": [0, 0, 1], "collision": "none", "servos": {
      "hinge": {"p": 6, "d": 0.3, "max_torque_nm": 3}, "rail": {"drive": "none"}}}],
    "calibrate": [{"path": "robots.rig.servos.hinge.p", "min": 3, "max": 12},
                  {"path": "robots.rig.servos.hinge.d", "min": 0.1, "max": 0.9}]})",
                       "scene", folder.file("."));
}

/// The hinge with its model, without recordings.
inline GapProblem hingeProblem() {
  GapProblem problem;
  problem.scene = hingeScene();
  const TemporaryFolder folder;
  folder.write("rig.urdf", rigUrdf);
  SceneSpec spec = problem.scene;
  spec.directory = folder.file(".");
  problem.models = loadModels(spec);
  return problem;
}

inline constexpr double noise_rad = 0.0005;

/// What a robot that is `truth` records: sines of drawn frequencies, steps, every 5 ms, white noise. The hinge moves
/// from the beginning at `startRate_rad_s`. Reality takes steps of `step_s`.
inline GapProblem recordedFrom(const SimulatorSpec& truth, double size_rad = 0.6, double startRate_rad_s = 0,
                               const EffectLibrary& effects = library(), double step_s = 0.0001, double length_s = 3) {
  GapProblem problem = hingeProblem();
  SceneSpec spec = problem.scene;
  spec.step_s = step_s;
  const Scene scene = makeScene(spec, problem.models, truth, effects.make);
  for (std::uint64_t trial = 0; trial < 3; ++trial) {
    Random random = Random::forPurpose(5, "trial", trial);
    const double f1 = random.uniform(0.3, 0.7), f2 = random.uniform(1, 2.5), phase = random.uniform(0, 6);
    Recording recording;
    recording.source = "trial_" + std::to_string(trial) + ".csv";
    recording.channels = {"time_s", "rig.hinge.command_rad", "rig.hinge.position_rad"};
    recording.columns.resize(3);
    for (double t = 0; t < length_s; t += 0.005) {
      const double held = std::floor(t / 0.01) * 0.01;
      const double step = held > 2.5 && held < 3.3 ? 0.3 : 0;
      recording.columns[0].push_back(t);
      recording.columns[1].push_back(held < 0.3 ? 0
                                                : size_rad * (0.6 * std::sin(2 * M_PI * f1 * (held - 0.3)) + step +
                                                              0.25 * (std::sin(2 * M_PI * f2 * held + phase) -
                                                                      std::sin(2 * M_PI * f2 * 0.3 + phase))));
      recording.columns[2].push_back(0);
    }
    const Binding binding = bind(scene, recording);
    StartState start = startState(scene, recording, binding);
    start.robots[0].rates[binding.measured[0].part] = startRate_rad_s;
    const auto replayed = replayRecording(scene, recording, binding, start);
    EXPECT_EQ(replayed.fault, "");
    for (std::size_t row = 0; row < recording.rows(); ++row)
      recording.columns[2][row] = replayed.values[0][row] + noise_rad * random.normal();
    problem.recordings.push_back(recording);
  }
  return problem;
}

/// Two thirds of that in the scene's own steps, a fifteenth of the work: where the test does not ask for a verdict.
inline GapProblem recordedInItsSteps(const SimulatorSpec& truth = {}) {
  return recordedFrom(truth, 0.6, 0, library(), hingeScene().step_s, 2);
}

}  // namespace btr
