#pragma once
#include <QString>

#include "core/spec/nice_steps.h"

namespace btr::ui {

struct AxisRange {
  double from = 0, to = 1;
};
/// Outwards to multiples of `step`.
AxisRange niceRange(double from, double to, double step);

/// "-0", "-0.00": a rounding error below zero, not a number.
bool isNegativeZero(const QString& text);
/// printf format that shows multiples of `step` up to `largest` with as many digits as they need, "%.2f" or "%g".
QString tickFormat(double step, double largest);

}  // namespace btr::ui
