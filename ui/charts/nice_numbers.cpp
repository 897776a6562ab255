#include "ui/charts/nice_numbers.h"

#include <algorithm>
#include <cmath>

namespace btr::ui {

double niceStep(double range, int most, bool whole) {
  if (!(range > 0) || !std::isfinite(range) || most < 1) return 1;
  const double atLeast = range / most;
  const double power = std::pow(10.0, std::floor(std::log10(atLeast)));
  double step = 10 * power;
  for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
    if (whole && factor == 2.5) continue;
    if (factor * power >= atLeast * (1 - 1e-9)) {
      step = factor * power;
      break;
    }
  }
  return whole ? std::max(1.0, step) : step;
}

AxisRange niceRange(double from, double to, double step) {
  return {std::floor(from / step + 1e-9) * step, std::ceil(to / step - 1e-9) * step};
}

int ticksWithin(double from, double to, double step) {
  return static_cast<int>(std::floor(to / step + 1e-9) - std::ceil(from / step - 1e-9)) + 1;
}

bool isNegativeZero(const QString& text) {
  if (text.size() < 2 || (text[0] != '-' && text[0] != QChar(u'−'))) return false;
  return std::all_of(text.begin() + 1, text.end(), [](QChar c) { return c == '0' || c == '.'; });
}

QString tickFormat(double step, double largest) {
  if (step < 1e-4 || largest >= 1e6) return "%g";
  // A step of 0.25 needs two decimals, one of 0.5 only one.
  int decimals = 0;
  while (decimals < 6 && std::abs(step * std::pow(10, decimals) - std::round(step * std::pow(10, decimals))) > 1e-6)
    ++decimals;
  return QString("%.%1f").arg(decimals);
}

}  // namespace btr::ui
