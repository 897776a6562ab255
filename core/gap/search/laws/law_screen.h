#pragma once
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/search/laws/law_terms.h"
#include "core/gap/search/thresholds.h"

namespace btr {

/// A curve that a law could have, as a first number of knots sees it.
struct LawOption {
  Law law;           ///< what stands already, and the curve with its first values, the last of its terms
  double share = 0;  ///< of the squared residuals that it would take away, of trials that it was not fitted to
};

/// All curves over the quantities of the joints that are off, beside what `there` has already (an empty law: nothing):
/// residuals are regressed on what each knot changes, together with the sensitivities of all that is fitted and of the
/// initial states, rough curves at a price that other trials choose (blocks, where there are less than three). The most
/// promising ones first; those that promise nothing are left out. `named`: the model without law; `fit`: with `there`.
std::vector<LawOption> screenLaws(const FitProblem& problem, const FitModel& named, const Fit& fit,
                                  const Linearised& linear, const Law& there, int jobs,
                                  const SearchThresholds::Law& thresholds);

/// The last term of a law over as many knots as it may have, its values regressed once more.
LawOption refineTerm(const FitProblem& problem, const FitModel& named, const Fit& fit, const Linearised& linear,
                     const Law& there, const LawOption& option, int jobs, const SearchThresholds::Law& thresholds);

/// The same curve with more knots in its last term, over all that the recordings reach now that the curve is where it
/// belongs: what is passed only for a moment counts less beside a motion that is simulated wrongly. `fit`: with `law`.
Law denserLaw(const FitProblem& problem, const FitModel& named, const Fit& fit, const Linearised& linear,
              const Law& law, int jobs, const SearchThresholds::Law& thresholds);

}  // namespace btr
