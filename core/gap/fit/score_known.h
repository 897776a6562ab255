#pragma once
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/score.h"

namespace btr {

/// crossValidate() of a fit whose sensitivities are known: they are most of its work.
Scored crossValidate(const FitProblem& problem, const Fit& fit, const Linearised& linear);

}  // namespace btr
