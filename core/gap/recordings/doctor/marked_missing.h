#pragma once
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"

namespace btr {

/// Empties cells that hold a number in the place of "no value", as loggers write −999 or 65535, and says so in the
/// notes. The mapping's "missing" names it. Otherwise it is found: the same number, again and again, farther from all
/// others than twenty of their steps, and none between. Numbers that are in use for that; of positions, which cannot
/// jump, any that is more than twice the range of all others away.
void emptyMarked(Recording& trial, const Mapping* mapping);

}  // namespace btr
