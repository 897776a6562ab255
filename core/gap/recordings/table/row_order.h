#pragma once
#include "core/gap/recordings/recording.h"

namespace btr {

/// Rows in the order of time, one a time. Several topics in one table have rows of the same time, or rows of one topic
/// behind those of another: they are put in order and joined as long as no channel has two values at one time or runs
/// back in time, which throws InputError with both lines. Rows before the first value of an input are left out, which
/// is noted. With `retimed` the rows are samples in the order they have, whatever their stamps say: only rows
/// of one time that complement each other are joined.
void orderRows(Recording& trial, bool retimed);

/// The channel drives something, whatever is driven: a replay needs its value from the first row on.
bool isInputChannel(const std::string& channel);

}  // namespace btr
