#pragma once
#include <string>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/search/fit_service.h"

namespace btr {

/// Numbers that were held, and to which a fit is sensitive beside what was added: a servo that saturates with the rotor
/// that was left out only. Fitted again with them where that helps. `at`: share of the search, for progress.
void releaseHeld(const FitService& service, const std::vector<FitParameter>& held, std::vector<Fit>& fits,
                 const std::string& stage, double at);

}  // namespace btr
