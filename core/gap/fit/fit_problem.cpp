#include "core/gap/fit/fit_problem.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/fit/input_noise.h"
#include "core/gap/fit/noise_sharing.h"
#include "core/gap/fit/segments.h"
#include "core/gap/fit/torques_lead_away.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/followed_rests.h"
#include "core/gap/replay/trial_scenes.h"
#include "core/spec/error.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

/// True if something of a fixed rig is not held by a servo and no trial could forget how it began. A motor that gets a
/// voltage brakes itself: it forgets its speed, and its place says nothing of what follows unless a weight hangs on it,
/// which nonlinearity() sees. What moves within (an elastic beam, play) would be unknown where windows begin.
bool swingsFreely(const Scene& scene, const FitTrial& trial) {
  for (std::size_t r = 0; r < scene.robots.size(); ++r) {
    const SceneRobot& robot = scene.robots[r];
    for (std::size_t j = 0; j < robot.drives.size(); ++j) {
      if (robot.model.joints[j].type == Joint::Type::fixed) continue;
      const Drive::Kind kind = robot.drives[j].kind;
      if (kind == Drive::Kind::servo || kind == Drive::Kind::motion) continue;
      const auto gets = [&](Binding::Input::What what) { return trial.binding.input(what, r, j) != nullptr; };
      using What = Binding::Input::What;
      if (kind != Drive::Kind::dcMotor || !(gets(What::command) || gets(What::duty) || gets(What::volts))) return true;
    }
  }
  return false;
}

bool hasFreeBase(const Scene& scene) { return std::ranges::any_of(scene.robots, &SceneRobot::freeBase); }

/// A body without joints that flies, hits and slides: its whole state is recorded, and each impact multiplies an error.
bool isTossed(const Scene& scene) {
  return hasFreeBase(scene) && std::ranges::all_of(scene.robots, [](const SceneRobot& robot) {
           return std::ranges::all_of(robot.model.joints,
                                      [](const Joint& joint) { return joint.type == Joint::Type::fixed; });
         });
}

/// How far the answer to an error of the initial state is from proportional to it: contacts and limit cycles.
double nonlinearity(const FitProblem& problem, const Segment& segment) {
  const Scene scene = problem.sceneOf(problem.given, segment.trial);
  const auto shifted = [&](double by) {
    std::vector<double> shift;
    for (const Nuisance& nuisance : segment.nuisances) {
      // What rests is asked where it is, not how much it might move.
      const bool rests =
          nuisance.what == Nuisance::What::jointRate && segment.start.robots[nuisance.object].rates[nuisance.part] == 0;
      shift.push_back(rests ? 0 : by);
    }
    return residualsOf(problem, segment, scene, shift);
  };
  const std::vector<double> none = shifted(0), once = shifted(0.5), twice = shifted(1);
  double answer = 0, deviation = 0;
  for (std::size_t k = 0; k < none.size(); ++k) {
    answer += std::pow(twice[k] - none[k], 2);
    deviation += std::pow(twice[k] - 2 * once[k] + none[k], 2);
  }
  // What stays within a noise floor does no harm.
  return deviation > static_cast<double>(none.size()) ? std::sqrt(deviation / answer) : 0;
}

