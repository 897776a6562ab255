#include "core/gap/report/report_plots.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/gap/recordings/channel_name.h"
#include "core/gap/replay/residual.h"
#include "core/gap/replay/svg.h"
#include "core/gap/report/report_figures.h"
#include "core/gap/report/report_text.h"
#include "core/gap/search/gap_report.h"
#include "core/spec/figures.h"

namespace btr::plots {
namespace {

using namespace svg;

constexpr double width = 860;

std::string whole(double value) { return number(value, "%.0f"); }

std::string picture(double height, const std::string& label, const std::string& content) {
  return "<svg viewBox=\"0 0 " + whole(width) + " " + whole(height) + "\" role=\"img\" aria-label=\"" + escaped(label) +
         "\">\n" + content + "</svg>\n";
}

std::string bar(double x, double y, double w, double h, const char* kind) {
  return "<rect class=\"" + std::string(kind) + "\" x=\"" + number(x) + "\" y=\"" + number(y) + "\" width=\"" +
         number(std::max(0.0, w)) + "\" height=\"" + number(h) + "\"/>\n";
}

std::string path(const std::string& kind, const std::string& d) {
  return d.empty() ? "" : "<path class=\"" + kind + "\" d=\"" + d + "\"/>\n";
}

std::string quantityOf(const std::string& channel, const std::string& unit) {
  const std::string quantity = channel.substr(channel.rfind('.') + 1);
  return (unit.empty() ? quantity : quantity.substr(0, quantity.find('_'))) + (unit.empty() ? "" : " [" + unit + "]");
}

}  // namespace

// Bars on a logarithmic axis, so that the last rung beside the noise floor is as visible as the first.
std::string ladder(const GapReport& report) {
  if (report.ladder.empty()) return "";
  // Names stand above their bars: there is room for the longest of them.
  constexpr double left = 12, right = 70, top = 26, row = 40, label = 18;
  double lowest = 1, highest = 1;
  for (const GapReport::Step& step : report.ladder) {
    if (step.error > 0 && std::isfinite(step.error)) lowest = std::min(lowest, step.error);
    if (std::isfinite(step.error)) highest = std::max(highest, step.error + step.standardError);
  }
  const double bottom = top + row * static_cast<double>(report.ladder.size());
  const Axis x{std::log10(0.8 * lowest), std::log10(1.25 * highest), left, width - right};
  const auto at = [&](double error) {
    return std::isfinite(error) ? x(std::log10(std::max(error, 0.8 * lowest))) : x.to;
  };
  std::string svg;
  for (double decade = std::floor(x.low); decade <= x.high; ++decade)
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double value = digit * std::pow(10, decade), place = std::log10(value);
      if (place < x.low || place > x.high) continue;
      svg += line(x(place), top, x(place), bottom, "grid");
      svg += text(x(place), bottom + 16, number(value, "%.6g"), "text-anchor=\"middle\"");
    }
  double y = top;
  std::string names;  // over the line that they cross
  for (const GapReport::Step& step : report.ladder) {
    names += text(left, y + label - 4, step.what, "class=\"halo\"");
    svg += bar(left, y + label, at(step.error) - left, row - label - 6, step.error <= 1.5 ? "good" : "bar");
    const double low = at(step.error - step.standardError), high = at(step.error + step.standardError);
    const double middle = y + (label + row - 6) / 2;
    if (step.standardError > 0) svg += line(low, middle, high, middle, "whisker");
    svg += text(std::max(high, at(step.error)) + 6, middle + 4, brief(step.error));
    y += row;
  }
  svg += line(at(1), top - 6, at(1), bottom, "floor") + names;
  svg += text(at(1), top - 10, "noise floor", "text-anchor=\"middle\"");
  svg += text((left + width - right) / 2, bottom + 36, "cross-validated error [noise floors, RMS]",
              "text-anchor=\"middle\"");
  return picture(bottom + 44, "Held-out error, step by step", svg);
}

