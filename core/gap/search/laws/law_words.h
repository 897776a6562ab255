#pragma once
#include "core/gap/search/gap_report.h"
#include "core/gap/search/laws/law_search.h"

namespace btr {

/// A learned law as the report has it: curves with their bands, the family of its shape, and a sentence on what it
/// depends on, where and how large. `asGiven`, `named`: mean squared errors [noise floors²] of the simulator as given
/// and with the named effects alone.
GapReport::MeasuredLaw inReport(const FitProblem& problem, const LearnedLaw& learned, double asGiven, double named);

}  // namespace btr
