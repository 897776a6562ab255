#include "core/gap/report/report_lead.h"

#include <algorithm>
#include <cmath>

#include "core/gap/replay/svg.h"
#include "core/gap/report/equation.h"
#include "core/gap/report/report_figures.h"
#include "core/gap/search/report_words.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

using Verdict = GapReport::Verdict;
constexpr std::size_t mostErrors = 4;

std::string placed(const GapReport::Effect& effect) { return inWords(effect.effect, effect.at); }

std::vector<std::size_t> acceptedOf(const GapReport& report) {
  std::vector<std::size_t> accepted;
  for (std::size_t i = 0; i < report.tried.size(); ++i)
    if (report.tried[i].accepted) accepted.push_back(i);
  return accepted;
}

std::string findingHeadline(const GapReport& report) {
  constexpr std::size_t mostNamed = 3;
  const auto findings = findingsOf(report);
  const bool named = report.verdict == Verdict::missingPhysics || report.verdict == Verdict::partlyExplained;
  if (report.cutShort && report.verdict == Verdict::unexplained) return "Cut short before it was found what is missing";
  if (!named || findings.empty()) return headline(report.verdict);
  std::vector<std::string> names;
  for (const auto& finding : findings)
    if (names.size() < mostNamed) names.push_back(inWords(finding));
  if (findings.size() > mostNamed) names.push_back(std::to_string(findings.size() - mostNamed) + " more");
  const bool one = findings.size() == 1 && findings[0].size() == 1;
  return capital(listed(names)) + (one ? " was left out" : " were left out") +
         (report.verdict == Verdict::partlyExplained ? ", and something else is left" : "");
}

std::string findingText(const GapReport::Effect& effect) {
  std::string text = capital(placed(effect));
  if (!effect.law.says.empty()) text += ": " + effect.law.says;
  if (const std::string sizes = numbersInWords(effect); !sizes.empty()) text += "; " + sizes;
  text += ".";
  std::vector<std::string> rivals;
  for (const GapReport::Rival& rival : effect.rivals) rivals.push_back(inWords(rival));
  if (!rivals.empty()) text += " These recordings cannot tell it from " + listed(rivals) + ".";
  return text;
}

/// Errors by channel, the worst first: of the recordings that no fit saw if there are some.
void addErrors(ReportLead& lead, const GapReport& report) {
  lead.heldOut = std::ranges::any_of(report.trials, [](const auto& trial) { return trial.heldOut; });
  for (const GapReport::Channel& c : report.channels) {
    if (c.noiseFloor <= 0) continue;
    if (lead.heldOut)
      lead.errors.push_back({c.name, c.unit, c.heldoutAsGiven, c.heldoutWithEffects, c.heldoutFloor()});
    else
      lead.errors.push_back({c.name, c.unit, c.asGiven, c.withEffects, c.noiseFloor});
  }
  const auto worst = [](const ReportLead::Error& e) {
    return std::isnan(e.before) ? INFINITY : e.before / e.noiseFloor;
  };
  std::ranges::stable_sort(lead.errors, std::ranges::greater{}, worst);
  lead.more = lead.errors.size() - std::min(lead.errors.size(), mostErrors);
  lead.errors.resize(lead.errors.size() - lead.more);
}

std::string withUnit(double value, const std::string& unit) { return digits(value) + (unit.empty() ? "" : " " + unit); }

std::string changeText(double before, double after) {
  if (!(before > 0) || !std::isfinite(after)) return "";
  const double change = 1 - after / before;
  return std::abs(change) < 0.005 ? "the same" : wholePercent(std::abs(change)) + (change > 0 ? " less" : " more");
}

