#pragma once
#include <string>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/search/fit_service.h"

namespace btr {

// Whole numbers, as of teeth in a turn, are no parameters of a fit: they are looked for around it. `at`: share of the
// search, for progress.

/// The last effect's whole numbers: neighbours are tried as long as one fits better.
void climbWholeNumbers(const FitService& service, Fit& fit, const std::string& stage, double at);
/// A candidate with a whole number that leaves much, begun in short windows: waves (with an angle of a whole turn) of
/// all numbers, all else as it was `without` the effect; of others the numbers around its own.
void restartWholeNumberInWindows(const FitService& service, Fit& fit, const FitModel& without, const std::string& stage,
                                 double at);

}  // namespace btr
