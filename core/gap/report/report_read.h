#pragma once
#include <string>
#include <vector>

#include "core/gap/search/gap_report.h"

namespace btr {

/// The report without what stands in tables beside it: the values of the series and the next commands. `overlays` are
/// the files of the trials, by trial. Throws InputError; `place` begins the message.
GapReport reportFromJson(const std::string& text, const std::string& place, std::vector<std::string>& overlays);

}  // namespace btr
