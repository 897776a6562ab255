#include "core/gap/fit_problem.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/gap/doctor.h"
#include "core/gap/noise_floor.h"
#include "core/spec/error.h"

namespace btr {
namespace {

using Measured = Binding::Measured;

/// The largest of a channel's levels that is still noise: fourth differences or counts, never below a millionth of what
/// the channel moves.
double floorOf(std::span<const double> values) {
  double low = INFINITY, high = -INFINITY;
  for (const double value : values)
    if (std::isfinite(value)) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  if (!(high >= low)) return 0;
  return std::max({resolution(values), 1e-6 * (high - low), 1e-9});
}

/// The same channel has the same noise in all trials: the median of theirs.
void shareNoiseFloors(std::vector<FitTrial>& trials) {
  std::map<std::string, std::vector<double>> levels;
  const auto nameOf = [](const FitTrial& trial, std::size_t i) {
    return trial.recording.channels[trial.binding.measured[i].column];
  };
  for (const FitTrial& trial : trials)
    for (std::size_t i = 0; i < trial.noiseFloor.size(); ++i)
      if (trial.noiseFloor[i] > 0) levels[nameOf(trial, i)].push_back(trial.noiseFloor[i]);
  for (auto& [name, list] : levels) std::sort(list.begin(), list.end());
  for (FitTrial& trial : trials)
    for (std::size_t i = 0; i < trial.noiseFloor.size(); ++i)
      if (trial.noiseFloor[i] > 0) {
        const auto& list = levels[nameOf(trial, i)];
        trial.noiseFloor[i] = list[list.size() / 2];
      }
}

/// A rate is compared only where the position is not recorded: it is the same motion seen through a filter.
bool compared(const Binding& binding, const Measured& measured) {
  if (measured.what != Measured::What::rate) return true;
  return std::none_of(binding.measured.begin(), binding.measured.end(), [&](const Measured& other) {
    return other.what == Measured::What::position && other.object == measured.object && other.part == measured.part;
  });
}

/// True if something is not held by a servo and no trial could forget how it began.
bool swingsFreely(const Scene& scene, const FitTrial& trial) {
  for (std::size_t r = 0; r < scene.robots.size(); ++r) {
    const SceneRobot& robot = scene.robots[r];
    if (robot.freeBase) return true;
    for (std::size_t j = 0; j < robot.drives.size(); ++j) {
      if (robot.model.joints[j].type == Joint::Type::fixed) continue;
      const Drive::Kind kind = robot.drives[j].kind;
      if (kind == Drive::Kind::servo) continue;
      const bool commanded = std::any_of(trial.binding.inputs.begin(), trial.binding.inputs.end(), [&](const auto& i) {
        return i.what == Binding::Input::What::command && i.robot == r && i.joint == j;
      });
      if (kind != Drive::Kind::dcMotor || !commanded) return true;
    }
  }
  return false;
}

/// How much a small error of the initial state grows over a trial, against its size in the first tenth of a second.
double growth(const FitProblem& problem, const Segment& segment) {
  const Scene scene = problem.sceneOf(problem.given, segment.trial);
  std::vector<double> none(segment.nuisances.size(), 0), shifted(segment.nuisances.size(), 0.1);
  const std::vector<double> a = residualsOf(problem, segment, scene, none);
  const std::vector<double> b = residualsOf(problem, segment, scene, shifted);
  const std::vector<double>& time = problem.trials[segment.trial].recording.columns[0];
  double early = 0, late = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double difference = std::abs(a[k] - b[k]);
    (time[segment.row[k]] < time[segment.first] + 0.1 ? early : late) =
        std::max(time[segment.row[k]] < time[segment.first] + 0.1 ? early : late, difference);
  }
  return early > 0 ? late / early : 0;
}

}  // namespace

Scene FitProblem::sceneOf(const SimulatorSpec& simulator, std::size_t trial) const {
  SimulatorSpec own = simulator;
  for (const auto& [path, value] : trials[trial].recording.settings) own.values[path] = value;
  return makeScene(scene, models, own, library.make);
}

std::size_t FitProblem::residuals() const {
  std::size_t count = 0;
  for (const Segment& segment : segments) count += segment.row.size();
  return count;
}

FitProblem makeFitProblem(const GapProblem& problem, const std::vector<Recording>& recordings,
                          const EffectLibrary& library, double window_s) {
  FitProblem ready;
  ready.scene = problem.scene;
  ready.models = problem.models;
  ready.given = problem.simulator;
  ready.library = library;
  std::set<std::string> said;
  for (const Recording& recording : recordings) {
    if (recording.rows() < 8)
      throw InputError(recording.source, std::to_string(recording.rows()) + " rows", "at least 8 rows for an analysis");
    FitTrial trial;
    trial.recording = recording;
    ready.trials.push_back(trial);
    FitTrial& kept = ready.trials.back();
    kept.binding = bind(ready.sceneOf(ready.given, ready.trials.size() - 1), recording);
    if (kept.binding.measured.empty())
      throw InputError(recording.source +
                       ": no column can be compared with the scene; position, velocity, torque, base or "
                       "ball channels are needed");
    for (const Measured& measured : kept.binding.measured)
      kept.noiseFloor.push_back(compared(kept.binding, measured) ? floorOf(recording.columns[measured.column]) : 0);
    const std::string name = std::filesystem::path(recording.source).filename().string();
    for (const auto* list :
         std::initializer_list<const std::vector<std::string>*>{&kept.recording.notes, &kept.binding.notes})
      for (const std::string& text : *list)
        if (said.insert(text).second) ready.notes.push_back(name + ": " + text);
    for (const std::string& text : examine(recording).findings)
      if (said.insert(text).second) ready.notes.push_back(name + ": " + text);
  }
  shareNoiseFloors(ready.trials);

  if (window_s < 0) {
    window_s = 0;
    const Scene scene = ready.sceneOf(ready.given, 0);
    const bool freeBase =
        std::any_of(scene.robots.begin(), scene.robots.end(), [](const SceneRobot& robot) { return robot.freeBase; });
    if (freeBase) {
      window_s = 0.5;
    } else if (swingsFreely(scene, ready.trials[0])) {
      window_s = 1;
    } else {
      cutSegments(ready, 0);
      double most = 0;
      for (const Segment& segment : ready.segments) most = std::max(most, growth(ready, segment));
      if (most > 20) window_s = 1;
    }
    if (window_s > 0)
      ready.notes.push_back("trials are simulated in windows of " + toText(window_s) +
                            " s from the recorded state: free runs would show where errors have drifted to");
  }
  cutSegments(ready, window_s);
  return ready;
}

}  // namespace btr
