#include "core/gap/search/rivals/shown_sizes.h"

#include <cmath>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/uncertainty.h"

namespace btr {
namespace {

bool isSizeOf(const FitParameter& parameter, std::size_t effect) {
  return parameter.effect == static_cast<int>(effect) && parameter.hasNeutral;
}

}  // namespace

std::size_t sizesOf(const FitModel& model, std::size_t effect) {
  std::size_t sizes = 0;
  for (const FitParameter& parameter : model.parameters) sizes += isSizeOf(parameter, effect);
  return sizes;
}

std::size_t shownSizes(const FitProblem& problem, const Fit& fit, std::size_t effect) {
  const Uncertainty uncertainty = uncertaintyOf(problem, fit, linearise(problem, fit));
  std::size_t shown = 0;
  for (std::size_t i = 0; i < fit.model.parameters.size(); ++i) {
    const FitParameter& parameter = fit.model.parameters[i];
    shown += isSizeOf(parameter, effect) && std::abs(fit.model.values[i] - parameter.given) > uncertainty.half95(i);
  }
  return shown;
}

bool showsNoMoreThan(std::size_t simplerSizes, const FitProblem& problem, const Fit& fit, std::size_t effect) {
  const std::size_t sizes = sizesOf(fit.model, effect), shown = shownSizes(problem, fit, effect);
  return shown == 0 || (sizes > simplerSizes && shown <= simplerSizes);
}

}  // namespace btr
