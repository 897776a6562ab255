#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "core/gap/residual.h"

namespace btr {
namespace {

// Sizes in the picture's own pixels.
constexpr double width = 960, height = 560, left = 84, right = 24;
constexpr double overlayTop = 84, overlayBottom = 352, errorTop = 388, errorBottom = 504;

/// A number in the picture: short, the same in every locale.
std::string number(double value, const char* format = "%.2f") {
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

/// An interval of values on a stretch of pixels.
struct Axis {
  double low = 0, high = 1, from = 0, to = 1;
  double operator()(double value) const { return from + (value - low) / (high - low) * (to - from); }
};

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  /// With a margin; never empty.
  Axis axis(double from, double to, double margin) const {
    if (!(low <= high)) return {0, 1, from, to};
    const double room = high > low ? margin * (high - low) : std::max(1e-9, 0.1 * std::abs(high));
    return {low - room, high + room, from, to};
  }
};

/// Round numbers 1, 2, 5 · 10ⁿ apart, about `wanted` of them.
std::vector<double> ticksOf(const Axis& axis, double wanted) {
  const double raw = (axis.high - axis.low) / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double rest = raw / power;
  const double step = power * (rest < 1.5 ? 1 : rest < 3.5 ? 2 : rest < 7.5 ? 5 : 10);
  std::vector<double> ticks;
  for (double i = std::ceil(axis.low / step); i * step <= axis.high && ticks.size() < 100; ++i)
    ticks.push_back(i * step);
  return ticks;
}

/// A line that keeps the highest and lowest value of each half pixel; gaps where a value is missing.
std::string pathOf(const std::vector<double>& time, const std::vector<double>& values, const Axis& x, const Axis& y) {
  std::string path;
  bool drawing = false;
  const auto point = [&](std::size_t i) {
    path += (drawing ? "L" : "M") + number(x(time[i])) + " " + number(y(values[i]));
    drawing = true;
  };
  for (std::size_t i = 0; i < values.size();) {
    if (!std::isfinite(values[i])) {
      drawing = false;
      ++i;
      continue;
    }
    // First, lowest, highest and last sample of the bucket, in their order.
    const double bucket = std::floor(2 * x(time[i]));
    std::size_t end = i, lowest = i, highest = i;
    for (; end < values.size() && std::isfinite(values[end]) && std::floor(2 * x(time[end])) == bucket; ++end) {
      if (values[end] < values[lowest]) lowest = end;
      if (values[end] > values[highest]) highest = end;
    }
    std::array<std::size_t, 4> chosen{i, std::min(lowest, highest), std::max(lowest, highest), end - 1};
    for (std::size_t k = 0; k < chosen.size(); ++k)
      if (k == 0 || chosen[k] != chosen[k - 1]) point(chosen[k]);
    i = end;
  }
  return path;
}

std::string text(double x, double y, const std::string& content, const std::string& attributes = "") {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\"" + (attributes.empty() ? "" : " " + attributes) + ">" +
         escaped(content) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const char* kind) {
  return "<line class=\"" + std::string(kind) + "\" x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" +
         number(x2) + "\" y2=\"" + number(y2) + "\"/>\n";
}

/// Frame, grid, numbers; the lower panel also carries the time axis's numbers.
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

std::string upright(double y, const std::string& content) {
  return text(18, y, content, "text-anchor=\"middle\" transform=\"rotate(-90 18 " + number(y) + ")\"");
}

/// "leg.knee.velocity_rad_s" → "velocity": the unit stands behind it in brackets.
std::string plainQuantity(const std::string& channel) {
  const std::string quantity = channel.substr(channel.rfind('.') + 1);
  return unitOfChannel(channel).empty() ? quantity : quantity.substr(0, quantity.find('_'));
}

constexpr const char* style = R"(<style>
text { font: 12px "DejaVu Sans", Verdana, Helvetica, sans-serif; fill: #333 }
.title { font-size: 16px; font-weight: bold; fill: #111 }
.grid { stroke: #e4e4e4; stroke-width: 1 }
.zero { stroke: #9a9a9a; stroke-width: 1 }
.frame { fill: none; stroke: #777; stroke-width: 1 }
.noise { fill: #2a9d5c; fill-opacity: 0.18 }
.recorded { fill: none; stroke: #1f2d3d; stroke-width: 1.8; stroke-linejoin: round }
.simulated { fill: none; stroke: #e4572e; stroke-width: 1.5; stroke-linejoin: round }
.error { fill: none; stroke: #7a3b9c; stroke-width: 1.3; stroke-linejoin: round }
</style>
)";

}  // namespace

std::string overlaySvg(const ChannelError& error) {
  Range times, values, errors;
  std::vector<double> difference(error.time_s.size());
  for (std::size_t i = 0; i < error.time_s.size(); ++i) {
    difference[i] = error.simulated[i] - error.recorded[i];
    times.add(error.time_s[i]);
    values.add(error.recorded[i]);
    values.add(error.simulated[i]);
    errors.add(difference[i]);
  }
  errors.add(0);
  const Axis x = times.axis(left, width - right, 0);
  const Axis y = values.axis(overlayBottom, overlayTop, 0.06);
  const Axis z = errors.axis(errorBottom, errorTop, 0.08);
  const std::string unit = unitOfChannel(error.channel);
  const std::string ofUnit = unit.empty() ? "" : " [" + unit + "]";
  const std::string quantity = plainQuantity(error.channel);
  const std::string behind = unit.empty() ? "" : " " + unit;

  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(width, "%.0f") + " " +
                    number(height, "%.0f") + "\" width=\"" + number(width, "%.0f") + "\" height=\"" +
                    number(height, "%.0f") + "\" role=\"img\">\n" + style +
                    "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  svg += text(left, 30, error.channel, "class=\"title\"");
  svg += text(left, 50,
              std::filesystem::path(error.recording).filename().string() + " · mean |error| " +
                  number(error.meanAbsolute, "%.4g") + behind + ", RMS " + number(error.rootMeanSquare, "%.4g") +
                  behind + ", maximum " + number(error.maximum, "%.4g") + behind);

  // Legend, beside the title.
  svg += "<path class=\"recorded\" d=\"M700 26H728\"/>\n" + text(734, 30, "recorded");
  svg += "<path class=\"simulated\" d=\"M816 26H844\"/>\n" + text(850, 30, "simulated");

  svg += panel(x, y, 6, false);
  svg += "<path class=\"recorded\" d=\"" + pathOf(error.time_s, error.recorded, x, y) + "\"/>\n";
  svg += "<path class=\"simulated\" d=\"" + pathOf(error.time_s, error.simulated, x, y) + "\"/>\n";
  svg += upright((overlayTop + overlayBottom) / 2, quantity + ofUnit);

  svg += panel(x, z, 4, true);
  // The band that the recording cannot resolve.
  const double low = std::max(-error.resolution, z.low), high = std::min(error.resolution, z.high);
  svg += "<rect class=\"noise\" x=\"" + number(x.from) + "\" y=\"" + number(z(high)) + "\" width=\"" +
         number(x.to - x.from) + "\" height=\"" + number(std::max(0.5, z(low) - z(high))) + "\"/>\n";
  svg += "<path class=\"error\" d=\"" + pathOf(error.time_s, difference, x, z) + "\"/>\n";
  svg += upright((errorTop + errorBottom) / 2, "difference" + ofUnit);
  svg += text(left, errorTop - 8, "simulated − recorded; shaded: the recording's noise floor");
  svg += text((x.from + x.to) / 2, height - 16, "time [s]", "text-anchor=\"middle\"");
  return svg + "</svg>\n";
}

}  // namespace btr
