#pragma once
#include <cstddef>
#include <vector>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/sim/scene.h"

namespace btr {

/// While a joint rests, dry friction carries anything up to its limit, and the drive gives whatever its integral part
/// or the last move has left: the recorded motion does not tell which. Torques of joints that follow their motion are
/// compared while these turn.
///
/// Leaves a joint's torque uncompared (NaN) where it rests (core/sim/rest.h), and where a
/// low-pass filter mixes the rest into what comes before and after. A joint that hardly ever turns keeps all of it: its
/// torque is what it carries, and nothing else tells that. Columns of the torques from which something was taken.
std::vector<std::size_t> leaveOutRests(Recording& recording, const Binding& binding, const Scene& scene);

}  // namespace btr
