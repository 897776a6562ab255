// One blind case: what was hidden against what was said.
#include <algorithm>
#include <cmath>

#include "core/gap/proof/proof_marks.h"
#include "core/gap/proof/proved_case.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/report_words.h"

namespace btr {
namespace {

using Hidden = ConcealedAnswer::Hidden;
constexpr double barCost = 3;          // noise floors: bars apply to effects that cost more
constexpr std::size_t mostRivals = 2;  // among more it is not named
constexpr double nearFloor = 1.5;

std::string placeOf(const std::string& at) { return at == "world" ? "floor" : at; }

/// By name and place. Where there is a floor, turning gravity and tilting the floor are the same equations.
bool isThe(const Hidden& hidden, const PlacedEffect& placed, const std::string& scene) {
  const bool rig = scene == "pendulum" || scene == "leg";
  const auto name = [&](const std::string& effect) {
    return !rig && effect == "gravity_tilt" ? std::string("ground_slope") : effect;
  };
  return name(placed.effect) == name(hidden.placed.effect) && placeOf(placed.at) == placeOf(hidden.placed.at);
}

/// A rival that explains only together with another is a claim of both: it names what is hidden where both are.
bool isClaimOf(const Hidden& hidden, const ProvedCase::Rival& rival, const ProvedCase& proved) {
  const std::string& scene = proved.answer.scene;
  if (!isThe(hidden, {rival.effect, rival.at, {}}, scene)) return false;
  const auto& all = proved.answer.hidden;
  return rival.with.empty() || std::any_of(all.begin(), all.end(), [&](const Hidden& other) {
           return isThe(other, {rival.with, rival.at, {}}, scene);
         });
}

bool isNamed(const Hidden& hidden, const ProvedCase& proved) {
  for (const auto& named : proved.accepted) {
    if (isThe(hidden, named.placed, proved.answer.scene)) return true;
    if (named.rivals.size() > mostRivals) continue;
    for (const auto& rival : named.rivals)
      if (isClaimOf(hidden, rival, proved)) return true;
  }
  return false;
}

bool isLocated(const Hidden& hidden, const ProvedCase& proved) {
  const auto there = [&](const std::string& at) {
    return !at.empty() && (placeOf(at) == placeOf(hidden.placed.at) || at == hidden.alsoAt);
  };
  for (const auto& named : proved.accepted) {
    if (there(named.placed.at)) return true;
    if (named.rivals.size() > mostRivals) continue;
    for (const auto& rival : named.rivals)
      if (there(rival.at)) return true;
  }
  if (there(proved.remainderAt)) return true;
  const std::string& channel = proved.worstChannel;
  return proved.accepted.empty() && there(channel.substr(0, channel.rfind('.')));
}

double relativeError(double found, double truth) { return std::abs(found - truth) / std::abs(truth); }

/// What stands in the confusion table for a hidden effect: itself if it was named, else what was said instead.
std::string saidOf(const Hidden& hidden, const ProvedCase& proved) {
  if (!proved.failure.empty()) return "(failed)";
  const bool accepted = std::any_of(proved.accepted.begin(), proved.accepted.end(), [&](const auto& named) {
    return isThe(hidden, named.placed, proved.answer.scene);
  });
  if (accepted) return hidden.placed.effect;
  if (isNamed(hidden, proved)) return hidden.placed.effect + " (rival)";
  // Of several accepted ones the first that is not another hidden effect.
  for (const auto& named : proved.accepted)
    if (std::none_of(proved.answer.hidden.begin(), proved.answer.hidden.end(),
                     [&](const Hidden& other) { return isThe(other, named.placed, proved.answer.scene); }))
      return named.placed.effect;
  return "(" + proved.verdict + ")";
}

void markHeldOut(const ProvedCase& proved, CaseMarks& marks) {
  double sum = 0, count = 0;
  for (const auto& [channel, noise] : proved.answer.noise)
    if (const auto found = proved.fresh.find(channel); found != proved.fresh.end()) {
      sum += std::pow(found->second / noise, 2);
      count += 1;
    }
  if (count > 0) marks.heldOut = std::sqrt(sum / count);
  if (proved.answer.kind != "outside") marks.heldOutNear = marks.heldOut && *marks.heldOut <= nearFloor;
}

/// What the kind of case asks for; none of what the library does not know.
bool isRightVerdict(const ProvedCase& proved) {
  const std::string& kind = proved.answer.kind;
  if (kind == "nothing") return proved.verdict == "no_mismatch";
  if (kind == "parameters") return proved.verdict == "parameters_suffice";
  return (kind == "one" || kind == "two") && proved.verdict == "missing_physics";
}

/// Counts an interval that the analysis stands by: numbers that it calls unexcited have none, nor have whole numbers,
/// which are tried and not fitted.
void markCovered(std::vector<bool>& covered, std::vector<bool>& amongRivals,
                 const std::map<std::string, ProvedCase::Told>& told, const std::string& number, double truth) {
  const auto found = told.find(number);
  if (found == told.end() || !found->second.excited) return;
  const GapReport::Interval &ci95 = found->second.ci95, &all = found->second.amongRivals;
  if (!(ci95.high > ci95.low)) return;
  covered.push_back(truth >= ci95.low && truth <= ci95.high);
  amongRivals.push_back(all.known() ? truth >= all.low && truth <= all.high : covered.back());
}

ProvedCase::Told toldOf(const GapReport::Number& number) { return {number.ci95, number.excited, number.amongRivals}; }

void markParameters(const ProvedCase& proved, CaseMarks& marks) {
  for (const Hidden& hidden : proved.answer.hidden) {
    if (hidden.cost <= barCost) continue;
    for (const auto& named : proved.accepted) {
      if (named.placed.effect != hidden.placed.effect || named.placed.at != hidden.placed.at) continue;
      for (const std::string& size : hidden.sizes) {
        const double truth = hidden.placed.parameters.at(size);
        if (const auto found = named.placed.parameters.find(size); found != named.placed.parameters.end())
          marks.parameterErrors.push_back(relativeError(found->second, truth));
        markCovered(marks.parametersCovered, marks.parametersAmongRivals, named.told, size, truth);
      }
    }
  }
  if (isRightVerdict(proved))
    for (const auto& [path, truth] : proved.answer.truth)
      markCovered(marks.calibratedCovered, marks.calibratedAmongRivals, proved.calibratedTold, path, truth);
  if (proved.answer.kind == "nothing" || proved.answer.kind == "outside") return;
  for (const auto& [path, value] : proved.calibrated)
    if (const auto truth = proved.answer.truth.find(path); truth != proved.answer.truth.end())
      marks.calibratedErrors.push_back(relativeError(value, truth->second));
}

}  // namespace

CaseMarks mark(const ProvedCase& proved) {
  CaseMarks marks;
  const ConcealedAnswer& answer = proved.answer;
  const bool failed = !proved.failure.empty();
  const bool names = proved.verdict == "missing_physics" || proved.verdict == "partly_explained";
  const bool says = names || proved.verdict == "unexplained";
  const auto isAbove = [](const Hidden& hidden) { return hidden.cost > barCost; };

  if (answer.kind == "nothing" || answer.kind == "parameters") {
    marks.falseAlarm = failed || says;
    const std::string said = failed                    ? "(failed)"
                             : proved.accepted.empty() ? "(" + proved.verdict + ")"
                                                       : proved.accepted[0].placed.effect;
    marks.confused.emplace_back("(" + answer.kind + ")", said);
  }
  if (answer.kind == "nothing") marks.numbersChanged = failed || proved.verdict == "parameters_suffice";
  if (answer.hidden.size() == 1 && isAbove(answer.hidden[0])) {
    const Hidden& hidden = answer.hidden[0];
    if (hidden.outside) {
      marks.confidentlyWrong = failed || names;
      marks.unexplained = !failed && proved.verdict == "unexplained";
    } else {
      marks.named = !failed && isNamed(hidden, proved);
      marks.alone = *marks.named && proved.accepted.size() == 1;
    }
    if (failed || says) marks.location = !failed && isLocated(hidden, proved);
  }
  if (answer.hidden.size() == 2 && isAbove(answer.hidden[0]) && isAbove(answer.hidden[1]))
    marks.bothNamed = !failed && isNamed(answer.hidden[0], proved) && isNamed(answer.hidden[1], proved);
  for (const Hidden& hidden : answer.hidden)
    if (isAbove(hidden)) marks.confused.emplace_back(hidden.placed.effect, saidOf(hidden, proved));
  markHeldOut(proved, marks);
  markParameters(proved, marks);
  return marks;
}

ProvedCase judged(const ConcealedAnswer& answer, const GapReport& report, const Values& fresh) {
  ProvedCase proved;
  proved.answer = answer;
  proved.verdict = toText(report.verdict);
  for (const GapReport::Effect& effect : report.tried) {
    if (!effect.accepted) continue;
    ProvedCase::Named named{{effect.effect, effect.at, {}}};
    for (const GapReport::Number& number : effect.parameters) {
      named.placed.parameters[number.name] = number.value;
      named.told[number.name] = toldOf(number);
    }
    for (const GapReport::Rival& rival : effect.rivals) named.rivals.push_back({rival.effect, rival.at, rival.with});
    proved.accepted.push_back(std::move(named));
  }
  proved.remainderAt = report.remainder.at;
  if (!report.located.empty()) proved.worstChannel = report.located[0].channel;
  proved.fresh = fresh;
  for (const GapReport::Number& number : report.calibrated) {
    proved.calibrated[number.name] = number.value;
    proved.calibratedTold[number.name] = toldOf(number);
  }
  proved.seconds = report.seconds;
  return proved;
}

}  // namespace btr
