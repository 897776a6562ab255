// report.html: one file without any reference to another, for the screen (light or dark) and for paper.
#include <algorithm>
#include <cmath>

#include "core/gap/replay/svg.h"
#include "core/gap/report/equation.h"
#include "core/gap/report/report_figures.h"
#include "core/gap/report/report_html.h"
#include "core/gap/report/report_lead.h"
#include "core/gap/report/report_plots.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/report_words.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

using svg::escaped;

constexpr std::size_t mostOverlays = 12, mostHeatTrials = 8;

constexpr const char* head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Gap report</title>
<style>
:root { color-scheme: light dark; --text: #1c1f23; --faint: #5c636b; --line: #d9dce0; --back: #fff; --soft: #f4f5f7;
  --recorded: #1f2d3d; --asgiven: #d1541a; --calibrated: #b07700; --repaired: #0b6bb3; --good: #15825e }
@media (prefers-color-scheme: dark) { :root { --text: #e6e8ea; --faint: #a4abb3; --line: #3b4046; --back: #1b1d20;
  --soft: #25282c; --recorded: #e6e8ea; --asgiven: #ff9060; --calibrated: #f0c050; --repaired: #5bb0f0; --good: #4fcf9f } }
@media print { :root { color-scheme: light; --text: #000; --faint: #444; --line: #ccc; --back: #fff; --soft: #f4f5f7;
  --recorded: #1f2d3d; --asgiven: #d1541a; --calibrated: #b07700; --repaired: #0b6bb3; --good: #15825e }
  section, figure, tr { break-inside: avoid } h2 { break-after: avoid } body { font-size: 10pt } }
body { font: 15px/1.5 "DejaVu Sans", Verdana, Helvetica, sans-serif; color: var(--text); background: var(--back);
  max-width: 900px; margin: 2em auto; padding: 0 1.2em }
h1 { font-size: 1.5em; margin: 0 } h2 { font-size: 1.15em; margin: 2em 0 .5em; border-bottom: 1px solid var(--line) }
.verdict { font-size: 1.08em; padding: .4em 1em; margin: 1em 0; background: var(--soft); border-left: 4px solid var(--repaired) }
.verdict.bad { border-color: var(--asgiven) } .equation, .verdict li i, .verdict li sub, .verdict li sup { font-family: "DejaVu Serif", Georgia, serif }
h3 { font-size: 1em; margin: 1.4em 0 .2em } .marked { fill: var(--repaired); fill-opacity: .25; stroke: var(--repaired); stroke-width: 2 }
table { border-collapse: collapse; width: 100%; font-size: .87em } th, td { text-align: left; padding: .3em .6em .3em 0;
  border-bottom: 1px solid var(--line); vertical-align: top } td.n, th.n { text-align: right; font-variant-numeric: tabular-nums }
.wide { overflow-x: auto } .no td { color: var(--faint) } .faint, figcaption { color: var(--faint); font-size: .87em }
figure { margin: 1em 0 } svg { width: 100%; height: auto; display: block } code { overflow-wrap: anywhere; font-size: .87em }
svg text { font: 12px "DejaVu Sans", Verdana, Helvetica, sans-serif; fill: var(--text) } svg .strong { font-weight: bold }
svg .halo { paint-order: stroke; stroke: var(--back); stroke-width: 4px; stroke-linejoin: round }
.grid { stroke: var(--line) } .zero { stroke: var(--faint) } .frame { fill: none; stroke: var(--line) }
.bar { fill: var(--asgiven) } .good { fill: var(--good) } .time { fill: var(--faint); opacity: .5 }
.whisker { stroke: var(--text); stroke-width: 1.5 } .floor { stroke: var(--good); stroke-width: 1.6; stroke-dasharray: 5 3 }
.noise { fill: var(--good); opacity: .22 } .band { fill: var(--repaired); opacity: .2 }
.recorded, .asgiven, .calibrated, .repaired { fill: none; stroke-width: 1.4; stroke-linejoin: round }
.recorded { stroke: var(--recorded); stroke-width: 2 } .asgiven { stroke: var(--asgiven) }
.calibrated { stroke: var(--calibrated) } .repaired { stroke: var(--repaired) }
</style></head><body>
)";

std::string cell(const std::string& content, bool isNumber = false) {
  return std::string(isNumber ? "<td class=\"n\">" : "<td>") + escaped(content) + "</td>";
}
std::string numberCell(double value) { return cell(brief(value), true); }

/// Name, unit and remark of a fitted number, its values, and how well they are known.
std::string numberRow(const GapReport::Number& n, const std::string& values) {
  const char* remark = !n.excited ? "not identifiable from these recordings" : n.atBound ? "at its bound" : "";
  return "<tr>" + cell(n.name) + cell(n.unit) + cell(remark) + values +
         cell(n.ci95.known() ? brief(n.ci95) : "–", true) +
         cell(n.amongRivals.known() ? brief(n.amongRivals) : "–", true) + "</tr>\n";
}

std::string headerRow(std::initializer_list<const char*> names, std::size_t words) {
  std::string row = "<tr>";
  std::size_t i = 0;
  for (const char* name : names) row += (i++ < words ? "<th>" : "<th class=\"n\">") + std::string(name) + "</th>";
  return row + "</tr>\n";
}

std::string figure(const std::string& plot, const std::string& caption) {
  if (plot.empty()) return "";
  return "<figure>" + plot + "<figcaption>" + escaped(caption) + "</figcaption></figure>\n";
}

/// Only bodies that roll, fly or are tossed were recorded.
bool hasNoJoints(const GapReport& report) {
  return std::ranges::none_of(report.trials, [](const GapReport::Trial& trial) {
    return std::ranges::any_of(
        trial.series, [](const auto& series) { return series.channel.find(".position_") != std::string::npos; });
  });
}

/// An effect that was found: where it acts, its law, its numbers, what it took and what competes with it.
std::string effectCard(const GapReport& report, const ReportLead::Finding& finding) {
  const GapReport::Effect& e = report.tried[finding.effect];
  std::string html = "<section><h3>" + escaped(capital(inWords(e.effect, e.at))) + "</h3>\n" +
                     figure(plots::chain({e.law.acts}, hasNoJoints(report)), "");
  if (!e.law.says.empty())
    html += "<p>" + escaped(capital(e.law.says)) + ":</p>\n<p class=\"equation\">" + equationHtml(e.law.equation) +
            "</p>\n<p class=\"faint\">" + escaped(e.law.symbols) + " (" + escaped(e.law.source) + ")</p>\n";
  html += "<div class=\"wide\"><table>" +
          headerRow({"parameter", "unit", "remark", "value", "95 % interval", "among rivals"}, 3);
  for (const GapReport::Number& n : e.parameters) html += numberRow(n, numberCell(n.value));
  html += "</table></div>\n<p>";
  html += escaped(withoutInWords(e));
  for (std::size_t i = 0; i < e.rivals.size(); ++i)
    html += (i ? ", " : " These recordings cannot tell it from ") + escaped(inWords(e.rivals[i])) + " (error × " +
            escaped(brief(e.rivals[i].heldoutErrorRatio)) + ")";
  return html + (e.rivals.empty() ? "" : ".") + "</p></section>\n";
}

std::string parametersText(const GapReport::Effect& e) {
  std::string text;
  for (const GapReport::Number& n : e.parameters) text += (text.empty() ? "" : "; ") + inWordsWithRivals(n);
  return text;
}

std::string effectsTable(const GapReport& report) {
  if (report.tried.empty()) return "<p>No effect was tried.</p>\n";
  std::string html =
      "<div class=\"wide\"><table>" + headerRow({"effect", "at", "verdict and reason", "cannot be told from",
                                                 "cross-validated gain", "p", "q", "screening"},
                                                4);
  for (const GapReport::Effect& e : report.tried) {
    std::string rivals;
    for (const GapReport::Rival& r : e.rivals)
      rivals += (rivals.empty() ? "" : "; ") + inWords(r) + " (error × " + brief(r.heldoutErrorRatio) + ")";
    const std::string parameters = parametersText(e);
    html += std::string(e.accepted ? "<tr>" : "<tr class=\"no\">") + cell(inWords(e.effect)) + cell(e.at) + "<td>" +
            (e.accepted ? "<b>accepted</b>" : "rejected") + (e.reason.empty() ? "" : ": " + escaped(e.reason)) +
            (parameters.empty() ? "" : "<br><span class=\"faint\">" + escaped(parameters) + "</span>") + "</td>" +
            cell(rivals) + cell(percent(e.heldoutErrorReduction), true) + numberCell(e.pValue) + numberCell(e.qValue) +
            cell(e.screenRank > 0 ? std::to_string(e.screenRank) + " (" + percent(e.screenShare) + ")" : "–", true) +
            "</tr>\n";
  }
  return html +
         "</table></div>\n<p class=\"faint\">Gain: 1 − error with it / error without, cross-validated. p: paired test "
         "on "
         "that error by blocks; q: p adjusted for all effects at all places that were looked at together (false "
         "discovery rate).</p>\n";
}

std::string calibratedTable(const GapReport& report) {
  if (report.calibrated.empty()) return "<p>The scene names no number to calibrate.</p>\n";
  std::string html = "<div class=\"wide\"><table>" +
                     headerRow({"number", "unit", "remark", "as given", "fitted", "95 % interval", "among rivals"}, 3);
  for (const GapReport::Number& n : report.calibrated) html += numberRow(n, numberCell(n.before) + numberCell(n.value));
  html += "</table></div>\n";
  if (std::ranges::any_of(report.calibrated, isWiderAmongRivals))
    html +=
        "<p class=\"faint\">95 % interval: with the accepted effects taken for granted. Among rivals: from end to end "
        "of "
        "that interval and of those with each rival in the place of its effect.</p>\n";
  if (!report.strongCorrelations.empty()) {
    html += "<p class=\"faint\">Hardly separated by these recordings: ";
    for (std::size_t i = 0; i < report.strongCorrelations.size(); ++i)
      html += (i ? "; " : "") + escaped(report.strongCorrelations[i]);
    html += ".</p>\n";
  }
  return html;
}

std::string channelsTable(const GapReport& report) {
  std::string html =
      "<div class=\"wide\"><table>" + headerRow({"channel", "unit", "noise floor", "as given", "calibrated",
                                                 "with effects", "mean |error| with effects", "step error"},
                                                2);
  bool heldOut = false;
  for (const GapReport::Channel& c : report.channels) {
    html += "<tr>" + cell(c.name) + cell(c.unit) + numberCell(c.noiseFloor) + numberCell(c.asGiven) +
            numberCell(c.calibrated) + numberCell(c.withEffects) + numberCell(c.maeWithEffects) +
            numberCell(c.stepError) + "</tr>\n";
    heldOut = heldOut || c.heldoutAsGiven != 0 || c.heldoutCalibrated != 0 || c.heldoutWithEffects != 0;
  }
  html +=
      "</table></div>\n<p class=\"faint\">Root mean square, cross-validated: alternate blocks of the trials predict "
      "each other, with the numbers as either half would have them (one linear step from the fit to everything). "
      "Initial states and the choice of effects come from everything; only held-out recordings are new to all of "
      "it.</p>\n";
  if (!heldOut) return html;
  html +=
      "<div class=\"wide\"><table>" + headerRow({"channel, held-out recordings", "unit", "RMS as given", "calibrated",
                                                 "with effects", "mean |error| as given", "calibrated", "with effects"},
                                                2);
  for (const GapReport::Channel& c : report.channels)
    html += "<tr>" + cell(c.name) + cell(c.unit) + numberCell(c.heldoutAsGiven) + numberCell(c.heldoutCalibrated) +
            numberCell(c.heldoutWithEffects) + numberCell(c.heldoutMaeAsGiven) + numberCell(c.heldoutMaeCalibrated) +
            numberCell(c.heldoutMaeWithEffects) + "</tr>\n";
  html += "</table></div>\n";
  for (const GapReport::Channel& c : report.channels)
    if (c.heldoutNoiseFloor > 0)
      html += "<p class=\"faint\">" + escaped(c.name) +
              ": stamps jitter, so its noise grows with its speed; its floor is " + brief(c.heldoutNoiseFloor) + " " +
              escaped(c.unit) + " in the held-out recordings.</p>\n";
  return html;
}

/// Held-out trials first, then those that were worst as given; at most so many.
std::vector<std::pair<std::size_t, std::size_t>> chosenOverlays(const GapReport& report) {
  struct Choice {
    std::size_t trial, series;
    double error;
  };
  std::vector<Choice> all;
  for (std::size_t t = 0; t < report.trials.size(); ++t)
    for (std::size_t s = 0; s < report.trials[t].series.size(); ++s) {
      const double error = heatRow(report, t, s, Simulated::asGiven, 1).error[0];
      all.push_back({t, s, std::isfinite(error) ? error : 0});
    }
  std::stable_sort(all.begin(), all.end(), [&](const Choice& a, const Choice& b) {
    const bool first = report.trials[a.trial].heldOut, second = report.trials[b.trial].heldOut;
    return first != second ? first : a.error > b.error;
  });
  std::vector<std::pair<std::size_t, std::size_t>> chosen;
  for (const Choice& choice : all)
    if (chosen.size() < mostOverlays) chosen.emplace_back(choice.trial, choice.series);
  return chosen;
}

std::string locatedSection(const GapReport& report) {
  std::string html;
  for (const GapReport::Located& l : report.located) {
    html += "<p><b>" + escaped(l.channel) + "</b>: " + percent(l.shareOfExcess) + " of the excess error";
    if (!l.when.empty()) html += ", most of it at " + escaped(inWords(l.when));
    if (!l.dependsOn.empty()) html += "; it depends on " + escaped(l.dependsOn.front());
    for (std::size_t i = 1; i < l.dependsOn.size(); ++i) html += ", " + escaped(l.dependsOn[i]);
    html += ".";
    for (std::size_t i = 0; i < l.windows.size() && i < 5; ++i) {
      const GapReport::Window& w = l.windows[i];
      html += (i ? "; " : " Largest: ") +
              escaped(w.recording < report.trials.size() ? report.trials[w.recording].name : "?") + " " +
              brief(w.time_s.low) + "–" + brief(w.time_s.high) + " s";
    }
    html += "</p>\n" + figure(plots::regimes(l), "Excess error of " + l.channel + " by regime, after calibration.");
  }
  return html.empty() ? "<p>No error stands out above the noise floor after calibration.</p>\n" : html;
}

std::string remainderSection(const GapReport& report) {
  std::string html = "<section><h2>What remains</h2>\n<p>The accepted effects explain " +
                     percent(report.remainder.explainedShare) + " of the excess error that calibration leaves.";
  if (report.law.known()) {
    const GapReport::MeasuredLaw& law = report.law;
    html += " What is left: " + escaped(law.sentence) + ". It takes " + percent(law.shareOfRest) +
            " of the rest (p = " + brief(law.pValue) + "): the error falls from " + brief(law.errorWithout) + " to " +
            brief(law.error) + " noise floors, cross-validated.</p>\n";
    for (const GapReport::LawCurve& curve : law.curves)
      html += figure(plots::lawCurve(curve, law.at), "Measured law with its 95 % band.");
    return html + "</section>\n";
  }
  if (report.remainder.on.empty()) return html + " Nothing significant is left.</p></section>\n";
  return html + " A force over " + escaped(report.remainder.on) + " at " + escaped(report.remainder.at) +
         " takes away " + percent(report.remainder.shareOfRest) +
         " of the rest (p = " + brief(report.remainder.pValue) + "). It has no name here.</p>\n" +
         figure(plots::remainder(report.remainder), "Learned force with its 95 % band.") + "</section>\n";
}

std::string provenance(const GapReport& report) {
  std::string html = "<p>UCHILSIM " + escaped(report.version) + ", seed " + std::to_string(report.seed) + ", " +
                     brief(report.seconds) + " s.</p>\n<div class=\"wide\"><table>" +
                     headerRow({"recording", "used for", "SHA-256"}, 3);
  for (const GapReport::Trial& t : report.trials)
    html += "<tr>" + cell(t.name) +
            cell(t.heldOut    ? "scoring only"
                 : t.setAside ? "nothing: it disagrees with the others"
                              : "fitting and cross-validation") +
            "<td><code>" + escaped(t.sha256) + "</code></td></tr>\n";
  return html + "</table></div>\n";
}

}  // namespace

std::string toHtml(const GapReport& report) {
  std::string html = head;
  const ReportLead lead = leadOf(report);
  html += "<h1>" + escaped(lead.headline) + "</h1>\n<div class=\"verdict" + (lead.isWarning ? " bad" : "") + "\">" +
          leadHtml(report, lead) + "</div>\n";
  if (lead.picture)
    html += figure(plots::overlay(report, lead.picture->first, lead.picture->second, false),
                   lead.heldOut ? "A recording that no fit saw: measured, simulated as given and with what was found; "
                                  "below, the differences (band: noise floor)."
                                : "Measured, simulated as given and with what was found; below, the differences (band: "
                                  "noise floor).");
  html += "<p>" + escaped(report.sentence) + "</p>\n";
  if (!lead.findings.empty()) {
    html += "<h2>What was left out</h2>\n";
    for (const ReportLead::Finding& finding : lead.findings) html += effectCard(report, finding);
  }
  html += "<section><h2>Error, step by step</h2>\n" +
          figure(plots::ladder(report),
                 "Cross-validated error after each step, down to what the recordings resolve; bars: "
                 "standard error over blocks.") +
          channelsTable(report) + "</section>\n";

  // The trials that show most.
  const auto overlays = chosenOverlays(report);
  std::vector<std::size_t> trials;
  for (const auto& [trial, series] : overlays)
    if (trials.size() < mostHeatTrials && std::find(trials.begin(), trials.end(), trial) == trials.end())
      trials.push_back(trial);
  html += "<h2>Where the error is</h2>\n" +
          figure(plots::heatMap(report, trials), "Standardised error by channel and time, as given and final.") +
          locatedSection(report);
  html += "<h2>All effects that were tried</h2>\n" + effectsTable(report);
  html += "<h2>Calibrated numbers</h2>\n" + calibratedTable(report);

  html += remainderSection(report);
  if (!report.next.why.empty() || !report.next.columns.empty())
    html += "<section><h2>Suggested next recording</h2>\n<p>" + escaped(report.next.why) +
            ". Expected difference: " + brief(report.next.separation) + " noise floors (RMS).</p>\n" +
            figure(plots::nextRecording(report.next), "Commands, also in next_command.csv.") + "</section>\n";

  html += "<h2>Recorded and simulated</h2>\n";
  for (const auto& [trial, series] : overlays)
    html += figure(plots::overlay(report, trial, series), "Band: noise floor.");
  std::size_t all = 0;
  for (const GapReport::Trial& t : report.trials) all += t.series.size();
  if (all > overlays.size())
    html += "<p class=\"faint\">" + std::to_string(all - overlays.size()) +
            " more channels and trials are in the folder overlay.</p>\n";
  if (!report.notes.empty()) {
    html += "<h2>Notes</h2>\n<ul>";
    for (const std::string& note : report.notes) html += "<li>" + escaped(note) + "</li>\n";
    html += "</ul>\n";
  }
  html += "<h2>Provenance</h2>\n" + provenance(report);
  return html + "</body></html>\n";
}

}  // namespace btr
