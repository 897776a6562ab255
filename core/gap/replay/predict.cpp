#include "core/gap/replay/predict.h"

#include <cmath>
#include <filesystem>
#include <limits>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/number_table.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/start_state.h"
#include "core/gap/replay/trial_scenes.h"
#include "core/sim/model_losses.h"
#include "core/sim/world/scene_build.h"
#include "core/spec/json_reader.h"
#include "core/spec/system/output_path.h"

namespace btr {
namespace {

/// What a recording of everything in the scene would be called.
std::vector<std::string> channelsOf(const Scene& scene) {
  std::vector<std::string> names;
  for (std::size_t r = 0; r < scene.robots.size(); ++r) {
    const SceneRobot& robot = scene.robots[r];
    for (std::size_t j = 0; j < robot.model.joints.size(); ++j) {
      const Joint& joint = robot.model.joints[j];
      // What is moved by the recording itself is no prediction.
      if (joint.type == Joint::Type::fixed || robot.drives[j].kind == Drive::Kind::motion) continue;
      names.push_back(robot.name + "." + joint.name +
                      (joint.type == Joint::Type::slide ? ".position_m" : ".position_rad"));
    }
    if (robot.freeBase)
      for (const char* quantity : {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"})
        names.push_back(robot.name + ".base." + quantity);
  }
  for (const BallSpec& ball : scene.balls)
    for (const char* quantity : {"x_m", "y_m", "z_m"}) names.push_back(ball.name + "." + quantity);
  return names;
}

}  // namespace

Recording predict(const Scene& scene, const Recording& recording, const std::function<bool()>& goesOn,
                  const std::optional<StartState>& start) {
  Recording whole = recording;
  for (const std::string& name : channelsOf(scene)) {
    if (whole.column(name) >= 0) continue;
    whole.channels.push_back(name);
    whole.columns.emplace_back(whole.rows(), std::numeric_limits<double>::quiet_NaN());
  }
  const Binding binding = bind(scene, whole);
  const ReplayedRecording replayed = replayRecording(
      scene, whole, binding, start ? *start : startState(scene, whole, binding), 0, whole.rows(), goesOn);

  Recording predicted;
  predicted.source = recording.source;
  predicted.notes = binding.notes;
  if (!replayed.fault.empty()) predicted.notes.push_back("the simulation was ended: " + replayed.fault);
  const auto add = [&](std::size_t column, const std::vector<double>& values) {
    predicted.channels.push_back(whole.channels[column]);
    predicted.columns.push_back(values);
  };
  add(0, whole.columns[0]);
  for (const Binding::Input& input : binding.inputs) add(input.column, whole.columns[input.column]);
  for (std::size_t i = 0; i < binding.measured.size(); ++i)
    if (predicted.column(whole.channels[binding.measured[i].column]) < 0)
      add(binding.measured[i].column, replayed.values[i]);
  return predicted;
}

std::vector<Recording> runPredict(const PredictRequest& request, const EffectFactory& effects,
                                  const std::function<bool()>& goesOn) {
  const TrialScenes scenes = loadTrialScenes(request.scene, request.simulator);
  std::vector<Recording> trials = loadTrialsFor(request.recording, request.mapping, request.scene);
  scenes.prepare(trials);
  const std::vector<std::string> inputs =
      withNamedFiles({request.scene, request.simulator, request.recording, request.mapping});
  const std::vector<std::string> losses = modelLosses(scenes.spec, scenes.models);
  std::vector<Recording> written;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    std::filesystem::path out(request.out);
    if (trials.size() > 1)
      out.replace_filename(out.stem().string() + "-" + std::to_string(i + 1) + out.extension().string());
    checkOutputFile(out.string(), inputs);
    const auto start = request.start ? request.start(scenes, effects, trials[i], goesOn) : std::nullopt;
    written.push_back(predict(scenes.of(trials[i], effects), trials[i], goesOn, start));
    written.back().source = out.string();
    written.back().notes.insert(written.back().notes.begin(), losses.begin(), losses.end());
  }
  for (const Recording& predicted : written)
    writeFile(predicted.source, toCsv(NumberTable{predicted.channels, predicted.columns}));
  return written;
}

}  // namespace btr
