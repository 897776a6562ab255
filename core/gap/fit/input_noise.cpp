#include "core/gap/fit/input_noise.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/gap/recordings/channel_floor.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/lowpass.h"
#include "core/gap/recordings/resample.h"
#include "core/gap/recordings/squares.h"
#include "core/gap/replay/followed_torques.h"
#include "core/gap/replay/replay.h"
#include "core/spec/figures.h"
#include "core/spec/random.h"

namespace btr {
namespace {

using Input = Binding::Input;
using Measured = Binding::Measured;

/// Columns of the positions that joints are made to follow.
std::vector<std::size_t> followed(const FitTrial& trial) {
  std::vector<std::size_t> columns;
  for (const Input& input : trial.binding.inputs)
    if (input.what == Input::What::motion) columns.push_back(input.column);
  return columns;
}

bool followsMotion(const FitTrial& trial) { return !followed(trial).empty(); }

bool isDrivenByTorques(const FitTrial& trial) {
  return std::ranges::any_of(trial.binding.inputs, &Input::isMeasuredTorque);
}

/// Columns of inputs that a sensor told.
std::vector<std::size_t> recordedInputs(const FitTrial& trial) {
  std::vector<std::size_t> columns = followed(trial);
  for (const Input& input : trial.binding.inputs)
    if (input.isMeasuredTorque) columns.push_back(input.column);
  return columns;
}

/// Whether a channel is compared and has noise of recorded inputs in it.
bool hasInputNoise(const FitTrial& trial, std::size_t channel) {
  if (!(trial.noiseFloor[channel] > 0)) return false;
  return isDrivenByTorques(trial) || trial.binding.measured[channel].what == Measured::What::torque;
}

/// What noise of recorded inputs makes of what is compared, by channel.
using Spreads = std::map<std::string, Squares>;

void addSpread(const FitProblem& problem, const Segment& segment, const Recording& noisy, Spreads& spreads) {
  const FitTrial& trial = problem.trials[segment.trial];
  const Scene scene = problem.sceneOf(problem.given, segment.trial);
  const auto replayed = [&](const Recording& recording) {
    return replayRecording(scene, recording, trial.binding, segment.start, segment.first, segment.last);
  };
  const ReplayedRecording once = replayed(trial.recording), again = replayed(noisy);
  for (std::size_t channel = 0; channel < trial.binding.measured.size(); ++channel) {
    if (!hasInputNoise(trial, channel)) continue;
    const std::size_t column = trial.binding.measured[channel].column;
    Squares& spread = spreads[trial.recording.channels[column]];
    for (std::size_t row = segment.scored; row < segment.last; ++row) {
      if (!std::isfinite(trial.recording.columns[column][row])) continue;
      const double difference = again.values[channel][row] - once.values[channel][row];
      if (std::isfinite(difference)) spread.add(difference);
    }
  }
}

/// Channels of whose floors that noise is most.
struct MostlyNoise {
  std::string channels, spreads, floors;

