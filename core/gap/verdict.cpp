#include "core/gap/verdict.h"

#include <algorithm>
#include <cmath>

#include "core/gap/report_figures.h"

namespace btr {
namespace {

using Verdict = GapReport::Verdict;

// Mean squared errors in noise floors²: what is at the noise, and what is too much to stay without a name.
constexpr double atNoise = 1.3, stillNoise = 1.15, unexplained = 1.5, unexplainedShare = 0.2;
// Where what is left stands well above the noise, a small share of what was there is too much already.
constexpr double clearlyLeft = 4, clearlyLeftShare = 0.04;
constexpr double leastMotion = 10;  // noise floors that something must move

/// Largest movement of any compared channel about its mean, in noise floors.
double motionOf(const FitProblem& problem) {
  double most = 0;
  for (const FitTrial& trial : problem.trials)
    for (std::size_t c = 0; c < trial.noiseFloor.size(); ++c) {
      if (trial.noiseFloor[c] <= 0) continue;
      double sum = 0, square = 0, n = 0;
      for (const double value : trial.recording.columns[trial.binding.measured[c].column])
        if (std::isfinite(value)) {
          sum += value;
          square += value * value;
          ++n;
        }
      if (n > 0) most = std::max(most, std::sqrt(std::max(0.0, square / n - sum * sum / n / n)) / trial.noiseFloor[c]);
    }
  return most;
}

std::string effectText(const GapReport::Effect& effect) {
  std::string text = inWords(effect.effect) + " at " + effect.at;
  std::string numbers;
  for (const GapReport::Number& p : effect.parameters)
    numbers += (numbers.empty() ? "" : ", ") + p.name + " = " + digits(p.value) +
               (p.ci95.high > p.ci95.low ? " [" + digits(p.ci95.low) + " … " + digits(p.ci95.high) + "]" : "") +
               (p.atBound ? " (at its bound)" : "");
  return text + (numbers.empty() ? "" : " (" + numbers + ")");
}

std::string whereText(const GapReport& report) {
  if (report.located.empty() || report.located[0].when.empty()) return "";
  const GapReport::Located& first = report.located[0];
  for (const GapReport::Regime& regime : first.regimes)
    if (regime.name == first.when)
      return "At " + first.channel + " " + wholePercent(regime.shareOfExcess) +
             " of the error that calibration leaves lies at " + inWords(regime.name) + " (" +
             wholePercent(regime.shareOfTime) + " of the time). ";
  return "";
}

std::string rivalsText(const GapReport::Effect& effect) {
  if (effect.rivals.empty()) return "";
  std::string text;
  for (const GapReport::Rival& rival : effect.rivals) text += (text.empty() ? "" : ", ") + inWords(rival);
  return "These recordings cannot tell it from " + text + ". ";
}

}  // namespace

void judge(GapReport& report, const FitProblem& problem, const SearchResult& found, bool curveIsBetter) {
  const double given = found.given.mean(), calibrated = found.calibrated.mean(), final = found.final.mean();
  const double excess = std::max(0.0, calibrated - 1), left = std::max(0.0, final - 1);
  // What the integration itself is wrong by is not physics that was left out.
  const double beyondStep = final - stepErrorOf(found.stepChange), leftBeyondStep = std::max(0.0, beyondStep - 1);
  report.remainder.explainedShare = excess > 0 ? std::clamp(1 - left / excess, 0.0, 1.0) : 1;
  const std::string floors = " noise floors";
  const std::string error = "The held-out error falls from " + digits(std::sqrt(given)) + floors + " as given over " +
                            digits(std::sqrt(calibrated)) + " calibrated to " + digits(std::sqrt(final)) + ". ";
  const bool moves = motionOf(problem) >= leastMotion;
  const bool calibrationHelps =
      compare(found.given.blocks, found.calibrated.blocks).t > 2.5 && given - calibrated > std::max(0.02 * given, 0.02);
  const bool named = !found.effects.empty();
  const bool tooMuchLeft =
      named ? beyondStep > stillNoise && (curveIsBetter || leftBeyondStep > unexplainedShare * excess ||
                                          (beyondStep > clearlyLeft && leftBeyondStep > clearlyLeftShare * excess))
            : beyondStep > unexplained;

  // What stands still although the simulator moves tells a lot.
  if (!moves && calibrated <= unexplained) {
    report.verdict = Verdict::notExcited;
    report.sentence =
        "Nothing in these recordings moves by more than " + toText(leastMotion) +
        " noise floors: they cannot tell the simulator from reality. Record larger and faster motions, with reversals.";
    return;
  }
  if (named && !tooMuchLeft) {
    report.verdict = Verdict::missingPhysics;
    std::string list, rivals;
    for (const GapReport::Effect& effect : report.tried) {
      if (!effect.accepted) continue;
      list += (list.empty() ? "" : "; ") + effectText(effect);
      rivals += rivalsText(effect);
    }
    report.sentence = whereText(report) + "What was left out: " + list + ". " + error + rivals;
  } else if (tooMuchLeft) {
    report.verdict = Verdict::unexplained;
    std::string partly;
    for (const GapReport::Effect& effect : report.tried)
      if (effect.accepted) partly += (partly.empty() ? "" : "; ") + effectText(effect);
    if (named && leftBeyondStep <= unexplainedShare * excess)
      report.sentence = whereText(report) + error + "Most of it, " + wholePercent(report.remainder.explainedShare) +
                        " of the squared error, is taken up by " + partly + ", but what is left, " +
                        digits(std::sqrt(final)) + floors +
                        ", no effect of the library explains: the cause may be another. ";
    else
      report.sentence =
          whereText(report) + error + "No effect of the library explains what is missing" +
          (partly.empty() ? "" : " (it is partly taken up by " + partly + ", which need not be the cause)") + ". ";
  } else if (!calibrationHelps && given <= atNoise) {
    report.verdict = Verdict::noMismatch;
    report.sentence = "The simulator as given agrees with these recordings within " + digits(std::sqrt(given)) +
                      floors + ": nothing is missing that they could show. ";
  } else {
    report.verdict = Verdict::parametersSuffice;
    report.sentence = error + "Other numbers for what is calibrated suffice; " +
                      (report.tried.empty() ? "nothing is left for a missing effect to explain. "
                                            : "no missing effect improves the held-out error. ");
  }
  if (!report.remainder.on.empty())
    report.sentence += "A force at " + report.remainder.at + " that depends on " + report.remainder.on +
                       " would take " + wholePercent(report.remainder.shareOfRest) +
                       " of the rest; its curve is in the report. ";
  std::string untold;
  for (const GapReport::Number& number : report.calibrated)
    if (!number.excited) untold += (untold.empty() ? "" : ", ") + number.name;
  if (!untold.empty()) report.sentence += "These recordings do not tell " + untold + ". ";
  if (!report.next.why.empty()) report.sentence += "The suggested next recording " + report.next.why + ". ";
  while (!report.sentence.empty() && report.sentence.back() == ' ') report.sentence.pop_back();
}

}  // namespace btr
