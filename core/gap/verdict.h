#pragma once
#include "core/gap/search.h"

namespace btr {

/// Writes verdict and sentence of a report that has everything else. `curveIsBetter`: see remainder.h.
void judge(GapReport& report, const FitProblem& problem, const SearchResult& found, bool curveIsBetter);

}  // namespace btr