std::string heatMap(const GapReport& report, const std::vector<std::size_t>& trials) {
  constexpr double left = 76, right = 16, rowHeight = 18;
  constexpr std::size_t bins = 80;
  constexpr Simulated kinds[] = {Simulated::asGiven, Simulated::withEffects};
  constexpr const char* names[] = {"as given", "final"};
  const double cell = (width - left - right) / static_cast<double>(bins);
  std::string svg;
  double y = 4;
  for (const std::size_t trial : trials) {
    const GapReport::Trial& t = report.trials[trial];
    svg += text(0, y + 13, t.name + (t.heldOut ? " (held out)" : ""), "class=\"strong\"");
    y += 20;
    for (std::size_t s = 0; s < t.series.size(); ++s) {
      svg += text(left, y + 13, t.series[s].channel);
      y += rowHeight;
      for (std::size_t k = 0; k < 2; ++k) {
        const HeatRow heat = heatRow(report, trial, s, kinds[k], bins);
        svg += text(left - 8, y + 13, names[k], "text-anchor=\"end\"");
        for (std::size_t i = 0; i < bins; ++i) {
          if (!std::isfinite(heat.error[i])) continue;
          const HeatColour colour = heatColour(heat.error[i]);
          svg += "<rect x=\"" + number(left + cell * static_cast<double>(i)) + "\" y=\"" + number(y) + "\" width=\"" +
                 number(cell + 0.3) + "\" height=\"" + whole(rowHeight - 2) + "\" fill=\"rgb(" +
                 std::to_string(colour.red) + "," + std::to_string(colour.green) + "," + std::to_string(colour.blue) +
                 ")\" fill-opacity=\"" + number(colour.opacity) + "\"/>\n";
        }
        svg += bar(left, y, width - left - right, rowHeight - 2, "frame");
        y += rowHeight;
      }
    }
    if (!t.time_s.empty()) {
      const Axis x{t.time_s.front(), std::max(t.time_s.back(), t.time_s.front() + 1e-9), left, width - right};
      for (const double tick : ticksOf(x, 8))
        svg += text(x(tick), y + 13, number(tick, "%.6g") + " s", "text-anchor=\"middle\"");
    }
    y += 26;
  }
  // The scale.
  double x = left + 140;
  svg += text(left, y + 13, "error [noise floors]");
  for (const double error : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    const HeatColour colour = heatColour(error);
    svg += "<rect x=\"" + number(x) + "\" y=\"" + number(y) + "\" width=\"26\" height=\"16\" fill=\"rgb(" +
           std::to_string(colour.red) + "," + std::to_string(colour.green) + "," + std::to_string(colour.blue) +
           ")\" fill-opacity=\"" + number(colour.opacity) + "\"/>\n";
    svg += bar(x, y, 26, 16, "frame");
    svg += text(x + 32, y + 13, (error == 1 ? "≤ " : error == 50 ? "≥ " : "") + number(error, "%.0f"));
    x += 74;
  }
  return trials.empty() ? "" : picture(y + 22, "Standardised error by channel and time", svg);
}

