#include "core/gap/report/interval_json.h"
#include "core/gap/search/gap_report.h"

#include <cmath>
#include <limits>

namespace btr {

nlohmann::json toJson(const GapReport::Interval& interval) {
  if (!interval.known()) return {};
  const auto side = [](double value) { return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(); };
  return nlohmann::json::array({side(interval.low), side(interval.high)});
}

GapReport::Interval intervalFrom(const nlohmann::json& value, const JsonReader& reader, const std::string& key) {
  if (value.is_null()) return GapReport::Interval::none();
  const auto side = [&](const nlohmann::json& number, double open) {
    if (number.is_null()) return open;
    if (!number.is_number()) reader.refuse(key, "two numbers, from and to");
    return number.get<double>();
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (!value.is_array() || value.size() != 2) reader.refuse(key, "two numbers, from and to");
  return {side(value[0], -infinity), side(value[1], infinity)};
}

GapReport::Interval intervalFrom(JsonReader& reader, const std::string& key) {
  const nlohmann::json* value = reader.any(key);
  return value ? intervalFrom(*value, reader, key) : GapReport::Interval::none();
}

}  // namespace btr
