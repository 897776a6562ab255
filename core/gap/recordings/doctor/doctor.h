#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"

namespace btr {

/// Something that the columns say of how they are read.
struct Finding {
  std::string channel;   ///< that it is about
  std::string text;      ///< in words, with its evidence and with what to change in the mapping
  bool certain = false;  ///< no physics does that: whatever is compared with this channel would mean nothing
  /// What is certain is not where the channel follows in another recording that was read in the same way: beyond its
  /// resonance a joint moves against its command, too.
  bool refutable = false;
};

/// What one recording's columns say.
struct Diagnosis {
  std::vector<Finding> findings;
  std::vector<std::string> following;  ///< position channels that move with their command
};

/// Whether the columns can be what their names say, by comparing what was commanded with what was measured at each
/// joint that follows positions: wrong units (degrees, millimetres, milliseconds), turned signs, joints mixed up, a
/// constant offset of the encoder that no load explains, a clock that is ahead, a position that never changes. Nothing
/// is changed. A joint whose command hardly moves, or where the evidence is ambiguous (the joints move alike, one fast
/// sine), gives none.
Diagnosis doctor(const Scene& scene, const Recording& recording, const Binding& binding);

}  // namespace btr
