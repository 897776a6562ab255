#pragma once
#include "core/gap/fit/fit_problem.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/search.h"
#include "core/gap/search/thresholds.h"

namespace btr {

/// Writes verdict and sentence of a report that has everything else. `curveIsBetter`: see remainder.h.
void judge(GapReport& report, const FitProblem& problem, const SearchResult& found, bool curveIsBetter,
           const SearchThresholds& thresholds = {});

}  // namespace btr
