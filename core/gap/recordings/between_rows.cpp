#include "core/gap/recordings/between_rows.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/gap/recordings/doctor/even_grid.h"

namespace btr {
namespace {

/// What drives by its size: not whether a servo is on, and not a path that is followed anyway.
bool moves(const Binding::Input& input) {
  using What = Binding::Input::What;
  return input.what == What::command || input.what == What::duty || input.what == What::volts ||
         input.what == What::supply;
}

/// Whether a column goes on from `row` to the next one as it does before and behind.
bool isSmoothFrom(const std::vector<double>& values, std::size_t row) {
  constexpr double as = 0.5;  // of the change that its neighbours promise
  if (row == 0 || row + 2 >= values.size()) return false;
  const double change = values[row + 1] - values[row];
  const double promised = (values[row] - values[row - 1] + values[row + 2] - values[row + 1]) / 2;
  return std::isfinite(change) && change != 0 &&
         std::abs(change - promised) <= as * std::max(std::abs(change), std::abs(promised));
}

/// Most of what changes goes on.
bool isSmooth(const std::vector<double>& values) {
  constexpr double most = 0.5;
  constexpr std::size_t enough = 30;
  std::size_t changes = 0, smooth = 0;
  for (std::size_t row = 0; row + 1 < values.size(); ++row) {
    if (!(values[row + 1] != values[row]) || !std::isfinite(values[row + 1] - values[row])) continue;
    ++changes;
    smooth += isSmoothFrom(values, row);
  }
  return smooth >= enough && static_cast<double>(smooth) > most * static_cast<double>(changes);
}

}  // namespace

double inputFrom(const Recording& recording, const Binding::Input& input, std::size_t row) {
  const std::vector<double>& values = recording.columns[input.column];
  const double ahead = recording.betweenRows.value_or(0);
  if (ahead == 0 || !moves(input) || !isSmoothFrom(values, row)) return values[row];
  return values[row] + ahead * (values[row + 1] - values[row]);
}

bool mayGoOnBetweenRows(const Scene& scene, const Recording& recording, const Binding& binding) {
  constexpr double same = 0.1;  // of a row, by which its period may be the controller's
  constexpr std::size_t enough = 30;
  const std::vector<double>& time = recording.columns[0];
  if (recording.betweenRows || time.size() < enough) return false;
  std::vector<double> steps;
  for (std::size_t row = 1; row < time.size(); ++row) steps.push_back(time[row] - time[row - 1]);
  const double row_s = median(std::move(steps));
  if (std::abs(scene.controlPeriod_s - row_s) <= same * row_s) return false;
  return std::ranges::any_of(binding.inputs, [&](const Binding::Input& input) {
    return moves(input) && isSmooth(recording.columns[input.column]);
  });
}

}  // namespace btr
