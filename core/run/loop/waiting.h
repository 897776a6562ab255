#pragma once
#include <string>
#include <vector>

#include "core/store/database.h"

namespace btr {

/// "measurement stage 1: 2 of 4 individuals wait for real fitness"; empty if nobody waits and some value counts.
std::string waitingText(int stage, int iteration, int missing, int all, bool anyCounts);

/// In what a run says that waits for recordings, of which no entered value tells anything.
inline constexpr const char* waitForRecording = " wait for a recording";

/// What the run says about itself, brought up to date: values may have been entered since it last worked.
/// What a robot that failed said holds until the first of them.
std::string messageNow(const Database& database, const RunRecord& run);

}  // namespace btr
