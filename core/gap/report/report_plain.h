#pragma once
#include <string>

#include "core/gap/search/gap_report.h"

namespace btr {

/// What a terminal shows: the sentence, the ladder, effects tried, calibrated numbers, errors by channel.
std::string toPlainText(const GapReport& report);

}  // namespace btr
