#pragma once
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"

namespace btr {

/// Undoes what counters do to numbers, and says so in the notes. Whole numbers whose sign is a bit of its own (32770
/// for −2: values leap by 2ᵏ wherever they change sign) get their sign; positions and commands that begin again after a
/// turn or a power of two of counts go on. Found from the numbers alone: a leap must vanish where it is undone, and the
/// motion must lead up to it. "wrap" and "sign_bit" of the mapping (null for none) say it beforehand. Where position
/// and command of a joint end up turns apart, the followed one is put beside the other.
void mendCounts(Recording& trial, const Mapping* mapping);

}  // namespace btr
