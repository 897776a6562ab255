#include "core/gap/search/calibrator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/gap/fit/block_scores.h"
#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/search/model_comparison.h"
#include "core/gap/search/starts/drawn_starts.h"
#include "core/gap/search/starts/range_scan.h"
#include "core/gap/search/starts/restarts.h"
#include "core/spec/random.h"

namespace btr {
namespace {

/// Takes numbers to which nothing is sensitive out of the base's fit and of its sensitivities.
void holdInsensitive(Calibration& calibration, double sensitive) {
  FitModel& model = calibration.base.fit.model;
  FitModel kept = model;
  kept.parameters.clear();
  kept.values.clear();
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    if (calibration.linear.columns.col(column).norm() < sensitive) {
      calibration.held.push_back(model.parameters[i]);
      continue;
    }
    kept.parameters.push_back(model.parameters[i]);
    kept.values.push_back(model.values[i]);
    columns.push_back(column);
  }
  if (columns.size() == model.parameters.size()) return;
  model = kept;
  for (Eigen::MatrixXd* matrix : {&calibration.linear.columns, &calibration.linear.raw}) {
    const Eigen::MatrixXd left = (*matrix)(Eigen::all, columns);
    *matrix = left;
  }
}

}  // namespace

Scored Calibrator::fitNumbers() const {
  const SearchThresholds::Calibration& limits = service_.thresholds().calibration;
  const FitProblem& problem = service_.problem();
  const FitModel given = givenModel(problem);
  if (given.parameters.empty()) {
    std::vector<Fit> asIs{scoreAsIs(problem, {given, {}, 0}).fit};
    service_.refineStep(asIs, 1, "calibrating", 0.05);
    return scoreAsIs(problem, asIs[0]);
  }
  // From the numbers as given, and from two drawn around them.
  std::vector<FitModel> starts{given, given, given};
  Random random = Random::forPurpose(service_.options().seed, "calibration starts");
  for (std::size_t s = 1; s < starts.size(); ++s)
    for (std::size_t i = 0; i < given.values.size(); ++i) {
      const FitParameter& p = given.parameters[i];
      starts[s].values[i] =
          std::clamp(p.given + limits.startSpread * p.scale * random.uniform(-1, 1), p.minimum, p.maximum);
    }
  std::vector<Fit> fits = service_.fitAll({{given, {}}}, limits.iterations, "calibrating", 0.02, 0.05);
  // ½ a residual is the cost of noise alone: then there is nothing to look for elsewhere.
  if (fits[0].cost > limits.leastForStarts * static_cast<double>(problem.residuals())) {
    const std::vector<Fit> others = completed(
        service_.tryFits({{starts[1], {}}, {starts[2], {}}}, limits.startIterations, "calibrating", 0.05, 0.08));
    fits.insert(fits.end(), others.begin(), others.end());
  }
  std::vector<Fit> best{*std::min_element(fits.begin(), fits.end(), costsLess)};
  if (!problem.walks && fits.size() > 1) restartFromRanges(service_, best[0], "calibrating", 0.08);
  if (problem.walks && fits.size() > 1) restartFromDraws(service_, best[0], "calibrating", 0.08);
  restartInitialStates(service_, best[0], "calibrating", 0.08);
  // A step that was harmless beside the error as given may not be so beside what is left of it.
  service_.refineStep(best, 1, "calibrating", 0.08);
  return service_.scoreAll(best, "calibrating", 0.08, 0.1)[0];
}

Scored Calibrator::asGiven(const std::vector<std::vector<double>>& shifts) const {
  return scoreAsIs(service_.problem(), {givenModel(service_.problem()), shifts, 0});
}

bool Calibrator::isUnstable(const Scored& calibrated) const {
  const SearchThresholds::Calibration& limits = service_.thresholds().calibration;
  const FitProblem& problem = service_.problem();
  const std::vector<double> inside =
      blockScores(problem, residualsOf(problem, calibrated.fit.model, calibrated.fit.shifts), Fold::all);
  double fitted = 0, blocks = 0;
  for (const double block : inside)
    if (block >= 0) {
      fitted += block;
      ++blocks;
    }
  return problem.window_s == 0 && blocks > 0 && calibrated.mean() > limits.unstableRatio * fitted / blocks &&
         calibrated.mean() > limits.unstableError;
}

void Calibrator::finish(Calibration& calibration) const {
  service_.setCalibratedStep();
  calibration.linear = linearise(service_.problem(), calibration.calibrated.fit);
  calibration.uncertainty = uncertaintyOf(service_.problem(), calibration.calibrated.fit, calibration.linear);
  calibration.base = calibration.calibrated;
  holdInsensitive(calibration, service_.thresholds().calibration.sensitive);
}

Calibration Calibrator::calibrate() const {
  Calibration result;
  service_.announce("replaying as given", 0);
  result.given = asGiven({});
  const double givenStep_s = service_.step_s();
  result.calibrated = fitNumbers();
  if (service_.step_s() < givenStep_s) result.given = asGiven(result.given.fit.shifts);
  // Where the fit began a trial may suit the numbers as given, too: what they are worth must not depend on where the
  // search for the initial states began.
  Scored again = asGiven(result.calibrated.fit.shifts);
  if (again.fit.cost < result.given.fit.cost) result.given = std::move(again);
  result.unstable = isUnstable(result.calibrated);
  if (result.unstable) return result;
  // Never worse than what was given.
  if (result.calibrated.mean() >= result.given.mean()) result.calibrated = result.given;
  finish(result);
  return result;
}

std::optional<Calibration> Calibrator::recalibrate(const Calibration& before, const Scored& final) const {
  const std::string stage = "calibrating again";
  constexpr double at = 0.3;
  const SearchThresholds::Confirmation& limits = service_.thresholds().confirmation;
  const Fit& with = final.fit;
  Scored simple = service_.fitAndScore({{with.model.without(0), with.shifts}}, with, stage, at, at)[0];
  if (isMissed(simple, final, limits)) return std::nullopt;
  service_.bringToStep(simple, stage, at);
  if (isMissed(simple, final, limits)) return std::nullopt;

  // Numbers that are held belong to the calibrated simulator, too.
  Fit whole{givenModel(service_.problem()), simple.fit.shifts, simple.fit.cost};
  for (std::size_t i = 0; i < whole.model.parameters.size(); ++i)
    for (std::size_t k = 0; k < simple.fit.model.parameters.size(); ++k)
      if (simple.fit.model.parameters[k].name == whole.model.parameters[i].name)
        whole.model.values[i] = simple.fit.model.values[k];
  Calibration result;
  result.calibrated = service_.scoreAll({whole}, stage, at, at)[0];
  if (result.calibrated.mean() >= before.calibrated.mean()) return std::nullopt;
  result.given = asGiven(before.given.fit.shifts);
  finish(result);
  return result;
}

}  // namespace btr
