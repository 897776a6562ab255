#include "core/spec/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/spec/parameter.h"

namespace btr {

namespace {

std::string written(const char* format, double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

}  // namespace

std::string inWords(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string capital(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}

std::string brief(double value) { return std::isfinite(value) ? written("%.4g", value) : "–"; }

std::string withDeviation(double mean, double deviation) {
  const std::string after = " ± " + (deviation == 0 ? "0" : digits(deviation, 2));
  if (!std::isfinite(mean) || !std::isfinite(deviation) || deviation == 0) return brief(mean) + after;
  // The place of the second digit once it is rounded: 0.0996 is 0.10.
  const double size = std::stod(written("%.1e", deviation));
  const int decimals = 1 - static_cast<int>(std::floor(std::log10(size) + 1e-9));
  constexpr int most = 6;
  if (decimals > most || decimals < 0) return brief(mean) + after;
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f ± %.*f", decimals, mean, decimals, deviation);
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
  const double value = 100 * share;
  return written(std::abs(value) < 9.95 && value != 0 ? "%.1f %%" : "%.0f %%", value);
}

std::string tenthPercent(double share) { return written("%.1f %%", 100 * share); }

std::string signedPercent(double share) { return written("%+.0f %%", 100 * share); }

std::string wholePercent(double share) {
  if (share > 0.995 && share < 1) return "more than 99 %";
  if (share < 0.005 && share > 0) return "less than 1 %";
  return toText(std::round(100 * share)) + " %";
}

}  // namespace btr
