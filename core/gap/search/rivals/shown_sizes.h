#pragma once
#include <cstddef>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"

namespace btr {

/// How many sizes an effect of a fitted model has: its numbers that have a neutral value.
std::size_t sizesOf(const FitModel& model, std::size_t effect);

/// How many of them the recordings show: those whose 95 % interval leaves the neutral value out.
std::size_t shownSizes(const FitProblem& problem, const Fit& fit, std::size_t effect);

/// True if an effect that contains a simpler one of `simplerSizes` sizes shows no more of them than that one has, or
/// none at all: what would tell it from the simpler one may well be nothing. One that has no more of them but shows
/// them is told by its other numbers.
bool showsNoMoreThan(std::size_t simplerSizes, const FitProblem& problem, const Fit& fit, std::size_t effect);

}  // namespace btr