std::string errorTextOf(const ReportLead& lead) {
  if (lead.errors.empty()) return "";
  const ReportLead::Error& e = lead.errors.front();
  if (std::isnan(e.before) || std::isnan(e.after))
    return "A fault ended a simulation of " + e.channel + ": it has no error.";
  const std::string whose = lead.heldOut ? "On recordings that no fit saw, " : "Cross-validated, ";
  return whose + e.channel + " is off by " + withUnit(e.before, e.unit) + " as given and by " +
         withUnit(e.after, e.unit) + " with what was found (root mean square): " + changeText(e.before, e.after) +
         ". Noise alone makes " + withUnit(e.noiseFloor, e.unit) + ".";
}

/// The series whose error fell most, among trials that no fit saw if there are some.
std::optional<std::pair<std::size_t, std::size_t>> pictureOf(const GapReport& report, bool heldOut) {
  std::optional<std::pair<std::size_t, std::size_t>> best;
  double most = -INFINITY;
  for (std::size_t t = 0; t < report.trials.size(); ++t) {
    if (report.trials[t].heldOut != heldOut) continue;
    for (std::size_t s = 0; s < report.trials[t].series.size(); ++s) {
      const double before = heatRow(report, t, s, Simulated::asGiven, 1).error[0];
      const double after = heatRow(report, t, s, Simulated::withEffects, 1).error[0];
      const double fell = std::isfinite(before) && std::isfinite(after) ? before - after : -1e300;
      if (fell > most) {
        most = fell;
        best = std::pair(t, s);
      }
    }
  }
  return best;
}

std::string explainedText(const GapReport& report) {
  const double share = report.explainedShare;
  if (!std::isfinite(share) || share <= 0) return "";
  return std::string(std::ranges::any_of(report.tried, &GapReport::Effect::accepted)
                         ? "Calibration and what was named together take "
                         : "Calibration takes ") +
         wholePercent(share) + " of the squared error that the simulator had as given (all channels, cross-validated).";
}

std::string restText(const GapReport& report) {
  if (!report.law.known()) return "";
  return "What is left has no name but a shape: " + report.law.sentence + ". It takes " +
         wholePercent(report.law.shareOfRest) + " of the rest.";
}

std::string disagreementText(const GapReport::Disagreement& d) {
  return d.trial + (d.setAside ? " was set aside: " : " does not agree with the others: ") + d.what;
}

std::string checkBounds(const GapReport& report) {
  std::vector<std::string> names;
  for (const GapReport::Number& n : report.calibrated)
    if (n.atBound) names.push_back(n.name);
  if (names.empty()) return "";
  return listed(names) + (names.size() == 1 ? " ends at its bound" : " end at their bounds") +
         ": widen the bounds in the scene, or ask what the number stands in for.";
}

std::string separatingText(const GapReport& report) {
  if (report.next.columns.empty()) return "";
  return "Record the commands of next_command.csv on the robot: the recording " + inWords(report.next.why) +
         " (expected difference " + brief(report.next.separation) + " noise floors).";
}

void addNext(ReportLead& lead, const GapReport& report) {
  const auto say = [&](const std::string& text) {
    if (!text.empty()) lead.next.push_back(text);
  };
  if (report.cutShort) say("Analyse again with more time: other effects and rivals were not looked for to the end.");
  switch (report.verdict) {
    case Verdict::notExcited:
      say(report.nextStep.empty() ? "Record larger and faster motions, with reversals, then analyse again."
                                  : report.nextStep);
      break;
    case Verdict::noMismatch:
      say("Nothing to adopt. If the task goes further than these recordings (speed, load, ground), record that, too.");
      break;
    case Verdict::unexplained:
      say(std::string(report.law.known() ? "" : "Nothing is named that could be adopted. ") +
          "Look below where and when the error is made: is it at the same place in all trials?");
      break;
    default:
      say(lead.isWarning ? "Do not adopt this yet: fit some of the recordings that were held out, too, and hold others "
                           "out."
                         : "Adopt the repaired simulator: the button in the window, or btr gap adopt with "
                           "simulator.json of this folder.");
  }
  for (const GapReport::Disagreement& d : report.disagreements)
    say("Look at " + d.trial + ": was a setting different, did a marker slip, is it the right file?");
  say(separatingText(report));
  if (report.verdict != Verdict::notExcited && !lead.heldOut)
    say("Hold a recording back that differs in kind (--held-out): only that shows what no fit has seen.");
  say(checkBounds(report));
}

