#include "core/gap/recordings/doctor/marked_missing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/doctor/command_by_position.h"
#include "core/gap/recordings/extent.h"
#include "core/gap/recordings/table/row_order.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

/// What is written where there is no value: nines, the ends of whole numbers of 16 and 32 bits, the largest numbers.
bool isInUse(double written) {
  constexpr std::array known{999.0,   999.9,   999.99,  9999.0,       99999.0,      999999.0,
                             32767.0, 32768.0, 65535.0, 2147483647.0, 2147483648.0, 4294967295.0};
  constexpr double huge = 1e30, same = 1e-6;
  const double size = std::abs(written);
  return size >= huge || std::ranges::any_of(known, [&](double each) { return std::abs(size - each) < same; });
}

bool isPlace(const std::string& channel) {
  const std::string quantity = parseChannel(channel)->quantity;
  return quantity == "position_rad" || quantity == "position_m" || quantity == "x_m" || quantity == "y_m" ||
         quantity == "z_m";
}

struct Marker {
  double value = 0;
  bool isFar = false;  ///< more than twice the range of all others away from them
};

/// The lowest or highest number of a column, if it is no value of the motion that the others are.
std::optional<Marker> markerAmong(const std::vector<double>& values, bool highest) {
  constexpr std::size_t leastTimes = 2, leastOthers = 20;
  constexpr double timesRange = 2, timesStep = 20;
  Extent all, others;
  for (const double value : values)
    if (std::isfinite(value)) all.add(value);
  if (!all.some()) return std::nullopt;
  const double marker = highest ? all.high : all.low;
  std::size_t times = 0, count = 0;
  double largestStep = 0, before = NAN;
  bool inside = false;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    if (value == marker) {
      times += !inside;
      inside = true;
      before = NAN;
      continue;
    }
    inside = false;
    others.add(value);
    ++count;
    if (std::isfinite(before)) largestStep = std::max(largestStep, std::abs(value - before));
    before = value;
  }
  if (times < leastTimes || count < leastOthers) return std::nullopt;
  const double away = highest ? marker - others.high : others.low - marker;
  const double range = others.high - others.low;
  if (range <= 0 || away < timesStep * largestStep) return std::nullopt;
  return Marker{marker, away > timesRange * range};
}

std::size_t empty(std::vector<double>& values, double marker) {
  std::size_t emptied = 0;
  for (double& value : values) {
    if (value != marker) continue;
    value = NAN;
    ++emptied;
  }
  return emptied;
}

}  // namespace

void emptyMarked(Recording& trial, const Mapping* mapping) {
  for (std::size_t column = 1; column < trial.channels.size(); ++column) {
    const std::string& channel = trial.channels[column];
    if (!parseChannel(channel)) continue;
    const MappedColumn* mapped = mappedColumn(mapping, channel);
    const double scale = mapped ? mapped->scale : 1, offset = mapped ? mapped->offset : 0;
    std::vector<double>& values = trial.columns[column];
    if (mapped && mapped->missing) {
      if (std::isfinite(*mapped->missing)) empty(values, scale * *mapped->missing + offset);
      continue;
    }
    for (const bool highest : {true, false}) {
      const std::optional<Marker> marker = markerAmong(values, highest);
      if (!marker) continue;
      const double written = (marker->value - offset) / scale;
      if (!isInUse(written) && !(marker->isFar && isPlace(channel) && !isInputChannel(channel))) continue;
      const std::size_t rows = empty(values, marker->value);
      trial.notes.push_back(channel + ": " + toText(std::round(1e6 * written) / 1e6) + " stands in " +
                            std::to_string(rows) +
                            " cells, beside all others and with none between: taken for \"no value\" (\"missing\": "
                            "false in the mapping leaves it as it stands)");
    }
  }
}

}  // namespace btr
