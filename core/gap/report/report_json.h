#pragma once
#include <string>

#include "core/gap/search/gap_report.h"

namespace btr {

/// The report as report.json (resources/manual/formats/gap-report.md). Without the series, which are in
/// overlay/*.csv.
std::string toJsonText(const GapReport& report);

}  // namespace btr
