#pragma once
#include <map>
#include <string>

#include "core/gap/recordings/mapping.h"
#include "core/gap/recordings/recording.h"

namespace btr {

/// Commands jump, so that their numbers alone do not show where a counter begins again or a sign bit is set. The
/// joint's position does, once that is mended: a command whose sign bit, read as a sign, or whose whole turns, added,
/// bring it beside the position, is read so, and a note says it. `followed` are the periods of the channels that were
/// followed already [the channel's unit]; the mapping's "wrap" and "sign_bit" stand.
void readCommandsByPosition(Recording& trial, const Mapping* mapping, const std::map<std::string, double>& followed);

/// The number with its sign, where bit `bit` is that; other numbers as they are.
double withSign(double number, int bit);

/// What a mapping says of a channel, nullptr for nothing.
const MappedColumn* mappedColumn(const Mapping* mapping, const std::string& channel);

}  // namespace btr
