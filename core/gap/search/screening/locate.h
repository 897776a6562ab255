#pragma once
#include <vector>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/thresholds.h"

namespace btr {

/// Where the error lies that calibration leaves. Trials are replayed in short windows from the recorded state, so that
/// an error is seen where it is made, not where it has drifted to; the excess of each window over the noise is then
/// shared out over channels and regimes (velocity reversal, low and high speed, high load, saturation, contact,
/// position, time, direction) and compared with the regimes' share of the time.
std::vector<GapReport::Located> locate(const FitModel& calibrated, const FitProblem& problem,
                                       const SearchThresholds::Location& thresholds = {});

}  // namespace btr
