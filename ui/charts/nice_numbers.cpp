#include "ui/charts/nice_numbers.h"

#include <algorithm>
#include <cmath>

namespace btr::ui {

AxisRange niceRange(double from, double to, double step) {
  return {std::floor(from / step + 1e-9) * step, std::ceil(to / step - 1e-9) * step};
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
