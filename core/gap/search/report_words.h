#pragma once
#include <string>

#include "core/gap/search/gap_report.h"
#include "core/spec/figures.h"

namespace btr {

// What a report holds, in a few words.

/// "dry friction at rig.hinge", and what it is a rival together with.
std::string inWords(const GapReport::Rival& rival);
/// Whether rivals would put a number where its own interval does not hold it: more than twice as wide with them.
bool isWiderAmongRivals(const GapReport::Number& number);
/// "[0.047, 0.055]"; an open side is "…".
std::string brief(const GapReport::Interval& interval);
/// "[0.047, 0.055], among rivals [0.02, 0.055]", or "(no interval)".
std::string intervalsOf(const GapReport::Number& number);
/// What the verdict means, a few words.
std::string headline(GapReport::Verdict verdict);
/// False where the simulator as given agrees with the recordings, or they cannot tell.
bool leavesSomethingToAdopt(GapReport::Verdict verdict);
const char* toText(GapReport::Verdict verdict);  ///< "no_mismatch", "parameters_suffice", …

}  // namespace btr
