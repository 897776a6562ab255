#include "core/gap/recordings/sample_speed.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/gap/recordings/doctor/even_grid.h"

namespace btr {

std::vector<double> sampleSpeeds(const Recording& recording, std::size_t column, double noise) {
  const std::vector<double>& values = recording.columns[column];
  std::vector<double> speeds(values.size(), NAN), steps;
  std::vector<std::size_t> samples;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!std::isfinite(values[row])) continue;
    if (!samples.empty()) steps.push_back(recording.columns[0][row] - recording.columns[0][samples.back()]);
    samples.push_back(row);
  }
  if (samples.size() < 2) return speeds;
  const double period_s = median(std::move(steps));
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, samples.size() - 1);
    const double change = values[samples[after]] - values[samples[before]];
    speeds[samples[i]] = std::sqrt(std::max(0.0, change * change - 2 * noise * noise)) /
                         (static_cast<double>(after - before) * period_s);
  }
  return speeds;
}

}  // namespace btr
