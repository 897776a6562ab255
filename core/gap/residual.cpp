#include "core/gap/residual.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/gap/doctor.h"
#include "core/gap/noise_floor.h"
#include "core/gap/replay.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

ChannelError compare(const Recording& recording, std::size_t column, const std::vector<double>& simulated,
                     const std::vector<double>& finer) {
  ChannelError error;
  error.recording = recording.source;
  error.channel = recording.channels[column];
  error.time_s = recording.columns[0];
  error.recorded = recording.columns[column];
  error.simulated = simulated;
  error.resolution = resolution(error.recorded);
  double sum = 0, absolute = 0, squares = 0, steps = 0;
  for (std::size_t i = 0; i < simulated.size(); ++i) {
    const double difference = simulated[i] - error.recorded[i];
    if (!std::isfinite(difference)) continue;
    ++error.samples;
    sum += difference;
    absolute += std::abs(difference);
    squares += difference * difference;
    error.maximum = std::max(error.maximum, std::abs(difference));
    // The error of a first-order step is twice what halving it changes.
    if (std::isfinite(finer[i])) steps += 4 * (simulated[i] - finer[i]) * (simulated[i] - finer[i]);
  }
  if (error.samples > 0) {
    const auto count = static_cast<double>(error.samples);
    error.bias = sum / count;
    error.meanAbsolute = absolute / count;
    error.rootMeanSquare = std::sqrt(squares / count);
    error.stepError = std::sqrt(steps / count);
  }
  return error;
}

void addRecording(const Scene& scene, const Recording& recording, ResidualReport& report) {
  const std::string name = std::filesystem::path(recording.source).filename().string();
  const auto note = [&](const std::string& text) { report.notes.push_back(name + ": " + text); };
  for (const std::string& text : recording.notes) note(text);
  const RecordingHealth health = examine(recording);
  if (!health.gaps.empty()) note(health.findings.front());
  const Binding binding = bind(scene, recording);
  for (const std::string& text : binding.notes) note(text);
  for (const std::string& text : doctor(scene, recording, binding)) note(text);
  if (binding.measured.empty())
    throw InputError(recording.source +
                     ": no column can be compared with the scene; position, velocity, torque, base or "
                     "ball channels are needed");
  if (recording.rows() < 2) throw InputError(recording.source, "one row", "at least two rows for a replay");

  const StartState start = startState(scene, recording, binding);
  Scene finer = scene;
  finer.step_s /= 2;
  const ReplayedRecording replayed = replayRecording(scene, recording, binding, start);
  const ReplayedRecording check = replayRecording(finer, recording, binding, start);
  if (!replayed.fault.empty()) note("the simulation was ended: " + replayed.fault);

  for (std::size_t i = 0; i < binding.measured.size(); ++i) {
    ChannelError error = compare(recording, binding.measured[i].column, replayed.values[i], check.values[i]);
    if (error.stepError > error.resolution)
      note(error.channel + ": the integration's own error, " + toText(error.stepError) + " " +
           unitOfChannel(error.channel) + " at a step of " + toText(scene.step_s) +
           " s, is not below what the recording resolves, " + toText(error.resolution));
    report.channels.push_back(std::move(error));
  }
}

/// The same note of many recordings is said once: "first.csv and 11 more: text".
void joinNotes(std::vector<std::string>& notes) {
  std::vector<std::pair<std::string, std::vector<std::string>>> byText;
  for (const std::string& note : notes) {
    const std::size_t colon = note.find(": ");
    const std::string name = note.substr(0, colon), text = note.substr(colon);
    const auto known =
        std::find_if(byText.begin(), byText.end(), [&](const auto& entry) { return entry.first == text; });
    if (known == byText.end()) {
      byText.push_back({text, {name}});
    } else {
      known->second.push_back(name);
    }
  }
  notes.clear();
  for (const auto& [text, names] : byText)
    notes.push_back(names[0] + (names.size() > 1 ? " and " + std::to_string(names.size() - 1) + " more" : "") + text);
}

/// "DIR/sin_sin.leg.knee.position_rad.svg", a number added where two recordings have the same name.
std::string freeName(const ChannelError& error, std::set<std::string>& taken) {
  const std::string stem = std::filesystem::path(error.recording).stem().string() + "." + error.channel;
  std::string name = stem;
  for (int number = 2; !taken.insert(name).second; ++number) name = stem + "-" + std::to_string(number);
  return name + ".svg";
}

}  // namespace

ResidualReport residual(const Scene& scene, const std::vector<Recording>& recordings) {
  ResidualReport report;
  for (const Recording& recording : recordings) addRecording(scene, recording, report);
  joinNotes(report.notes);
  return report;
}

ResidualReport runResidual(const ResidualRequest& request, const EffectFactory& effects,
                           const std::function<bool(std::size_t, std::size_t)>& progress) {
  const SceneSpec spec = loadScene(request.scene);
  const ModelSet models = loadModels(spec);
  const SimulatorSpec simulator = request.simulator.empty() ? SimulatorSpec{} : loadSimulator(request.simulator);

  ResidualReport report;
  for (std::size_t i = 0; i < request.recordings.size(); ++i) {
    if (progress && !progress(i, request.recordings.size())) return report;
    for (const Recording& trial : loadTrialsFor(request.recordings[i], request.mapping, request.scene)) {
      // What is known of a trial goes before what was fitted.
      SimulatorSpec own = simulator;
      for (const auto& [path, value] : trial.settings) own.values[path] = value;
      addRecording(makeScene(spec, models, own, effects), trial, report);
    }
  }
  joinNotes(report.notes);
  if (progress && !progress(request.recordings.size(), request.recordings.size())) return report;

  if (!request.out.empty()) {
    const std::filesystem::path folder(request.out);
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (!std::filesystem::is_directory(folder)) throw InputError(request.out + ": the folder cannot be made");
    std::set<std::string> taken;
    for (const ChannelError& error : report.channels)
      writeFile((folder / freeName(error, taken)).string(), overlaySvg(error));
    writeFile((folder / "residual.json").string(), toJsonText(report));
    writeFile((folder / "residual.txt").string(), residualTable(report));
  }
  return report;
}

}  // namespace btr
