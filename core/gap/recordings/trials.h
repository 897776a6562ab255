#pragma once
#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"

namespace btr {

/// The file as one recording, whatever its mapping says of segments. No mapping: the columns must have channel names.
Recording readRecording(const std::string& path, const Mapping* mapping, std::size_t limit);

/// The rows `first` … `last` − 1 as a recording of their own; its time keeps its zero.
Recording rowsOf(const Recording& recording, std::size_t first, std::size_t last);
/// The rows from one time to another, both counted, in seconds of its own clock.
Recording rowsBetween(const Recording& recording, double from_s, double until_s);

}  // namespace btr
