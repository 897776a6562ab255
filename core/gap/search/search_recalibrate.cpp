// An effect that only showed the calibration its way.
#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/search/search_run.h"

namespace btr {

// Calibration may stop in a side minimum, where a number that matters elsewhere (a servo's largest torque) is not felt
// and held. With an effect, whatever it is, the fit goes on from there, and the effect earns what is the number's.
bool SearchRun::calibrateFrom(SearchResult& result) {
  const std::string stage = "calibrating again";
  constexpr double at = 0.3;
  const Fit& with = result.final.fit;
  Scored alone = fitAndScore({{with.model.without(0), with.shifts}}, with, stage, at, at)[0];
  if (isMissed(alone, result.final, limits().confirmation)) return false;
  bringToStep(alone, stage, at);
  if (isMissed(alone, result.final, limits().confirmation)) return false;

  // Numbers that are held belong to the calibrated simulator, too.
  Fit whole{givenModel(problem_), alone.fit.shifts, alone.fit.cost};
  for (std::size_t i = 0; i < whole.model.parameters.size(); ++i)
    for (std::size_t k = 0; k < alone.fit.model.parameters.size(); ++k)
      if (alone.fit.model.parameters[k].name == whole.model.parameters[i].name)
        whole.model.values[i] = alone.fit.model.values[k];
  const Scored calibrated = scoreAll({whole}, stage, at, at)[0];
  if (calibrated.mean() >= result.calibrated.mean()) return false;

  for (Attempt& attempt : result.attempts)
    if (attempt.accepted) {
      attempt.accepted = false;
      attempt.reason = "useless once the calibrated numbers were fitted from where it left them";
    }
  result.calibrated = result.final = calibrated;
  search_s_ = problem_.scene.step_s;
  result.given = scoreAsIs(problem_, {givenModel(problem_), result.given.fit.shifts, 0});
  result.ladder = {step("as given", result.given), step("calibrated", calibrated)};
  result.calibratedLinear = linearise(problem_, calibrated.fit);
  result.calibratedUncertainty = uncertaintyOf(problem_, calibrated.fit, result.calibratedLinear);
  held_.clear();
  holdUntold(result);
  return true;
}

}  // namespace btr
