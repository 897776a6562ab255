#pragma once
#include <string>

#include "core/gap/search/gap_report.h"

namespace btr {

/// Writes report.json, report.html, simulator.json, overlay/TRIAL.csv (time_s, then CHANNEL:recorded, :as_given,
/// :calibrated, :with_effects), next_command.csv where there is one, remainder.csv. Each file is replaced at once,
/// report.json last; then what an earlier report left there and this one does not have is removed, nothing else. Throws
/// InputError if the folder cannot be made or written.
void writeReport(const GapReport& report, const std::string& folder);
/// Reads such a folder back, whole. Throws InputError.
GapReport loadReport(const std::string& folder);

}  // namespace btr