/// Residuals of all segments from their estimated starts.
std::vector<double> plainResiduals(const FitProblem& problem) {
  std::vector<double> all;
  for (const Segment& segment : problem.segments) {
    const auto part = residualsOf(problem, segment, problem.sceneOf(problem.given, segment.trial),
                                  std::vector<double>(segment.nuisances.size(), 0));
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

/// A step that is coarser than the scene's where the integration's own error stays far below the noise: fits take
/// hundreds of replays.
void chooseStep(FitProblem& problem) {
  constexpr double leastHarmless = 0.1, ofError = 0.01;  // noise floors; of the error that there is to explain
  const double asGiven = problem.scene.step_s;
  const double sample = problem.trials[0].recording.samplePeriod();
  const std::vector<double> fine = plainResiduals(problem);
  double error = 0;
  for (const double residual : fine) error += residual * residual / static_cast<double>(fine.size());
  const double harmless = std::max(leastHarmless, ofError * std::sqrt(error));
  for (const double factor : {32.0, 16.0, 8.0, 4.0, 2.0}) {
    if (factor * asGiven > 1.01 * std::max(sample, asGiven)) continue;
    problem.scene.step_s = factor * asGiven;
    const std::vector<double> coarse = plainResiduals(problem);
    double square = 0;
    for (std::size_t k = 0; k < fine.size(); ++k) square += (coarse[k] - fine[k]) * (coarse[k] - fine[k]);
    if (std::sqrt(square / static_cast<double>(fine.size())) < harmless) {
      problem.notes.push_back("fits use a step of " + toText(problem.scene.step_s) +
                              " s: of the simulator as given, which is off by " + digits(std::sqrt(error), 3) +
                              " noise floors, that changes the replay by less than " + digits(harmless, 2));
      return;
    }
  }
  problem.scene.step_s = asGiven;
}

/// A foot that lands a little earlier decides where a free run ends, of the simulator that made the recording, too: of
/// the six walks of the blind trial's seed 77, cases 0 and 1, it tells two to their ends and parts from the others
/// after 1.0 to 3.8 s (13 noise floors off soon after). A sagging voltage was one side minimum among many over four
/// seconds, and is found over the first steps.
void keepFirstSteps(FitProblem& problem, double firstSteps_s) {
  for (FitTrial& trial : problem.trials) {
    const std::vector<double>& time = trial.recording.columns[0];
    const auto last = std::ranges::upper_bound(time, time.front() + firstSteps_s);
    trial.compared = std::max<std::size_t>(8, static_cast<std::size_t>(last - time.begin()));
    if (trial.compared < time.size())
      problem.notes.push_back(
          std::filesystem::path(trial.recording.source).filename().string() + ": compared over its first " +
          toText(firstSteps_s) +
          " s: later, feet that landed a little earlier decide where it walks, whatever the simulator");
  }
}

/// Short enough for one impact. (Free runs of real tosses of 0.7 s end after four impacts where the integration's own
/// error is as large as what there is to explain; in windows of 0.1 s it is below the noise floor.)
double windowOfImpacts(const FitTrial& trial) {
  constexpr double oneImpact_s = 0.1, leastSamples = 12;
  return std::max(oneImpact_s, leastSamples * trial.recording.samplePeriod());
}

constexpr double windowOfSwings_s = 1;

/// Where the simulator as given loses the recorded path under its torques within that, the half, quarter or eighth of
/// it in which it does not: there what is missing is still in proportion. (A cart of 2 kg on a spring of 120 N/m that
/// nobody knows of turns round in 0.4 s.)
double windowUnderTorques(FitProblem& problem) {
  constexpr double shortest_s = windowOfSwings_s / 8;
  for (double window_s = windowOfSwings_s; window_s >= shortest_s; window_s /= 2) {
    cutSegments(problem, window_s);
    if (!doTorquesLeadAway(problem)) return window_s;
  }
  return windowOfSwings_s;
}

/// A trial of which every compared column is empty would agree with anything.
void refuseWithoutNumbers(const std::vector<FitTrial>& trials) {
  for (const FitTrial& trial : trials)
    if (std::none_of(trial.noiseFloor.begin(), trial.noiseFloor.end(), [](double floor) { return floor > 0; }))
      throw InputError(trial.recording.at(trial.binding.measured[0].column, 0), "a column without any number",
                       "at least one compared column with numbers");
}

/// True if torques of joints that rest are not compared (followed_rests.h).
bool leaveRestsOut(FitProblem& problem) {
  std::set<std::string> channels;
  for (std::size_t t = 0; t < problem.trials.size(); ++t) {
    FitTrial& trial = problem.trials[t];
    for (const std::size_t column : leaveOutRests(trial.recording, trial.binding, problem.sceneOf(problem.given, t)))
      channels.insert(trial.recording.channels[column]);
  }
  if (channels.empty()) return false;
  std::string list;
  for (const std::string& channel : channels) list += (list.empty() ? "" : ", ") + channel;
  problem.notes.push_back(list + ": compared while the joint turns, as at rest dry friction carries whatever is given");
  return true;
}

}  // namespace

double priorCost(const std::vector<Nuisance>& nuisances, const std::vector<double>& shift) {
  double sum = 0;
  for (std::size_t i = 0; i < shift.size(); ++i) sum += std::pow(nuisances[i].hold * shift[i], 2);
  return sum;
}

double startIsFelt_s(const FitProblem& problem) {
  constexpr double servosForget_s = 5;
  const Scene scene = problem.sceneOf(problem.given, 0);
  if (scene.robots.empty()) return INFINITY;
  if (isTossed(scene)) return windowOfImpacts(problem.trials[0]);
  return swingsFreely(scene, problem.trials[0]) ? windowOfSwings_s : servosForget_s;
}

Scene FitProblem::sceneOf(const SimulatorSpec& simulator, std::size_t trial) const {
  return makeScene(scene, models, withSettings(simulator, trials[trial].recording), library.make);
}

std::size_t FitProblem::residuals() const {
  std::size_t count = 0;
  for (const Segment& segment : segments) count += segment.row.size();
  return count;
}

double FitProblem::steps() const {
  double length_s = 0;
  for (const Segment& segment : segments) {
    const std::vector<double>& time = trials[segment.trial].recording.columns[0];
    length_s += time[segment.last - 1] - time[segment.first];
  }
  return length_s / scene.step_s;
}

FitProblem makeFitProblem(const GapProblem& problem, const std::vector<Recording>& recordings,
                          const EffectLibrary& library, double window_s) {
  FitProblem ready;
  ready.scene = problem.scene;
  ready.givenStep_s = problem.scene.step_s;
  ready.models = problem.models;
  ready.given = problem.simulator;
  ready.library = library;
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
  }
  shareNoiseFloors(ready.trials, ready.notes);
  refuseWithoutNumbers(ready.trials);
  ready.paces = pacesOf(ready);

  const Scene scene = ready.sceneOf(ready.given, 0);
  ready.impacts = isTossed(scene);
  ready.walks = hasFreeBase(scene) && !ready.impacts;
  if (ready.walks) {
    ready.differenceStep = 0.5;
    ready.finestStep = 0.51;
  }
  if (window_s < 0) {
    window_s = 0;
    if (ready.impacts) {
      window_s = windowOfImpacts(ready.trials[0]);
      ready.differenceStep = 0.1;
    } else if (!ready.walks) {
      ready.mayCoarsen = true;
      if (swingsFreely(scene, ready.trials[0])) {
        window_s = windowUnderTorques(ready);
      } else {
        cutSegments(ready, 0);
        double most = 0;
        for (const Segment& segment : ready.segments) most = std::max(most, nonlinearity(ready, segment));
        if (most > 0.3) window_s = 1;
      }
    }
    if (window_s > 0)
      ready.notes.push_back("trials are simulated in windows of " + toText(window_s) +
                            " s from the recorded state: free runs would show where errors have drifted to");
  }
  // Runs freely, from where it stood or was let go: in the middle of a walk nothing recorded tells its contacts well
  // enough to begin there. (With its true numbers a walking dog's error is 1.1 noise floors² from the start, and 5 to
  // 11 in windows of 0.25 s to 2 s whose initial states are fitted.)
  if (ready.walks && window_s == 0) keepFirstSteps(ready, problem.firstSteps_s);
  const bool filtered = prepareFilteredMotions(ready, window_s == 0), rested = leaveRestsOut(ready);
  if (filtered || rested) shareNoiseFloors(ready.trials, ready.notes);
  cutSegments(ready, window_s);
  addInputNoise(ready);
  sayIfTorquesLeadAway(ready);
  if (ready.mayCoarsen) chooseStep(ready);
  return ready;
}

}  // namespace btr
