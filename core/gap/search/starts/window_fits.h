#pragma once
#include <string>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/thresholds.h"

namespace btr {

// Fits that begin in short windows: over whole trials a wrong number leads far away, and a fit into the next hollow.

/// The problem cut into windows of that length [s]: a motion that begins anew in each stays near the recorded one,
/// whatever is wrong. As many from all over the recordings as are replayed in a short time, each with the samples that
/// there must be to know its beginning.
FitProblem cutShort(const FitProblem& problem, double length_s, const SearchThresholds::Restarts& limits);

/// Fits from windows of that length [s], gone on with in ever longer ones and at last over whole trials from `shifts`.
/// `at`: share of the search, for progress.
std::vector<Fit> fitInLongerWindows(const FitService& service, std::vector<Fit> fits, double length_s,
                                    const std::vector<std::vector<double>>& shifts, const std::string& stage,
                                    double at);

}  // namespace btr
