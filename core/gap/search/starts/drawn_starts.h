#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/screening/tried_candidate.h"

namespace btr {

// Where a fit begins decides where it ends: beginnings drawn all over the ranges, judged by mere replays. `at`: share
// of the search, for progress.

/// Of a walk: the calibrated numbers begun where mere replays, all over their ranges, say that it is best.
void restartFromDraws(const FitService& service, Fit& fit, const std::string& stage, double at);
/// Candidates at joints, where none explains it yet: an effect's own numbers begun so in short windows, all others as
/// one of the fits without it has them.
void restartFromDrawsInWindows(const FitService& service, std::vector<TriedCandidate>& tried,
                               const std::vector<std::size_t>& which, const std::vector<Fit>& without,
                               const std::string& stage, double at);

}  // namespace btr
