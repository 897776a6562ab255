#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "core/gap/search/gap_report.h"
#include "core/spec/json_reader.h"

namespace btr {

/// [from, to] with null for a side that is open; null where no interval was found.
nlohmann::json toJson(const GapReport::Interval& interval);

/// The same back. Throws InputError, by `reader` for its member `key`, for anything else.
GapReport::Interval intervalFrom(const nlohmann::json& value, const JsonReader& reader, const std::string& key);
/// Of a member of the reader's object; none if it is not there.
GapReport::Interval intervalFrom(JsonReader& reader, const std::string& key);

}  // namespace btr
