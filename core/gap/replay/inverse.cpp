#include "core/gap/replay/inverse.h"

#include <cmath>
#include <filesystem>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/lowpass.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/recordings/resample.h"
#include "core/gap/replay/inverse_text.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/residual.h"
#include "core/gap/replay/residual_parts.h"
#include "core/gap/replay/start_state.h"
#include "core/gap/replay/trial_scenes.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace {

/// The torque's filter where every n-th sample is kept: steep, nothing left of what thinning would fold.
constexpr int torqueOrder = 8;
/// So many compared samples at either end are left out, which both filters know too little of.
constexpr int ends = 10;

/// The scene with every joint whose position was recorded moved by it.
Scene prescribed(Scene scene, const Recording& recording) {
  for (SceneRobot& robot : scene.robots)
    for (std::size_t joint = 0; joint < robot.drives.size(); ++joint) {
      const std::string name = robot.name + "." + robot.model.joints[joint].name;
      if (recording.column(name + ".position_rad") >= 0 || recording.column(name + ".position_m") >= 0)
        robot.drives[joint].kind = Drive::Kind::motion;
    }
  return scene;
}

/// Filtered and thinned, without the ends.
std::vector<double> thinned(const std::vector<double>& values, double rate_hz, int every) {
  if (every == 1) return values;
  const std::vector<double> smooth =
      LowPass(torqueOrder, 0.45 * rate_hz / static_cast<double>(every), rate_hz).zeroPhase(values);
  std::vector<double> kept;
  const auto step = static_cast<std::size_t>(every);
  for (std::size_t i = ends * step; i + ends * step < smooth.size(); i += step) kept.push_back(smooth[i]);
  return kept;
}

void addRecording(const Scene& given, const Recording& raw, const InverseOptions& options, InverseReport& report,
                  const std::function<bool()>& goesOn) {
  const double rate = 1 / rhythm(raw);
  if (!(options.lowpass_hz > 0) || options.lowpass_hz >= rate / 2)
    throw InputError(raw.source + " --lowpass", toText(options.lowpass_hz),
                     "more than 0 and less than half the sampling rate of " + toText(rate) + " Hz");
  if (options.every < 1 || raw.rows() < 4 * ends * static_cast<std::size_t>(options.every))
    throw InputError(raw.source + " --every", std::to_string(options.every),
                     "1 to a fortieth of the " + std::to_string(raw.rows()) + " rows");
  Recording recording = resampled(raw, {});
  recording.filterCutoff_hz = 0;  // both torques are filtered below, whatever filter there was before
  const Scene scene = prescribed(given, recording);
  const Binding binding = bind(scene, recording);
  const LowPass filter(4, options.lowpass_hz, rate);
  bool any = false;
  for (const Binding::Input& input : binding.inputs) {
    if (input.what != Binding::Input::What::motion) continue;
    std::vector<double>& path = recording.columns[input.column];
    if (!std::isfinite(path[0]))
      throw InputError(raw.source, "no value of " + recording.channels[input.column], "some");
    path = filter.zeroPhase(path);
  }
  const ReplayedRecording replayed =
      replayRecording(scene, recording, binding, startState(scene, recording, binding), 0, recording.rows(), goesOn);
  const std::string name = std::filesystem::path(raw.source).filename().string();
  if (!replayed.fault.empty()) throw InputError(raw.source + ": the motion cannot be followed: " + replayed.fault);

  for (std::size_t i = 0; i < binding.measured.size(); ++i) {
    const Binding::Measured& measured = binding.measured[i];
    if (measured.what != Binding::Measured::What::torque ||
        scene.robots[measured.object].drives[measured.part].kind != Drive::Kind::motion)
      continue;
    any = true;
    InverseError joint;
    joint.error.recording = raw.source;
    joint.error.channel = recording.channels[measured.column];
    joint.error.recorded = thinned(recording.columns[measured.column], rate, options.every);
    joint.error.simulated = thinned(replayed.values[i], rate, options.every);
    const double offset = options.every == 1 ? 0 : ends * options.every;
    for (std::size_t k = 0; k < joint.error.recorded.size(); ++k)
      joint.error.time_s.push_back(recording.columns[0][0] + (offset + static_cast<double>(k) * options.every) / rate);
    fillErrors(joint.error, {});
    double squares = 0;
    for (const double value : joint.error.recorded) squares += value * value;
    joint.rootMeanSquare_recorded = std::sqrt(squares / static_cast<double>(joint.error.recorded.size()));
    if (joint.rootMeanSquare_recorded > 0)
      joint.relative = 100 * joint.error.rootMeanSquare / joint.rootMeanSquare_recorded;
    report.joints.push_back(std::move(joint));
  }
  if (!any)
    throw InputError(raw.source +
                     ": no joint has a position and a torque_nm or force_n column; inverse scoring compares "
                     "the torque that a motion takes");
}

}  // namespace

InverseReport inverse(const Scene& scene, const std::vector<Recording>& recordings, const InverseOptions& options) {
  InverseReport report;
  for (const Recording& recording : recordings) addRecording(scene, recording, options, report, {});
  return report;
}

InverseReport runInverse(const ResidualRequest& request, const EffectFactory& effects, const InverseOptions& options,
                         const std::function<bool(std::size_t, std::size_t)>& progress) {
  InverseReport report;
  const bool all = forEachTrial(request, progress, report.notes,
                                [&](const TrialScenes& scenes, const Recording& trial, const auto& goesOn) {
                                  addRecording(scenes.of(trial, effects), trial, options, report, goesOn);
                                });
  if (!all) return report;
  if (progress && !progress(request.recordings.size(), request.recordings.size())) return report;

  if (!request.out.empty()) {
    std::vector<ChannelError> channels;
    for (const InverseError& joint : report.joints) channels.push_back(joint.error);
    writeOverlays(request.out, channels);
    const std::filesystem::path folder(request.out);
    writeFile((folder / "inverse.json").string(), toJsonText(report));
    writeFile((folder / "inverse.txt").string(), inverseTable(report));
  }
  return report;
}

}  // namespace btr
