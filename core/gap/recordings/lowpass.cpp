#include "core/gap/recordings/lowpass.h"

#include <algorithm>
#include <cmath>

#include "core/spec/require.h"

namespace btr {

LowPass::LowPass(int order, double cutoff_hz, double rate_hz)
    : padding_(static_cast<std::size_t>(std::ceil(3 * rate_hz / cutoff_hz))) {
  require(order > 0 && order % 2 == 0 && cutoff_hz > 0 && cutoff_hz < rate_hz / 2,
          "a low-pass filter of even order that cuts off below half of the sampling rate");
  const double k = std::tan(M_PI * cutoff_hz / rate_hz);
  for (int i = 0; i < order / 2; ++i) {
    const double damping = 2 * std::cos((2 * i + 1) * M_PI / (2 * order));
    const double scale = 1 / (1 + damping * k + k * k);
    sections_.push_back({k * k * scale, 2 * (k * k - 1) * scale, (1 - damping * k + k * k) * scale});
  }
}

void LowPass::run(std::vector<double>& values) const {
  for (const Section& section : sections_) {
    // Before the first value it has always been there: at rest the section gives what it gets.
    double x1 = values.front(), x2 = x1, y1 = x1, y2 = x1;
    for (double& value : values) {
      const double y = section.gain * (value + 2 * x1 + x2) - section.a1 * y1 - section.a2 * y2;
      x2 = x1;
      x1 = value;
      y2 = y1;
      y1 = y;
      value = y;
    }
  }
}

std::vector<double> LowPass::zeroPhase(std::span<const double> values) const {
  if (values.empty()) return {};
  const std::size_t count = values.size(), padding = std::min(padding_, count - 1);
  std::vector<double> longer;
  longer.reserve(count + 2 * padding);
  for (std::size_t i = padding; i > 0; --i) longer.push_back(2 * values.front() - values[i]);
  longer.insert(longer.end(), values.begin(), values.end());
  for (std::size_t i = 1; i <= padding; ++i) longer.push_back(2 * values.back() - values[count - 1 - i]);
  for (int direction = 0; direction < 2; ++direction) {
    run(longer);
    std::reverse(longer.begin(), longer.end());
  }
  const auto first = longer.begin() + static_cast<std::ptrdiff_t>(padding);
  return {first, first + static_cast<std::ptrdiff_t>(count)};
}

}  // namespace btr
