#pragma once
#include <set>
#include <string>
#include <vector>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/doctor/doctor.h"
#include "core/gap/recordings/recording.h"

namespace btr {

/// Positions of joints that are elsewhere from one sample to the next, far beyond their usual steps: a counter that
/// begins again at a period that nobody knows, a sign in a bit of its own, numbers that were read wrongly. Returns the
/// channels of which nothing more can be said.
std::set<std::string> lookForLeaps(const Recording& recording, const Binding& binding, std::vector<Finding>& findings);

}  // namespace btr
