// Fits and scores of many models at once.
#include <algorithm>
#include <cmath>

#include "core/gap/search_run.h"

namespace btr {
namespace {

std::vector<double> packed(const Fit& fit) {
  std::vector<double> numbers{fit.cost};
  numbers.insert(numbers.end(), fit.model.values.begin(), fit.model.values.end());
  for (const auto& shift : fit.shifts) numbers.insert(numbers.end(), shift.begin(), shift.end());
  return numbers;
}

/// Back from numbers; false if the job failed.
bool unpack(const std::vector<double>& numbers, const FitProblem& problem, Fit& fit) {
  if (numbers.empty()) return false;
  std::size_t at = 0;
  fit.cost = numbers[at++];
  for (double& value : fit.model.values) value = numbers[at++];
  fit.shifts.clear();
  for (const Segment& segment : problem.segments) {
    fit.shifts.emplace_back(numbers.begin() + static_cast<std::ptrdiff_t>(at),
                            numbers.begin() + static_cast<std::ptrdiff_t>(at + segment.nuisances.size()));
    at += segment.nuisances.size();
  }
  return true;
}

}  // namespace

std::vector<Fit> SearchRun::fitAll(const std::vector<FitModel>& models, const std::vector<std::vector<double>>& shifts,
                                int iterations, const std::string& stage, double from, double to,
                                const Linearised* inherited) const {
  const auto numbers = parallel(
      options_.jobs, models.size(),
      [&](std::size_t i) {
        return packed(fitModel(problem_, models[i], shifts, {iterations, Fold::all, false, inherited}));
      },
      reporter(stage, models.size(), from, to));
  std::vector<Fit> fits;
  for (std::size_t i = 0; i < models.size(); ++i) {
    Fit fit{models[i], {}, INFINITY};
    if (!unpack(numbers[i], problem_, fit)) fit.cost = INFINITY;
    fits.push_back(std::move(fit));
  }
  return fits;
}

std::vector<Scored> SearchRun::scoreAll(const std::vector<Fit>& fits, const std::string& stage, double from,
                                     double to) const {
  const auto numbers = parallel(
      options_.jobs, fits.size(),
      [&](std::size_t i) {
        const Scored scored = crossValidate(problem_, fits[i]);
        std::vector<double> list = scored.blocks;
        list.insert(list.end(), scored.heldOut.begin(), scored.heldOut.end());
        list.insert(list.end(), scored.sizes.begin(), scored.sizes.end());
        return list;
      },
      reporter(stage, fits.size(), from, to));
  std::vector<Scored> result;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    Scored scored{fits[i], std::vector<double>(static_cast<std::size_t>(problem_.blocks), 1e6),
                  Eigen::VectorXd::Constant(static_cast<Eigen::Index>(problem_.residuals()), 1e3),
                  std::vector<double>(fits[i].model.effects.size(), 0)};
    if (!numbers[i].empty()) {
      const auto blocks = static_cast<std::ptrdiff_t>(scored.blocks.size()), sizes = std::ssize(scored.sizes);
      scored.blocks.assign(numbers[i].begin(), numbers[i].begin() + blocks);
      std::copy(numbers[i].begin() + blocks, numbers[i].end() - sizes, scored.heldOut.begin());
      scored.sizes.assign(numbers[i].end() - sizes, numbers[i].end());
    }
    result.push_back(std::move(scored));
  }
  return result;
}

double SearchRun::stepError(const Fit& fit) const {
  FitProblem finer = problem_;
  finer.scene.step_s /= 2;
  const Eigen::VectorXd change =
      residualsOf(problem_, fit.model, fit.shifts) - residualsOf(finer, fit.model, fit.shifts);
  return change.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, change.size()));
}

bool SearchRun::needsFinerStep(const Fit& fit) const {
  constexpr double hidden = 0.12;  // noise floors
  const Eigen::VectorXd here = residualsOf(problem_, fit.model, fit.shifts);
  const double error = std::sqrt(here.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, here.size())));
  // Where much is unexplained anyway, the step is not what matters.
  return std::sqrt(stepError(fit)) > std::max(hidden, 0.05 * error);
}

std::vector<Fit> SearchRun::polish(const std::vector<Fit>& fits, int iterations, const std::string& stage, double from,
                                double to) const {
  const auto numbers = parallel(
      options_.jobs, fits.size(),
      [&](std::size_t i) {
        return packed(fitModel(problem_, fits[i].model, fits[i].shifts, {iterations, Fold::all, false}));
      },
      reporter("confirming" + stage, fits.size(), from, to));
  std::vector<Fit> polished = fits;
  for (std::size_t i = 0; i < fits.size(); ++i) unpack(numbers[i], problem_, polished[i]);
  return polished;
}

}  // namespace btr