  void add(const std::string& channel, double spread, double floor) {
    const std::string unit = " " + unitOfChannel(channel), next = channels.empty() ? "" : ", ";
    channels += next + channel;
    spreads += next + digits(spread, 2) + unit;
    floors += next + digits(floor, 2);
  }
  std::string text(const std::string& inputs) const {
    const bool several = channels.find(',') != std::string::npos;
    return channels + ": the noise of the recorded " + inputs + ", adds " + spreads +
           (several ? " to floors of " : " to a floor of ") + floors;
  }
};

/// The lowest cutoff that takes nothing but noise from the motions, 0 if each takes more, or none is needed.
double cutoffForNoiseAlone(const FitProblem& problem) {
  constexpr double noiseAlone = 1.15;  // of what the positions' noise is worth
  const auto takesNoiseAlone = [&](const FitTrial& trial, double cutoff_hz) {
    const double period_s = rhythm(trial.recording);
    if (!(period_s > 0) || cutoff_hz >= 0.4 / period_s) return false;
    const auto ends = static_cast<std::size_t>(2 / cutoff_hz / period_s);
    return std::ranges::all_of(followed(trial), [&](std::size_t column) {
      const std::vector<double>& path = trial.recording.columns[column];
      if (path.size() < 4 * ends || !std::ranges::all_of(path, [](double x) { return std::isfinite(x); })) return false;
      const std::vector<double> smooth = LowPass(4, cutoff_hz, 1 / period_s).zeroPhase(path);
      Squares taken;
      for (std::size_t row = ends; row + ends < path.size(); ++row) taken.add(path[row] - smooth[row]);
      return taken.rms() < noiseAlone * channelFloor(trial.recording, column).level;
    });
  };
  for (const double cutoff_hz : {1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 50.0, 100.0})
    if (std::ranges::all_of(problem.trials, [&](const FitTrial& trial) { return takesNoiseAlone(trial, cutoff_hz); }))
      return cutoff_hz;
  return 0;
}

std::string remedy(const FitProblem& problem) {
  const bool filtered =
      std::ranges::any_of(problem.trials, [](const FitTrial& trial) { return trial.recording.filterCutoff_hz > 0; });
  if (filtered) return "";
  const double cutoff_hz = cutoffForNoiseAlone(problem);
  if (!(cutoff_hz > 0)) return "";
  return "; a mapping with \"resample\": {\"lowpass_hz\": " + toText(cutoff_hz) +
         "} filters both, and takes nothing but noise from these motions";
}

constexpr const char* remedyUnderTorques =
    "; let the joints follow the recorded motion, \"drive\": \"motion\" in the scene, and torques are compared; or, if "
    "the torques are exact, name them command_nm (on a slide joint command_n)";

}  // namespace

bool prepareFilteredMotions(FitProblem& problem, bool whole) {
  constexpr double periods = 3;  // of the lowest cutoff: a kink of 1 is 1e-4 then
  bool prepared = false;
  std::set<std::string> said;
  for (FitTrial& trial : problem.trials) {
    Recording& recording = trial.recording;
    if (!(recording.filterCutoff_hz > 0) || !followsMotion(trial)) continue;
    const std::vector<double>& time = recording.columns[0];
    prepared = true;
    const double lowest_hz = recording.filterCutoff_hz / (whole ? 2 : 1);
    const double end_s = std::min(periods / lowest_hz, (time.back() - time.front()) / 4);
    if (whole) filterFollowedTorques(recording, trial.binding);
    for (const std::size_t torque : followedTorques(trial.binding)) {
      const Measured& measured = trial.binding.measured[torque];
      for (std::size_t row = 0; row < time.size(); ++row)
        if (time[row] < time.front() + end_s || time[row] > time.back() - end_s)
          recording.columns[measured.column][row] = NAN;
    }
    const std::string text =
        "torques in the first and last " + digits(end_s, 2) +
        " s of a trial are not compared: the filter of the motion knows nothing of what was before "
        "and after";
    if (said.insert(text).second) problem.notes.push_back(text);
  }
  return prepared;
}

void addInputNoise(FitProblem& problem) {
  constexpr std::uint64_t seed = 1;
  constexpr double most = 3;  // times the floor without it: then it is nearly all of it
  if (std::ranges::all_of(problem.trials, [](const FitTrial& trial) { return recordedInputs(trial).empty(); })) return;
  std::vector<Recording> noisy;
  for (std::size_t t = 0; t < problem.trials.size(); ++t) {
    noisy.push_back(problem.trials[t].recording);
    for (const std::size_t column : recordedInputs(problem.trials[t])) {
      Random random = Random::forPurpose(seed, "noise of a followed motion", t * 1000 + column);
      const std::vector<double> noise = noiseDrawn(problem.trials[t].recording, column, random);
      for (std::size_t row = 0; row < noise.size(); ++row) noisy.back().columns[column][row] += noise[row];
    }
  }
  Spreads spreads;
  for (const Segment& segment : problem.segments) addSpread(problem, segment, noisy[segment.trial], spreads);

  std::set<std::string> mostly;
  std::map<bool, MostlyNoise> told;  // by whether torques are compared
  for (FitTrial& trial : problem.trials)
    for (std::size_t channel = 0; channel < trial.binding.measured.size(); ++channel) {
      if (!hasInputNoise(trial, channel)) continue;
      const Measured& measured = trial.binding.measured[channel];
      const bool isTorque = measured.what == Measured::What::torque;
      const std::string& name = trial.recording.channels[measured.column];
      const double ofInputs = spreads[name].rms();
      if (ofInputs > most * trial.noiseFloor[channel] && mostly.insert(name).second) {
        problem.noisyTorques = problem.noisyTorques || !isTorque;
        told[isTorque].add(name, ofInputs, trial.noiseFloor[channel]);
      }
      trial.noiseFloor[channel] = std::hypot(trial.noiseFloor[channel], ofInputs);
      for (double& floor : trial.sampleFloor[channel]) floor = std::hypot(floor, ofInputs);
    }
  if (!told[true].channels.empty())
    problem.notes.push_back(told[true].text("positions, which the motion is made of") + remedy(problem));
  if (!told[false].channels.empty())
    problem.notes.push_back(told[false].text("torques, which drive the joints") + remedyUnderTorques);
}

}  // namespace btr
