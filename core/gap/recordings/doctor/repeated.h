#pragma once
#include "core/gap/recordings/recording.h"

namespace btr {

/// Empties measurements that only repeat the one before, where a sensor measures more slowly than it is read: what is
/// compared is then a new value where it came, not an old one later. Such a sensor shows itself in motion: several
/// counts at once, after rows of exactly the same value, which no sensor does that measures in every row; or its counts
/// change in every n-th row only. What rests is kept as often as the sensor measures. A body's place and attitude count
/// as one sensor. Inputs are left alone, as they hold anyway. Notes say so, and Recording::thinned has the channels.
void emptyRepeated(Recording& trial);

}  // namespace btr
