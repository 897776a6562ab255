#include "core/gap/replay/svg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "core/gap/recordings/doctor/even_grid.h"
#include "core/spec/nice_steps.h"
#include "core/spec/thinning.h"

namespace btr::svg {

std::string number(double value, const char* format) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char byte : text) {
    switch (byte) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&apos;";
        break;
      default:
        // XML knows no control characters.
        result += static_cast<unsigned char>(byte) < 0x20 ? ' ' : byte;
    }
  }
  return result;
}

Axis Range::axis(double from, double to, double margin) const {
  if (!(low <= high)) return {0, 1, from, to};
  const double room = high > low ? margin * (high - low) : std::max(1e-9, 0.1 * std::abs(high));
  return {low - room, high + room, from, to};
}

std::vector<double> ticksOf(const Axis& axis, double wanted) {
  const double step = nearestNiceStep(axis.high - axis.low, wanted);
  std::vector<double> ticks;
  for (double i = std::ceil(axis.low / step); i * step <= axis.high && ticks.size() < 100; ++i)
    ticks.push_back(i * step);
  return ticks;
}

namespace {

/// Rows with a number, cut where more are missing than between the numbers of a sensor that is slower than the table.
std::vector<std::vector<std::size_t>> stretchesOf(const std::vector<double>& values) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i])) rows.push_back(i);
  std::vector<double> apart;
  for (std::size_t k = 1; k < rows.size(); ++k) apart.push_back(static_cast<double>(rows[k] - rows[k - 1]));
  const auto usual = static_cast<std::size_t>(median(std::move(apart)));
  const std::size_t most = usual > 1 ? 2 * usual : 1;
  std::vector<std::vector<std::size_t>> stretches;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (k == 0 || rows[k] - rows[k - 1] > most) stretches.emplace_back();
    stretches.back().push_back(rows[k]);
  }
  return stretches;
}

}  // namespace

std::string pathOf(const std::vector<double>& time, const std::vector<double>& values, const Axis& x, const Axis& y,
                   double bucketsPerPixel) {
  std::string path;
  for (const std::vector<std::size_t>& rows : stretchesOf(values)) {
    bool drawing = false;
    const auto point = [&](std::size_t k) {
      path += (drawing ? "L" : "M") + number(x(time[rows[k]])) + " " + number(y(values[rows[k]]));
      drawing = true;
    };
    const auto bucket = [&](std::size_t k) { return std::floor(bucketsPerPixel * x(time[rows[k]])); };
    const auto value = [&](std::size_t k) { return values[rows[k]]; };
    thin(std::size_t{0}, rows.size(), bucket, value, point);
  }
  return path;
}

std::string text(double x, double y, const std::string& content, const std::string& attributes) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\"" + (attributes.empty() ? "" : " " + attributes) + ">" +
         escaped(content) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const char* kind) {
  return "<line class=\"" + std::string(kind) + "\" x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" +
         number(x2) + "\" y2=\"" + number(y2) + "\"/>\n";
}

std::string panel(const Axis& x, const Axis& y, double wantedY, bool timeNumbers) {
  std::string svg;
  for (const double tick : ticksOf(y, wantedY)) {
    svg += line(x.from, y(tick), x.to, y(tick), std::abs(tick) < 1e-12 ? "zero" : "grid");
    svg += text(x.from - 8, y(tick) + 4, number(std::abs(tick) < 1e-12 ? 0 : tick, "%.6g"), "text-anchor=\"end\"");
  }
  for (const double tick : ticksOf(x, 10)) {
    svg += line(x(tick), y.from, x(tick), y.to, "grid");
    if (timeNumbers)
      svg += text(x(tick), y.from + 18, number(std::abs(tick) < 1e-12 ? 0 : tick, "%.6g"), "text-anchor=\"middle\"");
  }
  svg += "<rect class=\"frame\" x=\"" + number(x.from) + "\" y=\"" + number(y.to) + "\" width=\"" +
         number(x.to - x.from) + "\" height=\"" + number(y.from - y.to) + "\"/>\n";
  return svg;
}

std::string upright(double y, const std::string& content, double x) {
  return text(x, y, content,
              "text-anchor=\"middle\" transform=\"rotate(-90 " + number(x, "%.0f") + " " + number(y) + ")\"");
}

}  // namespace btr::svg
