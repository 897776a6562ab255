// Numbers of the scene that the recordings do not tell: as given is the best that is known of them.
#include <algorithm>
#include <cmath>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/search/search_run.h"

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

/// Numbers of the scene that went elsewhere untold, the least told first.
std::vector<std::size_t> strayed(const FitModel& model, const Uncertainty& uncertainty) {
  std::vector<std::pair<double, std::size_t>> found;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const FitParameter& p = model.parameters[i];
    const double half = uncertainty.half95(i);
    if (p.effect < 0 && !isTold(p, half) && model.values[i] != p.given)
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

}  // namespace

void SearchRun::holdUntold(SearchResult& result) {
  FitModel& model = result.final.fit.model;
  FitModel kept = model;
  kept.parameters.clear();
  kept.values.clear();
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    if (result.calibratedLinear.columns.col(column).norm() < limits().calibration.sensitive) {
      held_.push_back(model.parameters[i]);
      continue;
    }
    kept.parameters.push_back(model.parameters[i]);
    kept.values.push_back(model.values[i]);
    columns.push_back(column);
  }
  if (columns.size() == model.parameters.size()) return;
  model = kept;
  for (Eigen::MatrixXd* matrix : {&result.calibratedLinear.columns, &result.calibratedLinear.raw}) {
    const Eigen::MatrixXd left = (*matrix)(Eigen::all, columns);
    *matrix = left;
  }
}

void SearchRun::giveBack(std::vector<Fit>& fits, const std::string& stage, double at) const {
  std::vector<FitJob> jobs;
  std::vector<std::size_t> owner;
  for (std::size_t i = 0; i < fits.size() && !held_.empty(); ++i) {
    FitModel model = fits[i].model;
    const Eigen::VectorXd here = residualsOf(problem_, model, fits[i].shifts);
    for (const FitParameter& p : held_) {
      const auto isOne = [&](const FitParameter& other) { return other.effect < 0 && other.name == p.name; };
      if (std::ranges::any_of(fits[i].model.parameters, isOne)) continue;
      FitModel with = model;
      with.parameters.push_back(p);
      with.values.push_back(p.given);
      const auto isFelt = [&](double by) {
        FitModel moved = with;
        moved.values.back() = std::clamp(p.given + by, p.minimum, p.maximum);
        return (residualsOf(problem_, moved, fits[i].shifts) - here).norm() >= limits().calibration.sensitive;
      };
      if (isFelt(p.scale) || isFelt(-p.scale)) model = with;
    }
    if (model.parameters.size() == fits[i].model.parameters.size()) continue;
    jobs.push_back({model, fits[i].shifts});
    owner.push_back(i);
  }
  const auto again = tryFits(jobs, limits().calibration.toTheEnd, stage, at, at);
  for (std::size_t k = 0; k < again.size(); ++k)
    if (again[k] && again[k]->cost < fits[owner[k]].cost) fits[owner[k]] = *again[k];
}

bool SearchRun::leaveUntold(SearchResult& result) const {
  const std::string stage = "what is not told";
  constexpr double at = 0.95;
  const FitModel whole = result.final.fit.model;
  Scored least = result.final;
  double allowed = least.fit.cost;
  for (const std::size_t number : strayed(whole, result.finalUncertainty)) {
    const FitModel model =
        asGiven(least.fit.model, placeIn(least.fit.model, whole.parameters[number]), whole, result.finalLinear);
    const std::vector<Fit> fits =
        thoseOf(tryFits({{model, least.fit.shifts}}, limits().calibration.toTheEnd, stage, at, at));
    const double more = limits().calibration.chiSquared95 / 2 * std::max(1.0, result.final.mean());
    if (fits.empty() || !(fits[0].cost <= allowed + more)) continue;
    const std::optional<Scored> scored = tryScores(fits, stage, at, at)[0];
    if (!scored || isMissed(*scored, result.final, limits().confirmation)) continue;
    least = *scored;
    allowed += more;
  }
  const FitModel fitted = least.fit.model;
  if (fitted.parameters.size() == whole.parameters.size()) return false;
  // They remain numbers of the fit: what is not known of them widens the intervals of others.
  const auto widened = [&](const FitModel& model) {
    Scored scored = least;
    scored.fit.model = valuesFrom(fitted, model);
    return scored;
  };
  result.final = widened(whole);
  if (whole.effects.empty()) result.calibrated = widened(result.calibrated.fit.model);
  result.ladder.back() = step(result.ladder.back().what, result.final);
  return true;
}

}  // namespace btr
