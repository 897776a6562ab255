#pragma once
#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"

namespace btr {

/// The same fit with the initial states of its worst segments (far above the noise, and above most of the others)
/// looked for from elsewhere, too; the parameters stay.
Fit withStartsAnew(const FitProblem& problem, const Fit& fit);

}  // namespace btr
