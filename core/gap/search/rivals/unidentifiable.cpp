#include "core/gap/search/rivals/unidentifiable.h"

#include <algorithm>
#include <cmath>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/search/model_comparison.h"
#include "core/gap/search/thresholds.h"
#include "core/spec/error.h"

namespace btr {
namespace {

std::size_t placeIn(const FitModel& model, const FitParameter& p) {
  const auto same = [&](const FitParameter& other) { return other.effect == p.effect && other.name == p.name; };
  return static_cast<std::size_t>(std::ranges::find_if(model.parameters, same) - model.parameters.begin());
}

/// The model with the other's values of what that fits, and all else as given.
FitModel valuesFrom(const FitModel& fitted, FitModel model) {
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const std::size_t place = placeIn(fitted, model.parameters[i]);
    model.values[i] = place < fitted.values.size() ? fitted.values[place] : model.parameters[i].given;
  }
  return model;
}

/// Numbers of the scene that went elsewhere and are not identifiable, the least so first.
std::vector<std::size_t> strayed(const FitModel& model, const Uncertainty& uncertainty) {
  std::vector<std::pair<double, std::size_t>> found;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const FitParameter& p = model.parameters[i];
    const double half = uncertainty.half95(i);
    if (p.effect < 0 && !isIdentifiable(p, half) && model.values[i] != p.given)
      found.emplace_back(-half / (p.maximum - p.minimum), i);
  }
  std::ranges::sort(found);
  std::vector<std::size_t> numbers;
  for (const auto& [order, i] : found) numbers.push_back(i);
  return numbers;
}

/// The model with `number` as given and out of the fit, others moved as they would follow it by their sensitivities:
/// `linear` is of the model `whole`, which has all of these parameters.
FitModel asGiven(const FitModel& model, std::size_t number, const FitModel& whole, const Linearised& linear) {
  FitModel kept = model;
  const auto at = static_cast<std::ptrdiff_t>(number);
  const FitParameter gone = model.parameters[number];
  kept.parameters.erase(kept.parameters.begin() + at);
  kept.values.erase(kept.values.begin() + at);
  if (kept.parameters.empty()) return kept;

  const auto columnOf = [&](const FitParameter& p) { return static_cast<Eigen::Index>(placeIn(whole, p)); };
  std::vector<Eigen::Index> columns;
  for (const FitParameter& p : kept.parameters) columns.push_back(columnOf(p));
  const Eigen::MatrixXd others = linear.columns(Eigen::all, columns);
  const Eigen::VectorXd moved = (gone.given - model.values[number]) / gone.scale * linear.columns.col(columnOf(gone));
  const Eigen::VectorXd follow = others.completeOrthogonalDecomposition().solve(-moved);
  for (std::size_t i = 0; i < kept.values.size(); ++i) {
    const FitParameter& p = kept.parameters[i];
    kept.values[i] = std::clamp(kept.values[i] + follow[static_cast<Eigen::Index>(i)] * p.scale, p.minimum, p.maximum);
  }
  return kept;
}

/// A number of an effect that says where something ends, not how large it is.
bool mayBeUnreached(const FitParameter& p, const SearchThresholds::Candidates& limits) {
  return p.effect >= 0 && !p.hasNeutral && p.minimum > 0 && p.maximum / p.minimum > limits.wideRange;
}

/// Sizes of effects that are known from below only, as friction that holds a joint: half as large again they do the
/// same. Where a number just reaches that, its sensitivity is of one side and says how large it is at least.
std::vector<std::size_t> knownFromBelow(const FitProblem& problem, const Fit& fit,
                                        const SearchThresholds::Confirmation& limits) {
  std::vector<std::size_t> found;
  std::optional<double> here;
  for (std::size_t i = 0; i < fit.model.parameters.size(); ++i) {
    const FitParameter& p = fit.model.parameters[i];
    const double size = fit.model.values[i] - p.given;
    if (p.effect < 0 || !p.hasNeutral || size == 0) continue;
    const auto costAt = [&](double value) {
      FitModel model = fit.model;
      model.values[i] = value;
      return residualsOf(problem, model, fit.shifts).squaredNorm();
    };
    const double larger = p.inRange(p.given + limits.largerSize * size);
    if (larger == fit.model.values[i]) continue;  // at its bound: nobody knows
    if (!here) here = costAt(fit.model.values[i]);
    try {
      if (isKnownFromBelow(costAt(p.given), *here, costAt(larger), limits)) found.push_back(i);
    } catch (const InputError&) {
      continue;  // no scene can be that large, or do without it: it is known from above, too
    }
  }
  return found;
}

}  // namespace

void raiseUnreached(const FitService& service, Fit& fit) {
  const FitProblem& problem = service.problem();
  const auto squares = [&](const FitModel& model) { return residualsOf(problem, model, fit.shifts).squaredNorm(); };
  std::optional<double> before;
  for (std::size_t i = 0; i < fit.model.parameters.size(); ++i) {
    const FitParameter& p = fit.model.parameters[i];
    if (!mayBeUnreached(p, service.thresholds().candidates) || fit.model.values[i] >= p.maximum) continue;
    if (!before) before = squares(fit.model);
    FitModel raised = fit.model;
    raised.values[i] = p.maximum;
    if (squares(raised) <= *before + service.thresholds().calibration.unreached) fit.model = std::move(raised);
  }
}

Measurement measure(const FitService& service, const Fit& fit) {
  Measurement measured;
  measured.stepChange = service.stepChange(fit);
  measured.linear = linearise(service.problem(), fit);
  measured.uncertainty = uncertaintyOf(service.problem(), fit, measured.linear);
  for (const std::size_t i : knownFromBelow(service.problem(), fit, service.thresholds().confirmation))
    measured.uncertainty.standardError[i] = INFINITY;
  measured.uncertainty.unsettled = unsettled(service.problem(), fit, measured.linear, measured.stepChange);
  return measured;
}

Scored BackAsGiven::of(const FitModel& model) const {
  Scored widened = scored;
  widened.fit.model = valuesFrom(fitted, model);
  return widened;
}

std::optional<BackAsGiven> backAsGiven(const FitService& service, const Scored& final, const Measurement& measured) {
  const std::string stage = "unidentifiable numbers";
  constexpr double at = 0.95;
  const SearchThresholds::Calibration& limits = service.thresholds().calibration;
  const FitModel& whole = final.fit.model;
  Scored least = final;
  double allowed = least.fit.cost;
  for (const std::size_t number : strayed(whole, measured.uncertainty)) {
    const FitModel model =
        asGiven(least.fit.model, placeIn(least.fit.model, whole.parameters[number]), whole, measured.linear);
    const std::vector<Fit> fits =
        completed(service.tryFits({{model, least.fit.shifts}}, limits.toTheEnd, stage, at, at));
    const double more = limits.chiSquared95 / 2 * std::max(1.0, final.mean());
    if (fits.empty() || !(fits[0].cost <= allowed + more)) continue;
    const std::optional<Scored> scored = service.tryScores(fits, stage, at, at)[0];
    if (!scored || isMissed(*scored, final, service.thresholds().confirmation)) continue;
    least = *scored;
    allowed += more;
  }
  if (least.fit.model.parameters.size() == whole.parameters.size()) return std::nullopt;
  return BackAsGiven{least, least.fit.model};
}

}  // namespace btr
