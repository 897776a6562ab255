#pragma once
#include <vector>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/doctor/doctor.h"
#include "core/gap/recordings/recording.h"

namespace btr {

/// Positions that were recorded where the model's joint cannot go: it is simulated with stops there, and whatever the
/// recording does beyond them would look like physics that is missing.
void lookAtRanges(const Scene& scene, const Recording& recording, const Binding& binding,
                  std::vector<Finding>& findings);

}  // namespace btr
