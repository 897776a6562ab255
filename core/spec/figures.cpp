#include "core/spec/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/spec/parameter.h"

namespace btr {

std::string inWords(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string brief(double value) {
  if (!std::isfinite(value)) return "–";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g", value);
  return text.data();
}

std::string digits(double value, int count) {
  std::array<char, 32> text{};
  // 870, not 8.7e+02.
  if (const double size = std::abs(value); size >= std::pow(10, count) - 0.5 && size < 1e9) {
    const double unit = std::pow(10, std::floor(std::log10(size)) - count + 1);
    std::snprintf(text.data(), text.size(), "%.0f", std::round(value / unit) * unit);
  } else {
    std::snprintf(text.data(), text.size(), "%.*g", count, value);
  }
  return text.data();
}

std::string percent(double share) {
  if (!std::isfinite(share)) return "–";
  std::array<char, 32> text{};
  const double value = 100 * share;
  std::snprintf(text.data(), text.size(), std::abs(value) < 9.95 && value != 0 ? "%.1f %%" : "%.0f %%", value);
  return text.data();
}

std::string wholePercent(double share) { return toText(std::round(100 * share)) + " %"; }

}  // namespace btr