std::string overlay(const GapReport& report, std::size_t trial, std::size_t series, bool calibrated) {
  constexpr double left = 84, right = 16, top = 44, middle = 250, errorTop = 268, bottom = 350;
  const GapReport::Trial& t = report.trials[trial];
  const GapReport::Series& s = t.series[series];
  Range times, values, errors;
  for (const double time : t.time_s) times.add(time);
  for (const CurveName& curve : curveNames)
    if (calibrated || curve.values != &GapReport::Series::calibrated)
      for (const double value : s.*curve.values) values.add(value);
  const auto difference = [&](const std::vector<double>& simulated) {
    std::vector<double> error(std::min(simulated.size(), s.recorded.size()));
    for (std::size_t i = 0; i < error.size(); ++i) error[i] = simulated[i] - s.recorded[i];
    for (const double e : error) errors.add(e);
    return error;
  };
  const std::vector<double> before = difference(s.asGiven), after = difference(s.withEffects),
                            between = calibrated ? difference(s.calibrated) : std::vector<double>{};
  errors.add(0);
  if (times.low > times.high) return "";
  const Axis x = times.axis(left, width - right, 0);
  const Axis y = values.axis(middle, top, 0.06), z = errors.axis(bottom, errorTop, 0.08);

  std::string svg = text(left, 16, s.channel + " · " + t.name + (t.heldOut ? " (held out)" : ""), "class=\"strong\"");
  double legend = left;
  for (const auto& [kind, name] : {std::pair{"recorded", "recorded"}, std::pair{"asgiven", "as given"},
                                   std::pair{"calibrated", "calibrated"}, std::pair{"repaired", "with effects"}}) {
    if (!calibrated && std::string_view(kind) == "calibrated") continue;
    svg += path(kind, "M" + whole(legend) + " 31H" + whole(legend + 26)) + text(legend + 32, 35, name);
    legend += 130;
  }
  svg += panel(x, y, 5, false);
  svg += path("recorded", pathOf(t.time_s, s.recorded, x, y, 1));
  svg += path("asgiven", pathOf(t.time_s, s.asGiven, x, y, 1));
  if (calibrated) svg += path("calibrated", pathOf(t.time_s, s.calibrated, x, y, 1));
  svg += path("repaired", pathOf(t.time_s, s.withEffects, x, y, 1));
  svg += upright((top + middle) / 2, quantityOf(s.channel, s.unit), 14);
  svg += panel(x, z, 3, true);
  if (s.noiseFloor > 0) {
    const double high = z(std::min(s.noiseFloor, z.high)), low = z(std::max(-s.noiseFloor, z.low));
    svg += bar(left, high, width - left - right, std::max(0.5, low - high), "noise");
  }
  svg += path("asgiven", pathOf(t.time_s, before, x, z, 1));
  if (calibrated) svg += path("calibrated", pathOf(t.time_s, between, x, z, 1));
  svg += path("repaired", pathOf(t.time_s, after, x, z, 1));
  svg += upright((errorTop + bottom) / 2, "difference", 14);
  svg += text((left + width - right) / 2, bottom + 36, "time [s]", "text-anchor=\"middle\"");
  return picture(bottom + 42, "Recorded and simulated " + s.channel, svg);
}

std::string regimes(const GapReport::Located& located) {
  if (located.regimes.empty()) return "";
  constexpr double left = 200, right = 130, row = 28;
  const Axis x{0, 1, left, width - right};
  std::string svg =
      text(left, 14, "share of the excess error", "class=\"strong\"") + text(left + 190, 14, "share of the time");
  double y = 22;
  for (const GapReport::Regime& r : located.regimes) {
    svg += text(left - 10, y + 15, inWords(r.name), "text-anchor=\"end\"");
    svg += bar(left, y + 1, x(std::clamp(r.shareOfExcess, 0.0, 1.0)) - left, 13, "bar");
    svg += bar(left, y + 15, x(std::clamp(r.shareOfTime, 0.0, 1.0)) - left, 6, "time");
    const double end = x(std::clamp(std::max(r.shareOfExcess, r.shareOfTime), 0.0, 1.0));
    svg += text(end + 8, y + 14, percent(r.shareOfExcess) + ", p = " + number(r.pValue, "%.2g"));
    y += row;
  }
  return picture(y + 4, "Where the error of " + located.channel + " lies", svg);
}

std::string lawCurve(const GapReport::LawCurve& c, const std::string& at) {
  if (c.x.empty()) return "";
  constexpr double left = 84, right = 16, top = 14, bottom = 230;
  Range xs, ys;
  for (const double value : c.x) xs.add(value);
  for (const std::vector<double>* side : {&c.y, &c.low, &c.high})
    for (const double value : *side) ys.add(value);
  ys.add(0);
  const Axis x = xs.axis(left, width - right, 0), y = ys.axis(bottom, top, 0.06);
  std::string there, back;
  for (std::size_t i = 0; i < std::min({c.x.size(), c.low.size(), c.high.size()}); ++i) {
    if (!std::isfinite(c.low[i]) || !std::isfinite(c.high[i])) continue;
    there += (there.empty() ? "M" : "L") + number(x(c.x[i])) + " " + number(y(c.high[i]));
    back = "L" + number(x(c.x[i])) + " " + number(y(c.low[i])) + back;
  }
  const auto withUnit = [](const std::string& name, const std::string& unit) {
    return name + (unit.empty() ? "" : " [" + unit + "]");
  };
  std::string svg = panel(x, y, 5, true) + path("band", there.empty() ? "" : there + back + "Z") +
                    path("repaired", pathOf(c.x, c.y, x, y, 1));
  svg += upright((top + bottom) / 2, withUnit("force", c.unitY), 14);
  svg += text((left + width - right) / 2, bottom + 36, withUnit(c.on + " at " + at, c.unitX), "text-anchor=\"middle\"");
  return picture(bottom + 44, "What has no name: a force over " + c.on, svg);
}

