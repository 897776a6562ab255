#include "core/gap/search/laws/remainder.h"

#include <algorithm>
#include <cmath>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/parallel.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/extent.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/laws/learned_force.h"
#include "core/gap/search/screening/screen.h"
#include "core/gap/search/thresholds.h"

namespace btr {
namespace {

using Over = LearnedForce::Over;
using Along = LearnedForce::Along;

struct Option {
  LearnedForce force;
  std::string at;
  std::string unitX;
};

/// Curves over what each joint and ball did, over the range that it did it in.
std::vector<Option> optionsOf(const FitProblem& problem, const Scene& scene,
                              const SearchThresholds::Remainder& limits) {
  std::vector<Option> options;
  const FitTrial& first = problem.trials[0];
  for (const auto& measured : first.binding.measured) {
    if (measured.what != Binding::Measured::What::position && measured.what != Binding::Measured::What::ballPosition)
      continue;
    Extent position, speed, time;
    for (const FitTrial& trial : problem.trials)
      for (const auto& other : trial.binding.measured) {
        if (other.what != measured.what || other.object != measured.object || other.part != measured.part) continue;
        const auto& column = trial.recording.columns[other.column];
        const auto& t = trial.recording.columns[0];
        for (std::size_t row = 0; row < column.size(); ++row) {
          position.add(column[row]);
          time.add(t[row] - t[0]);
          if (row >= 4) speed.add((column[row] - column[row - 4]) / (t[row] - t[row - 4]));
        }
      }
    if (!position.some() || !speed.some()) continue;
    if (measured.what == Binding::Measured::What::position) {
      const SceneRobot& robot = scene.robots[measured.object];
      const Drive& drive = robot.drives[measured.part];
      const bool slides = robot.model.joints[measured.part].type == Joint::Type::slide;
      const double strength = drive.maxTorque < 1e8 ? drive.maxTorque : drive.p > 0 ? drive.p * 0.1 : 1;
      const std::string at = robot.name + "." + robot.model.joints[measured.part].name;
      const auto add = [&](Over over, Extent range, const char* unit) {
        options.push_back({{over, Along::joint, range.low, range.high, limits.jointForce * strength}, at, unit});
      };
      add(Over::position, position, slides ? "m" : "rad");
      add(Over::velocity, speed, slides ? "m/s" : "rad/s");
      if (problem.trials.size() >= SearchThresholds::Law::timeNeedsTrials) add(Over::time, time, "s");
      if (drive.kind != Drive::Kind::none) {
        Extent load{-strength, strength};
        add(Over::load, load, slides ? "N" : "N·m");
      }
    } else if (measured.part < 2) {
      const BallSpec& ball = scene.balls[measured.object];
      const double weight = ball.mass_kg * 9.81;
      const Along along = measured.part == 0 ? Along::x : Along::y;
      options.push_back(
          {{Over::position, along, position.low, position.high, limits.ballForce * weight}, ball.name, "m"});
      options.push_back({{Over::time, along, time.low, time.high, limits.ballForce * weight}, ball.name, "s"});
      if (measured.part == 0)
        options.push_back(
            {{Over::velocity, Along::motion, 0, std::max(speed.high, -speed.low), limits.ballForce * weight},
             ball.name,
             "m/s"});
    }
  }
  return options;
}

struct Learned {
  Option option;
  Scored scored;
  Uncertainty uncertainty;
};

/// The option whose knots would take most away by the score test, fitted to the end.
std::optional<Learned> learn(const FitProblem& problem, const Fit& base, const Linearised& linear, int jobs,
                             const SearchThresholds& thresholds) {
  const std::vector<Option> options =
      optionsOf(problem, problem.sceneOf(base.model.simulator(problem), 0), thresholds.remainder);
  const auto shareOf = [&](std::size_t i) -> std::vector<double> {
    FitProblem with = problem;
    with.library = withLearnedForce(problem.library, options[i].force);
    EffectCandidate candidate{
        options[i].force.name(), options[i].at, with.library.make(options[i].force.name())->parameters(), {}};
    for (const Parameter& p : candidate.declared) {
      Values variant;
      for (const Parameter& other : candidate.declared) variant[other.name] = 0;
      variant[p.name] = p.byDefault;
      candidate.variants.push_back(variant);
      variant[p.name] = -p.byDefault;
      candidate.variants.push_back(variant);
    }
    return {screen(with, base, linear, {candidate}, 1, {}, thresholds.screening)[0].share};
  };
  const auto shares = parallel(jobs, options.size(), shareOf);
  double most = 0;
  std::size_t chosen = options.size();
  for (std::size_t i = 0; i < options.size(); ++i)
    if (shares[i].ok() && shares[i].numbers[0] > most) {
      most = shares[i].numbers[0];
      chosen = i;
    }
  if (chosen == options.size()) return std::nullopt;
  FitProblem with = problem;
  with.library = withLearnedForce(problem.library, options[chosen].force);
  FitModel model = base.model.with(with, {options[chosen].force.name(), options[chosen].at, {}});
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    if (model.parameters[i].effect == static_cast<int>(model.effects.size()) - 1) model.values[i] = 0;
  const Fit fit = fitModel(with, model, base.shifts, {thresholds.remainder.iterations});
  Learned learned{options[chosen], crossValidate(with, fit), {}};
  learned.uncertainty = uncertaintyOf(with, fit, linearise(with, fit));
  return learned;
}

}  // namespace

GapReport::Remainder findRemainder(const FitProblem& problem, const SearchResult& found, int jobs,
                                   const SearchThresholds& thresholds) {
  GapReport::Remainder remainder;
  const SearchThresholds::Remainder& limits = thresholds.remainder;
  const double rest = excessOf(found.final);
  if (rest < limits.leastExcess) return remainder;
  const auto learned = learn(problem, found.final.fit, found.finalLinear, jobs, thresholds);
  if (!learned) return remainder;
  const PairedTest comparison = compare(found.final.blocks, learned->scored.blocks);
  const double share = (found.final.mean() - learned->scored.mean()) / rest;
  remainder.pValue = comparison.pValue;
  remainder.shareOfRest = std::clamp(share, 0.0, 1.0);
  if (comparison.t < limits.leastT || share < limits.leastShare) return remainder;
  remainder.at = learned->option.at;
  remainder.on = toText(learned->option.force.over);
  remainder.unitX = learned->option.unitX;
  const FitModel& model = learned->scored.fit.model;
  int knot = 0;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    if (model.parameters[i].effect != static_cast<int>(model.effects.size()) - 1) continue;
    remainder.unitY = model.parameters[i].unit;
    remainder.x.push_back(learned->option.force.knot(knot++));
    remainder.y.push_back(model.values[i]);
    remainder.standardError.push_back(learned->uncertainty.standardError[i]);
  }
  return remainder;
}

bool aCurveDoesBetter(const FitProblem& problem, const SearchResult& found, int jobs,
                      const SearchThresholds& thresholds) {
  const SearchThresholds::Remainder& limits = thresholds.remainder;
  if (found.effects.empty() || found.final.mean() < limits.insteadError) return false;
  Fit base = found.calibrated.fit;
  base.model = found.final.fit.model;
  while (!base.model.effects.empty()) base.model = base.model.without(base.model.effects.size() - 1);
  base = fitModel(problem, base.model, found.calibrated.fit.shifts, {limits.insteadIterations});
  const auto learned = learn(problem, base, linearise(problem, base), jobs, thresholds);
  return learned && learned->scored.mean() < limits.instead * found.final.mean() &&
         compare(found.final.blocks, learned->scored.blocks).t > limits.leastT;
}

}  // namespace btr
