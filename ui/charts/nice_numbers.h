#pragma once
#include <QString>

namespace btr::ui {

/// The smallest of 1, 2, 2.5, 5 · 10ⁿ that divides `range` into at most `most` steps; 2.5 is left out and nothing below
/// 1 comes if `whole`.
double niceStep(double range, int most, bool whole = false);

struct AxisRange {
  double from = 0, to = 1;
};
/// Outwards to multiples of `step`.
AxisRange niceRange(double from, double to, double step);

/// printf format that shows multiples of `step` up to `largest` with as many digits as they need, "%.2f" or "%g".
/// Multiples of `step` from `from` to `to`.
int ticksWithin(double from, double to, double step);
/// "-0", "-0.00": a rounding error below zero, not a number.
bool isNegativeZero(const QString& text);
QString tickFormat(double step, double largest);

}  // namespace btr::ui
