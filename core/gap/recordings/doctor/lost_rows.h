#pragma once
#include <cstddef>
#include <vector>

#include "core/gap/recordings/recording.h"

namespace btr {

/// Puts rows that a logger lost back into a trial with a steady rhythm: the robot got the commands of those times
/// though nobody wrote them down. Commands and other inputs are taken from a straight line between their neighbours
/// where these go on as before and behind, measurements stay empty. Where a commanded position steps meanwhile, nobody
/// knows when: what the same robot's joints do for some time afterwards is left out of the comparison. Rows are lost
/// where stamps miss whole periods, at several places, and keep their rhythm, in tables whose rows all have the inputs;
/// any other pause is left as it is, with inputs that hold. Notes say so.
/// `driving` are columns that drive a joint of the scene though their names do not say so (a torque).
void fillLostRows(Recording& trial, const std::vector<std::size_t>& driving = {});

}  // namespace btr
