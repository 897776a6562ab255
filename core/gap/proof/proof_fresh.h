#pragma once
#include <string>
#include <vector>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/gap_report.h"

namespace btr {

/// Root mean square error by channel [its unit] of a report's final simulator (`after`) in recordings that its analysis
/// was never given: replayed as the analysis replayed its own, with the same step and windows, all numbers fixed, only
/// the initial states fitted. Throws InputError for a scene or recordings that cannot be read or replayed.
Values freshErrors(const GapReport& report, const std::string& scene, const std::vector<std::string>& recordings,
                   const EffectLibrary& library);

}  // namespace btr
