#pragma once
#include "core/gap/fit/fit_problem.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/search.h"
#include "core/gap/search/thresholds.h"

namespace btr {

/// The command sequence, among sweeps, steps, slow ramps, fast small sines and holds, on which the fitted rivals differ
/// most, in noise floors. Positions stay inside the joints' limits; a joint that is pushed (by a force, a duty, a
/// voltage) stays, in both simulators, where the recordings saw it. None where there are no rivals or no such joint.
/// Where even that differs by less than `thresholds.leastSeparation`, `why` says so.
GapReport::NextRecording designNext(const FitProblem& problem, const SearchResult& found, std::uint64_t seed,
                                    const SearchThresholds::NextRecording& thresholds = {});

}  // namespace btr
