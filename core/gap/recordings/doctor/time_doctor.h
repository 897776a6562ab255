#pragma once
#include <vector>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/doctor/doctor.h"
#include "core/gap/recordings/recording.h"

namespace btr {

/// Times a thousand times too long or too short, stamps that jitter while the values do not, velocities that are no
/// slopes of their positions. What is certain of time comes first.
void lookAtTime(const Recording& recording, const Binding& binding, std::vector<Finding>& findings);

}  // namespace btr
