#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/replay/overlay.h"
#include "core/gap/replay/residual.h"
#include "core/gap/replay/svg.h"

namespace btr {
namespace {

using namespace svg;

// Sizes in the picture's own pixels.
constexpr double width = 960, height = 560, left = 84, right = 24;
constexpr double overlayTop = 84, overlayBottom = 352, errorTop = 388, errorBottom = 504;

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
