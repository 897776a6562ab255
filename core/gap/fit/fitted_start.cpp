#include "core/gap/fit/fitted_start.h"

#include <algorithm>
#include <cmath>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/fit/segments.h"
#include "core/gap/fit/starts_anew.h"
#include "core/gap/recordings/binding.h"

namespace btr {
namespace {

bool saysWhereItBegins(const Recording& trial, const Binding& binding) {
  if (trial.rows() < 8) return false;
  if (std::ranges::any_of(binding.inputs, [](const auto& input) { return input.what == Binding::Input::What::motion; }))
    return false;
  return std::ranges::any_of(binding.measured, [&](const auto& measured) {
    return std::ranges::any_of(trial.columns[measured.column], [](double value) { return std::isfinite(value); });
  });
}

void keepFirst(FitProblem& problem, double length_s) {
  FitTrial& trial = problem.trials[0];
  const std::vector<double>& time = trial.recording.columns[0];
  const auto last = std::ranges::upper_bound(time, time.front() + length_s);
  trial.compared = std::min(trial.compared, std::max<std::size_t>(8, static_cast<std::size_t>(last - time.begin())));
}

}  // namespace

std::optional<StartState> fittedStart(const TrialScenes& scenes, const EffectFactory& effects, const Recording& trial,
                                      const std::function<bool()>& goesOn) {
  constexpr int iterations = 20;
  if (!saysWhereItBegins(trial, bind(scenes.of(trial, effects), trial))) return std::nullopt;
  FitProblem problem =
      makeFitProblem({scenes.spec, scenes.models, scenes.simulator, {}, {}}, {trial}, {effects, {}}, 0);
  keepFirst(problem, startIsFelt_s(problem));
  cutSegments(problem, 0);
  if (problem.segments.empty()) return std::nullopt;
  FitOptions options{.iterations = iterations, .startsOnly = true};
  if (goesOn) options.goOn = [&](double) { return goesOn(); };
  const Fit fit = withStartsAnew(problem, fitModel(problem, {}, {}, options));
  return shiftedStart(problem.segments[0], fit.shifts[0]);
}

}  // namespace btr
