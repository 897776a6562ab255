#pragma once
#include <string>

#include "core/gap/search/gap_report.h"

namespace btr {

/// A self-contained page for people: the same content with vector plots; prints well.
std::string toHtml(const GapReport& report);

}  // namespace btr
