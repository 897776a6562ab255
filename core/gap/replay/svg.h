#pragma once
#include <string>
#include <vector>

#include "core/gap/recordings/extent.h"

/// The few pieces that our vector plots are made of. Texts are escaped, numbers are the same in every locale; the looks
/// come from the classes that the page or picture styles.
namespace btr::svg {

/// A number in the picture: short, the same in every locale.
std::string number(double value, const char* format = "%.2f");
/// For XML and HTML: the five special characters; control characters become spaces.
std::string escaped(const std::string& text);

/// An interval of values on a stretch of pixels.
struct Axis {
  double low = 0, high = 1, from = 0, to = 1;
  double operator()(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

/// Of values that a picture shows.
struct Range : Extent {
  /// With a margin; never empty.
  Axis axis(double from, double to, double margin) const;
};

/// Round numbers 1, 2, 5 · 10ⁿ apart, about `wanted` of them.
std::vector<double> ticksOf(const Axis& axis, double wanted);
/// A line that keeps first, lowest, highest and last value of each bucket; gaps where a value is missing.
std::string pathOf(const std::vector<double>& time, const std::vector<double>& values, const Axis& x, const Axis& y,
                   double bucketsPerPixel = 2);
std::string text(double x, double y, const std::string& content, const std::string& attributes = "");
std::string line(double x1, double y1, double x2, double y2, const char* kind);
/// Frame, grid, numbers; `timeNumbers` for those of the x axis too.
std::string panel(const Axis& x, const Axis& y, double wantedY, bool timeNumbers);
/// A text that reads upwards beside a panel.
std::string upright(double y, const std::string& content, double x = 18);

}  // namespace btr::svg
