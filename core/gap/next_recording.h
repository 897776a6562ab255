#pragma once
#include "core/gap/search.h"

namespace btr {

/// The command sequence, among sweeps, steps, slow ramps, fast small sines and holds inside the joints' limits, on
/// which the fitted rivals differ most, in noise floors. None where there are no rivals or no commanded joint.
GapReport::NextRecording designNext(const FitProblem& problem, const SearchResult& found, std::uint64_t seed);

}  // namespace btr
