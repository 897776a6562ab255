#pragma once
#include <string>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/search/fit_service.h"

namespace btr {

// Where a fit is begun again to leave a side minimum; each keeps what it has unless it finds better. `at`: share of the
// search, for progress. Thresholds: Restarts.

/// The last effect of a model `size` times as large, within its bounds.
FitModel resized(FitModel model, double size);

/// Of each fit, at sizes of its last effect around its own, where a replay is better at once.
void restartAtOtherSizes(const FitService& service, std::vector<Fit>& fits, const std::string& stage, double at);
/// Along the rough valley in which an effect and another number do nearly the same.
void followValley(const FitService& service, Fit& fit, const std::string& stage, double at);
/// The last effect far from its size, its other numbers where they usually are.
void restartFarOff(const FitService& service, Fit& fit, const std::string& stage, double at);
/// With the initial states begun anew of trials in which they got stuck (starts_anew.h).
void restartInitialStates(const FitService& service, Fit& fit, const std::string& stage, double at);

}  // namespace btr
