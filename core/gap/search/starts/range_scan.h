#pragma once
#include <string>

#include "core/gap/fit/fit.h"
#include "core/gap/search/fit_service.h"

namespace btr {

/// The calibrated numbers begun elsewhere in their ranges, where mere replays say that a fit may end better. A number
/// that acts only across a threshold (a restitution of a ball that was given as dead, friction that always holds, a
/// torque limit that is never reached) has no slope where it is given, and no fit from there finds it. Each number is
/// moved over its whole range, all others as given and as `fit` has them, and all together over a Latin hypercube; the
/// best few that lie apart are fitted. `fit` stays where none ends better. Bounded work, the same for a seed with any
/// number of jobs. `at`: share of the search, for progress. Thresholds: Calibration.
void restartFromRanges(const FitService& service, Fit& fit, const std::string& stage, double at);

}  // namespace btr
