#pragma once
#include "core/gap/recordings/recording.h"

namespace btr {

/// Puts the rows and channels of another file of the same trial behind those of `trial`, each empty where the other
/// has values; orderRows() puts them in order and joins those of one time. Columns of `other` that are no channel are
/// left out. Throws InputError for a channel that both have, and for time stamps, whose beginnings differ.
void appendTable(Recording& trial, const Recording& other);

}  // namespace btr
