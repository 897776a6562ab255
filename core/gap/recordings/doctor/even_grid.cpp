#include "core/gap/recordings/doctor/even_grid.h"

#include <algorithm>
#include <cmath>

namespace btr {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<double> onGrid(std::span<const double> time, std::span<const double> values, double start, double period,
                           std::size_t count) {
  std::vector<double> grid(count, 0);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i])) rows.push_back(i);
  if (rows.empty()) return grid;
  std::size_t right = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = start + static_cast<double>(i) * period;
    while (right + 1 < rows.size() && time[rows[right]] < t) ++right;
    const std::size_t b = rows[right], a = rows[right > 0 ? right - 1 : 0];
    const double share = b > a ? std::clamp((t - time[a]) / (time[b] - time[a]), 0.0, 1.0) : 0;
    grid[i] = values[a] + share * (values[b] - values[a]);
  }
  return grid;
}

}  // namespace btr
