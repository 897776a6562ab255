#pragma once
#include "core/gap/recordings/recording.h"

namespace btr {

/// Empties the rows in which a joint's sensor hung: from one reading to the next it is still at exactly one value, in
/// full motion, and then either leaps to where the joint is, or the recording ends, the command going on; or, however
/// it stopped, it stays to the end while the command goes over half of its range. What brakes, rests, sticks or leans
/// on something leaves otherwise, and is left alone. Notes say where.
void emptyFrozen(Recording& trial);

}  // namespace btr
