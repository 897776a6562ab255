#include "core/gap/replay/residual.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/channel_floor.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/doctor/doctor.h"
#include "core/gap/recordings/doctor/recording_health.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/followed_torques.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/residual_parts.h"
#include "core/gap/replay/residual_text.h"
#include "core/gap/replay/start_state.h"
#include "core/gap/replay/trial_scenes.h"
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
  fillErrors(error, finer);
  error.resolution = channelFloor(recording, column).level;
  return error;
}

/// `startOf` is asked once the recording is known to be one that can be replayed; nothing: its first samples.
void addRecording(const Scene& scene, const Recording& recording, bool asRecorded, ResidualReport& report,
                  const std::function<bool()>& goesOn, const std::function<std::optional<StartState>()>& startOf) {
  const std::string name = std::filesystem::path(recording.source).filename().string();
  const auto note = [&](const std::string& text) { report.notes.push_back(name + ": " + text); };
  for (const std::string& text : recording.notes) note(text);
  const Binding binding = bind(scene, recording);
  for (const std::string& text : binding.notes) note(text);
  for (const Finding& finding : doctor(scene, recording, binding).findings) {
    if (finding.certain && finding.channel == "time_s" && !asRecorded)
      throw InputError(recording.source + ": " + finding.text + "; --as-recorded replays it regardless");
    note(finding.text);
  }
  for (const std::string& text : examine(recording).findings) note(text);
  if (binding.measured.empty())
    throw InputError(recording.source +
                     ": no column can be compared with the scene; position, velocity, torque, base or "
                     "ball channels are needed");
  if (recording.rows() < 2) throw InputError(recording.source, "one row", "at least two rows for a replay");

  const std::optional<StartState> estimated = startOf ? startOf() : std::nullopt;
  const StartState start = estimated ? *estimated : startState(scene, recording, binding);
  Scene finer = scene;
  finer.step_s /= 2;
  std::optional<Recording> filtered;
  if (comparedBelow_hz(recording) > 0) filterFollowedTorques(filtered.emplace(recording), binding);
  const Recording& compared = filtered ? *filtered : recording;
  const ReplayedRecording replayed = replayRecording(scene, recording, binding, start, 0, recording.rows(), goesOn);
  const ReplayedRecording check = replayRecording(finer, recording, binding, start, 0, recording.rows(), goesOn);
  if (!replayed.fault.empty()) note("the simulation was ended: " + replayed.fault);

  for (std::size_t i = 0; i < binding.measured.size(); ++i) {
    ChannelError error = compare(compared, binding.measured[i].column, replayed.values[i], check.values[i]);
    if (error.stepError > error.resolution)
      note(error.channel + ": the integration's own error, " + toText(error.stepError) + " " +
           unitOfChannel(error.channel) + " at a step of " + toText(scene.step_s) +
           " s, is not below what the recording resolves, " + toText(error.resolution));
    report.channels.push_back(std::move(error));
  }
}

}  // namespace

ResidualReport residual(const Scene& scene, const std::vector<Recording>& recordings, bool asRecorded) {
  ResidualReport report;
  for (const Recording& recording : recordings) addRecording(scene, recording, asRecorded, report, {}, {});
  joinNotes(report.notes);
  return report;
}

ResidualReport runResidual(const ResidualRequest& request, const EffectFactory& effects,
                           const std::function<bool(std::size_t, std::size_t)>& progress) {
  ResidualReport report;
  std::vector<std::string> losses;
  const bool all = forEachTrial(
      request, progress, losses, [&](const TrialScenes& scenes, const Recording& trial, const auto& goesOn) {
        addRecording(scenes.of(trial, effects), trial, request.asRecorded, report, goesOn,
                     [&] { return request.start ? request.start(scenes, effects, trial, goesOn) : std::nullopt; });
      });
  if (!all) return report;
  joinNotes(report.notes);
  report.notes.insert(report.notes.begin(), losses.begin(), losses.end());
  if (progress && !progress(request.recordings.size(), request.recordings.size())) return report;

  if (!request.out.empty()) {
    const std::filesystem::path folder(request.out);
    writeOverlays(request.out, report.channels);
    writeFile((folder / "residual.json").string(), toJsonText(report));
    writeFile((folder / "residual.txt").string(), residualTable(report));
  }
  return report;
}

}  // namespace btr
