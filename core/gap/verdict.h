#pragma once
#include "core/gap/search.h"

namespace btr {

/// Writes verdict and sentence of a report that has everything else.
void judge(GapReport& report, const FitProblem& problem, const SearchResult& found);

}  // namespace btr