std::string remainder(const GapReport::Remainder& r) {
  if (r.on.empty()) return "";
  GapReport::LawCurve curve{r.on, r.unitX, r.unitY, r.x, r.y, r.y, r.y};
  for (std::size_t i = 0; i < r.y.size(); ++i) {
    const double margin = i < r.standardError.size() ? 1.96 * r.standardError[i] : 0;
    curve.low[i] -= margin;
    curve.high[i] += margin;
  }
  return lawCurve(curve, r.at);
}

std::string nextRecording(const GapReport::NextRecording& next) {
  if (next.columns.size() < 2 || next.columns[0].size() < 2) return "";
  constexpr double left = 84, right = 16, row = 18;
  const std::size_t shown = std::min<std::size_t>(3, next.columns.size() - 1);  // in the legend
  const double top = 16 + row * static_cast<double>(shown), bottom = top + 186;
  constexpr const char* kinds[] = {"asgiven", "calibrated", "repaired", "recorded"};
  Range times, values;
  for (const double time : next.columns[0]) times.add(time);
  for (std::size_t i = 1; i < next.columns.size(); ++i)
    for (const double value : next.columns[i]) values.add(value);
  const Axis x = times.axis(left, width - right, 0), y = values.axis(bottom, top, 0.06);
  std::string svg = panel(x, y, 5, true);
  for (std::size_t i = 1; i < next.columns.size() && i < next.channels.size(); ++i) {
    const double place = row * static_cast<double>(i);
    if (i <= shown)
      svg += path(kinds[i - 1], "M" + whole(left) + " " + whole(place - 6) + "h26") +
             text(left + 32, place - 2, next.channels[i]);
    svg += path(kinds[(i - 1) % 4], pathOf(next.columns[0], next.columns[i], x, y, 1));
  }
  const std::string unit = unitOfChannel(next.channels[1]);
  svg += upright((top + bottom) / 2, "command" + (unit.empty() ? "" : " [" + unit + "]"), 14);
  svg += text((left + width - right) / 2, bottom + 36, "time [s]", "text-anchor=\"middle\"");
  return picture(bottom + 44, "The suggested next recording", svg);
}

std::string chain(const std::vector<EffectLaw::Acts>& marked, bool ofBall) {
  using Acts = EffectLaw::Acts;
  struct Link {
    Acts acts;
    const char* name;
  };
  const std::vector<Link> robot{{Acts::command, "command"}, {Acts::drive, "drive"},  {Acts::gear, "gear"},
                                {Acts::joint, "joint"},     {Acts::link, "link"},    {Acts::gravity, "gravity"},
                                {Acts::contact, "contact"}, {Acts::sensor, "sensor"}};
  const std::vector<Link> ball{
      {Acts::gravity, "gravity"}, {Acts::air, "air"}, {Acts::contact, "contact"}, {Acts::sensor, "camera"}};
  const std::vector<Link>& links = ofBall ? ball : robot;
  constexpr double top = 6, height = 30, gap = 22, left = 2;
  const double wide = (width - 2 * left + gap) / static_cast<double>(robot.size()) - gap;
  std::string svg, said;
  double x = left;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const bool isMarked = std::ranges::find(marked, links[i].acts) != marked.end();
    if (i > 0) svg += line(x - gap + 4, top + height / 2, x - 4, top + height / 2, "zero");
    svg += bar(x, top, wide, height, isMarked ? "marked" : "frame");
    svg += text(x + wide / 2, top + height / 2 + 4, links[i].name,
                isMarked ? "text-anchor=\"middle\" class=\"strong\"" : "text-anchor=\"middle\"");
    if (isMarked) said += (said.empty() ? "" : ", ") + std::string(links[i].name);
    x += wide + gap;
  }
  return said.empty() ? "" : picture(top + height + 6, "What was left out acts at: " + said, svg);
}

}  // namespace btr::plots
