#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

namespace btr {

/// A time of day, on a date or not.
struct TimeStamp {
  std::int64_t second = 0;  ///< since 1970-01-01T00:00:00Z, or since midnight
  double fraction = 0;      ///< of a second, 0 to 1
  bool dated = false;
  bool hasZone = false;  ///< says how far its clock is from UTC; else it is taken for UTC
};

/// ISO 8601: "2026-11-27T14:03:01.25Z", "2026-11-27 14:03:01,250+01:00", "14:03:01.25"; a date may also be written
/// "27.11.2026". Nothing for anything else, such as a month 13 or an hour 24.
std::optional<TimeStamp> readTimeStamp(std::string_view text);

}  // namespace btr
