#include "core/gap/search/report_words.h"

#include <algorithm>
#include <cmath>

#include "core/gap/search/gap_report.h"
#include "core/sim/effect_places.h"
#include "core/spec/figures.h"

namespace btr {

std::string inWords(const std::string& effect, const std::string& at) {
  const std::string shared = everyJointOf("");
  return inWords(effect) + " at " +
         (at.ends_with(shared) ? "every joint of " + at.substr(0, at.size() - shared.size()) : at);
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return text;
}

std::vector<std::vector<const GapReport::Effect*>> findingsOf(const GapReport& report) {
  std::vector<std::vector<const GapReport::Effect*>> findings;
  for (const GapReport::Effect& effect : report.tried) {
    if (!effect.accepted) continue;
    const auto same = std::ranges::find_if(findings, [&](const auto& finding) {
      return finding[0]->effect == effect.effect && ownerOf(finding[0]->at) == ownerOf(effect.at);
    });
    if (same == findings.end())
      findings.push_back({&effect});
    else
      same->push_back(&effect);
  }
  return findings;
}

std::string inWords(const std::vector<const GapReport::Effect*>& finding) {
  if (finding.size() == 1) return inWords(finding[0]->effect, finding[0]->at);
  std::vector<std::string> places;
  for (const GapReport::Effect* each : finding) places.push_back(each->at);
  return inWords(finding[0]->effect) + " at " + listed(places);
}

std::string inWords(const GapReport::Rival& rival) {
  return inWords(rival.effect, rival.at) + (rival.with.empty() ? "" : " together with " + inWords(rival.with));
}

bool isWiderAmongRivals(const GapReport::Number& number) {
  const GapReport::Interval &all = number.amongRivals, &own = number.ci95;
  return all.known() && own.known() &&
         all.high - all.low > SearchThresholds::Rivals{}.widerAmong * (own.high - own.low);
}

std::string brief(const GapReport::Interval& interval) {
  constexpr int usual = 3, most = 6;
  int count = usual;
  while (count < most && digits(interval.low, count) == digits(interval.high, count)) ++count;
  const auto side = [&](double value) { return std::isfinite(value) ? digits(value, count) : std::string("…"); };
  return "[" + side(interval.low) + ", " + side(interval.high) + "]";
}

std::string inWords(const GapReport::Number& number) {
  if (!number.excited) return number.name + " not identifiable";
  const bool hasWidth = number.ci95.known() && number.ci95.high > number.ci95.low;
  return number.name + " = " + digits(number.value) + (number.unit.empty() ? "" : " " + number.unit) +
         (hasWidth ? " " + brief(number.ci95) : "") + (number.atBound ? ", at its bound" : "");
}

std::string numbersInWords(const GapReport::Effect& effect) {
  std::string numbers;
  for (const GapReport::Number& n : effect.parameters) numbers += (numbers.empty() ? "" : "; ") + inWords(n);
  return numbers;
}

std::string inWordsWithRivals(const GapReport::Number& number) {
  return inWords(number) + (number.amongRivals.known() ? ", among rivals " + brief(number.amongRivals) : "");
}

std::string headline(GapReport::Verdict verdict) {
  switch (verdict) {
    case GapReport::Verdict::noMismatch:
      return "Nothing is missing";
    case GapReport::Verdict::parametersSuffice:
      return "Other parameter values suffice";
    case GapReport::Verdict::missingPhysics:
      return "Physics was left out";
    case GapReport::Verdict::partlyExplained:
      return "Physics was left out, and something more that has no name here";
    case GapReport::Verdict::unexplained:
      return "Something is missing that has no name here";
    case GapReport::Verdict::notExcited:
      break;
  }
  return "The recordings cannot tell";
}

bool leavesSomethingToAdopt(GapReport::Verdict verdict) {
  return verdict != GapReport::Verdict::noMismatch && verdict != GapReport::Verdict::notExcited;
}

const char* toText(EffectLaw::Acts acts) {
  using Acts = EffectLaw::Acts;
  switch (acts) {
    case Acts::command:
      return "command";
    case Acts::drive:
      return "drive";
    case Acts::gear:
      return "gear";
    case Acts::joint:
      return "joint";
    case Acts::link:
      return "link";
    case Acts::gravity:
      return "gravity";
    case Acts::air:
      return "air";
    case Acts::contact:
      return "contact";
    case Acts::sensor:
      return "sensor";
    case Acts::notSaid:
      break;
  }
  return "not_said";
}

const char* toText(GapReport::Verdict verdict) {
  switch (verdict) {
    case GapReport::Verdict::noMismatch:
      return "no_mismatch";
    case GapReport::Verdict::parametersSuffice:
      return "parameters_suffice";
    case GapReport::Verdict::missingPhysics:
      return "missing_physics";
    case GapReport::Verdict::partlyExplained:
      return "partly_explained";
    case GapReport::Verdict::unexplained:
      return "unexplained";
    case GapReport::Verdict::notExcited:
      break;
  }
  return "not_excited";
}

std::optional<UnseenError> unseenError(const GapReport& report) {
  UnseenError sum;
  double channels = 0;
  for (const GapReport::Channel& channel : report.channels) {
    const double floor2 = std::pow(channel.heldoutFloor(), 2);
    if (floor2 <= 0 || channel.heldoutAsGiven <= 0) continue;
    sum.asGiven += channel.heldoutAsGiven * channel.heldoutAsGiven / floor2;
    sum.calibrated += channel.heldoutCalibrated * channel.heldoutCalibrated / floor2;
    sum.withEffects += channel.heldoutWithEffects * channel.heldoutWithEffects / floor2;
    ++channels;
  }
  if (channels == 0) return std::nullopt;
  return UnseenError{std::sqrt(sum.asGiven / channels), std::sqrt(sum.calibrated / channels),
                     std::sqrt(sum.withEffects / channels)};
}

bool unseenGotWorse(double before, double after, double worse) {
  return std::isnan(after) ? !std::isnan(before) : after > worse * before;
}

bool UnseenError::gotWorse() const { return unseenGotWorse(asGiven, withEffects); }

std::string unseenWarning(const GapReport& report) {
  const auto unseen = unseenError(report);
  if (!unseen || !unseen->gotWorse()) return "";
  if (std::isnan(unseen->withEffects)) return "a fault ends the simulation of the recordings that were held out";
  return "the recordings that were held out got worse: " + digits(unseen->asGiven) + " → " +
         digits(unseen->withEffects) + " noise floors";
}

std::string headline(const GapReport& report) {
  const std::string warning = unseenWarning(report);
  return headline(report.verdict) + (warning.empty() ? "" : ", but " + warning);
}

}  // namespace btr
