#include "core/gap/search/rivals/next_recording.h"

#include <algorithm>
#include <cmath>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/extent.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/replay.h"
#include "core/gap/replay/start_state.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/report_words.h"
#include "core/gap/search/thresholds.h"
#include "core/spec/figures.h"
#include "core/spec/random.h"

namespace btr {
namespace {

/// A joint that a recording can move: to positions, or by a force, duty or voltage that lets it go where it will.
struct CommandedJoint {
  std::size_t robot = 0, joint = 0;
  std::string channel;
  double middle = 0, reach = 0;  ///< of the commands that were recorded; positions inside the joint's limits
  bool pushed = false;           ///< by a force
  Extent range{};                ///< of one that is pushed: where it was seen to be able to go
};

bool isPositionOf(const Binding::Measured& measured, std::size_t robot, std::size_t joint) {
  return measured.what == Binding::Measured::What::position && measured.object == robot && measured.part == joint;
}

/// Of a joint that is pushed: the recorded positions, a little more than that, inside its limits.
Extent rangeOf(const FitProblem& problem, const Binding::Input& input, const Joint& joint,
               const SearchThresholds::NextRecording& limits) {
  Extent seen;
  for (const FitTrial& trial : problem.trials)
    for (const auto& measured : trial.binding.measured)
      if (isPositionOf(measured, input.robot, input.joint)) seen.add(trial.recording.columns[measured.column]);
  if (!seen.some()) return {};
  const double slack = limits.beyond * (seen.high - seen.low);
  return {std::max(seen.low - slack, joint.lower), std::min(seen.high + slack, joint.upper)};
}

std::vector<CommandedJoint> commandedJoints(const FitProblem& problem, const Scene& scene,
                                            const SearchThresholds::NextRecording& limits) {
  using What = Binding::Input::What;
  std::vector<CommandedJoint> joints;
  for (const auto& input : problem.trials[0].binding.inputs) {
    if (input.what != What::command && input.what != What::duty && input.what != What::volts) continue;
    const SceneRobot& robot = scene.robots[input.robot];
    const Joint& joint = robot.model.joints[input.joint];
    Extent commanded;
    for (const FitTrial& trial : problem.trials) commanded.add(trial.recording.columns[input.column]);
    if (!commanded.some()) continue;
    CommandedJoint found{input.robot, input.joint, problem.trials[0].recording.channels[input.column]};
    found.pushed = input.what != What::command || robot.drives[input.joint].kind == Drive::Kind::torque;
    if (found.pushed) {
      found.range = rangeOf(problem, input, joint, limits);
      if (!found.range.some()) continue;  // nobody knows where it may go
    } else {
      commanded = {std::max(commanded.low, joint.lower), std::min(commanded.high, joint.upper)};
    }
    found.middle = (commanded.low + commanded.high) / 2;
    found.reach = (commanded.high - commanded.low) / 2;
    joints.push_back(found);
  }
  return joints;
}

/// Whether what is pushed stays where it was seen to be able to go.
bool staysInRange(const std::vector<CommandedJoint>& joints, const Binding& binding,
                  const ReplayedRecording& replayed) {
  for (std::size_t c = 0; c < binding.measured.size(); ++c)
    for (const CommandedJoint& joint : joints) {
      if (!joint.pushed || !isPositionOf(binding.measured[c], joint.robot, joint.joint)) continue;
      const auto isOutside = [&](double place) { return !(place >= joint.range.low && place <= joint.range.high); };
      if (std::ranges::any_of(replayed.values[c], isOutside)) return false;
    }
  return true;
}

/// A command over time for joint number `k` of a sequence; within ±1 of its reach.
using Shape = std::function<double(double t, std::size_t k)>;

std::vector<std::pair<std::string, Shape>> shapes(std::uint64_t seed) {
  const auto phase = [](std::size_t k) { return 2.1 * static_cast<double>(k); };
  std::vector<std::pair<std::string, Shape>> list;
  for (const double frequency : {0.2, 0.5, 1.0, 2.0, 4.0})
    for (const double size : {0.15, 0.5, 1.0})
      if (frequency * size <= 1.01)
        list.push_back({"a sine of " + toText(frequency) + " Hz", [=](double t, std::size_t k) {
                          return size * std::sin(2 * M_PI * frequency * (1 + 0.13 * static_cast<double>(k)) * t);
                        }});
  list.push_back({"a slow triangle", [phase](double t, std::size_t k) {
                    const double p = std::fmod(t / 4 + phase(k) / 6, 1.0);
                    return p < 0.5 ? 4 * p - 1 : 3 - 4 * p;
                  }});
  list.push_back({"steps", [](double t, std::size_t k) {
                    return std::fmod(t + 0.3 * static_cast<double>(k), 2.0) < 1 ? 0.8 : -0.8;
                  }});
  list.push_back({"small steps", [](double t, std::size_t k) {
                    return std::fmod(t + 0.2 * static_cast<double>(k), 1.0) < 0.5 ? 0.1 : -0.1;
                  }});
  list.push_back({"a sweep", [phase](double t, std::size_t k) {
                    return 0.4 * std::sin(2 * M_PI * (0.2 * t + 0.35 * t * t) + phase(k));
                  }});
  std::vector<double> levels;
  Random random = Random::forPurpose(seed, "next recording");
  for (int i = 0; i < 64; ++i) levels.push_back(random.uniform(-0.9, 0.9));
  list.push_back({"steps and holds", [levels](double t, std::size_t k) {
                    return levels[(static_cast<std::size_t>(t / 0.7) + 17 * k) % levels.size()];
                  }});
  return list;
}

/// What is pushed gets `push` times its reach: the same force moves it far in one direction, or not at all.
Recording recordingOf(const std::vector<CommandedJoint>& joints, const FitTrial& like, const Shape& shape, double push,
                      const SearchThresholds::NextRecording& limits) {
  Recording recording;
  recording.source = "next command";
  recording.channels = {"time_s"};
  recording.columns.resize(1);
  for (double t = 0; t < limits.length_s; t += limits.sample_s) recording.columns[0].push_back(t);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    recording.channels.push_back(joints[k].channel);
    const double size = limits.reach * joints[k].reach * (joints[k].pushed ? push : 1);
    std::vector<double> column;
    for (const double t : recording.columns[0])
      column.push_back(joints[k].middle +
                       (t < limits.rest_s ? 0 : size * std::clamp(shape(t - limits.rest_s, k), -1.0, 1.0)));
    recording.columns.push_back(column);
  }
  for (const auto& measured : like.binding.measured) {
    recording.channels.push_back(like.recording.channels[measured.column]);
    recording.columns.emplace_back(recording.columns[0].size(), NAN);
  }
  recording.settings = like.recording.settings;
  return recording;
}

/// How far the two simulators would be apart [noise floors, RMS]; 0 where one of them fails or leaves its range.
double separationOf(const FitProblem& problem, const std::vector<CommandedJoint>& joints, const Scene& one,
                    const Scene& other, const Recording& recording) {
  const Binding binding = bind(one, recording);
  StartState start = startState(one, recording, binding);
  for (const CommandedJoint& joint : joints)
    if (!joint.pushed) start.robots[joint.robot].positions[joint.joint] = joint.middle;
  const ReplayedRecording a = replayRecording(one, recording, binding, start),
                          b = replayRecording(other, recording, binding, start);
  if (!a.fault.empty() || !b.fault.empty() || !staysInRange(joints, binding, a) || !staysInRange(joints, binding, b))
    return 0;
  const FitTrial& like = problem.trials[0];
  double square = 0, count = 0;
  for (std::size_t c = 0; c < binding.measured.size(); ++c) {
    const double floor = like.noiseFloor[c];
    if (floor <= 0) continue;
    for (std::size_t row = 0; row < recording.rows(); ++row) {
      const double difference = (a.values[c][row] - b.values[c][row]) / floor;
      if (!std::isfinite(difference)) continue;
      square += difference * difference;
      ++count;
    }
  }
  return count > 0 ? std::sqrt(square / count) : 0;
}

}  // namespace

