#pragma once
#include <cstddef>
#include <functional>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/search/screening/candidates.h"
#include "core/gap/search/thresholds.h"

namespace btr {

/// How one candidate would do: a score test. The excess residual is regressed on what the candidate changes, together
/// with the sensitivities of the parameters that are fitted already and of the initial states.
struct Screened {
  std::size_t candidate = 0;
  bool excited = false;  ///< the recordings are sensitive to it at a typical size
  int refused = 0;       ///< sizes at which there is no such scene
  double share = 0;      ///< of the sum of squared residuals that it would take away
  struct Start {
    Values effect;
    std::vector<double> parameters;  ///< of the model, moved along to where they would go
    double share = 0;
  };
  std::vector<Start> starts;  ///< the best that was looked at, then what others promise, best first; none: no
                              ///< size changes anything
};
/// In the order of the candidates. Candidates of a model that cannot be simulated are not excited.
std::vector<Screened> screen(const FitProblem& problem, const Fit& fit, const Linearised& linear,
                             const std::vector<EffectCandidate>& candidates, int jobs,
                             const std::function<bool(std::size_t)>& goOn = {},
                             const SearchThresholds::Screening& thresholds = {});

}  // namespace btr
