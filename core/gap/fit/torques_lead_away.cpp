#include "core/gap/fit/torques_lead_away.h"

#include <algorithm>
#include <cmath>

#include "core/gap/fit/segments.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/squares.h"

namespace btr {
namespace {

using Measured = Binding::Measured;

/// A joint's compared position that a recorded torque is to bring about.
bool followsTorque(const FitTrial& trial, const Scene& scene, std::size_t channel) {
  const Measured& measured = trial.binding.measured[channel];
  return measured.what == Measured::What::position && trial.noiseFloor[channel] > 0 &&
         scene.robots[measured.object].drives[measured.part].kind == Drive::Kind::torque &&
         trial.binding.input(Binding::Input::What::command, measured.object, measured.part);
}

/// Of one channel in one trial.
struct Way {
  Squares error, values;
  double sum = 0;
  void add(double difference, double value) {
    error.add(difference);
    values.add(value);
    sum += value;
  }
  bool isLost() const {
    constexpr double lost = 0.5;  // of how far the joint moves, r.m.s.
    const double mean = sum / values.count;
    return error.sum / error.count > lost * lost * (values.sum / values.count - mean * mean);
  }
};

}  // namespace

bool doTorquesLeadAway(const FitProblem& problem) {
  std::size_t driven = 0, lost = 0;
  for (std::size_t t = 0; t < problem.trials.size(); ++t) {
    const FitTrial& trial = problem.trials[t];
    const Scene scene = problem.sceneOf(problem.given, t);
    std::vector<char> counts(trial.binding.measured.size());
    for (std::size_t channel = 0; channel < counts.size(); ++channel)
      counts[channel] = followsTorque(trial, scene, channel);
    if (std::ranges::none_of(counts, [](char yes) { return yes != 0; })) continue;
    std::vector<Way> ways(counts.size());
    for (const Segment& segment : problem.segments) {
      if (segment.trial != t) continue;
      const auto residuals = residualsOf(problem, segment, scene, std::vector<double>(segment.nuisances.size(), 0));
      for (std::size_t k = 0; k < residuals.size(); ++k) {
        const std::size_t channel = segment.channel[k], row = segment.row[k];
        if (!counts[channel]) continue;
        const std::size_t column = trial.binding.measured[channel].column;
        ways[channel].add(residuals[k] * trial.floorAt(channel, row), trial.recording.columns[column][row]);
      }
    }
    for (const Way& way : ways)
      if (way.error.count > 0) {
        ++driven;
        if (way.isLost()) ++lost;
      }
  }
  return 2 * lost > driven;
}

void sayIfTorquesLeadAway(FitProblem& problem) {
  if (!doTorquesLeadAway(problem)) return;
  problem.notes.emplace_back(
      "the recorded torques lead most joints away from their recorded paths, by half of what these move or more, "
      "before "
      "anything is fitted: little can be judged so, and it takes long. Let the joints follow the recorded motion, "
      "\"drive\": \"motion\" in the scene; then torques are compared");
  std::rotate(problem.notes.begin(), problem.notes.end() - 1, problem.notes.end());
}

}  // namespace btr