using svg::escaped;

std::string errorTable(const ReportLead& lead) {
  if (lead.errors.empty()) return "";
  std::string html = "<table class=\"lead\" cellpadding=\"4\"><tr><th align=\"left\">" +
                     std::string(lead.heldOut ? "recordings that no fit saw" : "cross-validated") +
                     "</th><th align=\"right\">as given</th><th align=\"right\">with what was found</th>"
                     "<th align=\"right\">change</th><th align=\"right\">noise floor</th></tr>\n";
  const auto cell = [](const std::string& text) { return "<td align=\"right\">" + escaped(text) + "</td>"; };
  for (const ReportLead::Error& e : lead.errors)
    html += "<tr><td>" + escaped(e.channel) + "</td>" + cell(withUnit(e.before, e.unit)) +
            cell(withUnit(e.after, e.unit)) + cell(changeText(e.before, e.after)) +
            cell(withUnit(e.noiseFloor, e.unit)) + "</tr>\n";
  html += "</table>\n";
  if (lead.more > 0) html += "<p class=\"faint\">" + std::to_string(lead.more) + " more channels below.</p>\n";
  return html;
}

}  // namespace

ReportLead leadOf(const GapReport& report) {
  ReportLead lead;
  const std::string warning = unseenWarning(report);
  lead.isWarning = !warning.empty();
  lead.headline = lead.isWarning ? capital(warning) : findingHeadline(report);
  for (const std::size_t i : acceptedOf(report)) lead.findings.push_back({i, findingText(report.tried[i])});
  lead.explained = explainedText(report);
  lead.rest = restText(report);
  for (const GapReport::Disagreement& d : report.disagreements) lead.disagree.push_back(disagreementText(d));
  addErrors(lead, report);
  lead.errorText = errorTextOf(lead);
  lead.picture = pictureOf(report, lead.heldOut);
  addNext(lead, report);
  return lead;
}

std::string withoutInWords(const GapReport::Effect& effect) {
  constexpr double most = 1000;  // larger ones say nothing more
  const double reduction = effect.heldoutErrorReduction;
  if (!(reduction > 0) || reduction > 1) return "";
  const double times = 1 / (1 - reduction);
  return "Without it the cross-validated error (root mean square) is " +
         (times > most ? "more than " + digits(most) : digits(times)) + " times as large.";
}

std::string leadHtml(const GapReport& report, const ReportLead& lead) {
  std::string html;
  if (lead.isWarning) html += "<p>" + escaped(findingHeadline(report)) + ".</p>\n";
  if (!lead.findings.empty()) {
    html += "<ul>";
    for (const ReportLead::Finding& finding : lead.findings) {
      const GapReport::Effect& effect = report.tried[finding.effect];
      html += "<li>" + escaped(finding.text);
      if (const std::string without = withoutInWords(effect); !without.empty()) html += " " + escaped(without);
      if (!effect.law.equation.empty()) html += "<br>" + equationHtml(effect.law.equation);
      html += "</li>\n";
    }
    html += "</ul>\n";
  }
  for (const std::string& text : {lead.rest, lead.errorText + (lead.explained.empty() ? "" : " " + lead.explained)})
    if (!text.empty()) html += "<p>" + escaped(text) + "</p>\n";
  for (const std::string& text : lead.disagree) html += "<p><b>" + escaped(text) + "</b></p>\n";
  html += errorTable(lead);
  if (!lead.next.empty()) {
    html += "<p><b>What to do next</b></p><ol>";
    for (const std::string& step : lead.next) html += "<li>" + escaped(step) + "</li>\n";
    html += "</ol>\n";
  }
  return html;
}

}  // namespace btr
