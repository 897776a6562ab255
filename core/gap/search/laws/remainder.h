#pragma once
#include "core/gap/fit/fit_problem.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/search.h"
#include "core/gap/search/thresholds.h"

namespace btr {

/// What named effects leave, learned without a name: a generalised force at a joint as a piecewise linear curve over
/// position, velocity, command error (load) or time; at a ball a force along its motion or the floor's axes. The curve
/// that takes most of the rest on blocks that it was not fitted to is kept if a paired test says so.
GapReport::Remainder findRemainder(const FitProblem& problem, const SearchResult& found, int jobs,
                                   const SearchThresholds& thresholds = {});

/// True if such a curve by itself predicts held-out blocks clearly better than the named effects that were found, which
/// then are names for something else.
bool aCurveDoesBetter(const FitProblem& problem, const SearchResult& found, int jobs,
                      const SearchThresholds& thresholds = {});

}  // namespace btr