GapReport::NextRecording designNext(const FitProblem& problem, const SearchResult& found, std::uint64_t seed,
                                    const SearchThresholds::NextRecording& thresholds) {
  GapReport::NextRecording next;
  // Beside a law that was measured, rivals have names and no simulators of their own.
  const auto doubted = std::ranges::find_if(
      found.effects, [](const Found& effect) { return !effect.rivals.empty() && !effect.rivalFits.empty(); });
  if (doubted == found.effects.end()) return next;
  const FitTrial& like = problem.trials[0];
  const FitModel &first = found.final.fit.model, &rival = doubted->rivalFits[0].model;
  const Scene sceneA = problem.sceneOf(first.simulator(problem), 0),
              sceneB = problem.sceneOf(rival.simulator(problem), 0);
  const std::vector<CommandedJoint> joints = commandedJoints(problem, sceneA, thresholds);
  if (joints.empty()) return next;

  const bool pushes = std::ranges::any_of(joints, &CommandedJoint::pushed);
  const std::vector<double> pushed =
      pushes ? std::vector<double>(thresholds.pushes.begin(), thresholds.pushes.end()) : std::vector<double>{1};
  std::string shapeName;
  for (const auto& [name, shape] : shapes(seed))
    for (const double push : pushed) {
      const Recording recording = recordingOf(joints, like, shape, push, thresholds);
      const double separation = separationOf(problem, joints, sceneA, sceneB, recording);
      if (separation <= next.separation) continue;
      next.separation = separation;
      next.channels.assign(recording.channels.begin(),
                           recording.channels.begin() + 1 + static_cast<std::ptrdiff_t>(joints.size()));
      next.columns.assign(recording.columns.begin(),
                          recording.columns.begin() + 1 + static_cast<std::ptrdiff_t>(joints.size()));
      shapeName = name;
    }
  if (next.separation <= 0) return next;
  const std::string own = inWords(doubted->effect.effect, doubted->effect.at), other = inWords(doubted->rivals[0]),
                    by = " by " + digits(next.separation, 2) + " noise floors (" + shapeName + ", " +
                         toText(thresholds.length_s) + " s)";
  next.why = next.separation >= thresholds.leastSeparation
                 ? "separates " + own + " from " + other + by
                 : "would hardly tell " + own + " from " + other + ": the best of those tried separates them" + by +
                       "; what commands do not change may tell them, a known weight on the link or another posture of "
                       "the base";
  return next;
}

}  // namespace btr
