#pragma once
#include "core/gap/fit/fit_problem.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/search.h"

namespace btr {

/// A difference [noise floors, RMS] that the 1000 samples of a designed recording tell: three standard errors of one
/// number, √1000 × 0.1.
inline constexpr double leastSeparation = 0.1;

/// The command sequence, among sweeps, steps, slow ramps, fast small sines and holds, on which the fitted rivals differ
/// most, in noise floors. Positions stay inside the joints' limits; a joint that is pushed (by a force, a duty, a
/// voltage) stays, in both simulators, where the recordings saw it. None where there are no rivals or no such joint.
/// Where even that differs by less than `leastSeparation`, `why` says so.
GapReport::NextRecording designNext(const FitProblem& problem, const SearchResult& found, std::uint64_t seed);

}  // namespace btr
