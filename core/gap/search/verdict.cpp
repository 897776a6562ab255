#include "core/gap/search/verdict.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/replay/residual.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/report_words.h"
#include "core/gap/search/rivals/next_recording.h"
#include "core/gap/search/thresholds.h"
#include "core/gap/search/trials/self_excited.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

using Verdict = GapReport::Verdict;

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

std::string numbersText(const GapReport::Effect& effect) {
  const std::string numbers = numbersInWords(effect);
  return numbers.empty() ? "" : " (" + numbers + ")";
}

/// "dry friction at leg.hip (…), at leg.knee (…)".
std::string findingText(const std::vector<const GapReport::Effect*>& finding) {
  std::string text;
  for (const GapReport::Effect* each : finding)
    text += (text.empty() ? inWords(each->effect, each->at) : ", at " + each->at) + numbersText(*each);
  return text;
}

/// A number of it is known to be another than where the effect does nothing. A joint that stands still tells that it is
/// held, and not how strongly.
bool tellsSize(const GapReport::Effect& effect) {
  return std::ranges::any_of(effect.parameters, [](const GapReport::Number& p) {
    return p.excited && p.ci95.known() && (p.before < p.ci95.low || p.before > p.ci95.high);
  });
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
  return "These recordings cannot tell " + inWords(effect.effect, effect.at) + " from " + text + ". ";
}

/// Numbers that the choice among rivals moves by more than what the interval of one of them says.
std::string movedByRivalsText(const GapReport& report) {
  std::string text;
  const auto tell = [&](const std::string& name, const GapReport::Number& number) {
    if (isWiderAmongRivals(number))
      text += (text.empty() ? "" : ", ") + name + " " + brief(number.amongRivals) + " instead of " + brief(number.ci95);
  };
  for (const GapReport::Number& number : report.calibrated) tell(number.name, number);
  for (const GapReport::Effect& effect : report.tried)
    if (effect.accepted)
      for (const GapReport::Number& number : effect.parameters)
        tell(number.name + " of " + inWords(effect.effect, effect.at), number);
  return text.empty() ? "" : "Which of them it is decides of other numbers, too; over all of them: " + text + ". ";
}

const std::string noiseFloors = " noise floors";

std::string inFloors(double meanSquare) { return digits(std::sqrt(meanSquare)) + noiseFloors; }

/// How alike successive samples are of what the final simulator leaves: noise alone is not (Anderson, Ann. Math. Stat.
/// 13 (1942) 1: the first serial correlation of white noise scatters by 1/√n).
struct RestColour {
  double correlation = 0, pairs = 0;
  bool stands(const SearchThresholds::Verdict& limits) const {
    return correlation > limits.colour && correlation * std::sqrt(pairs) > limits.colourErrors;
  }
};

RestColour colourOf(const FitProblem& problem, const Eigen::VectorXd& residuals) {
  if (residuals.size() != static_cast<Eigen::Index>(problem.residuals())) return {};
  double products = 0, squares = 0, pairs = 0;
  Eigen::Index at = 0;
  for (const Segment& segment : problem.segments) {
    std::map<std::size_t, std::pair<std::size_t, double>> last;  // by channel: row and residual
    for (std::size_t k = 0; k < segment.row.size(); ++k, ++at) {
      const auto [before, isFirst] = last.try_emplace(segment.channel[k], segment.row[k], residuals[at]);
      squares += residuals[at] * residuals[at];
      if (isFirst) continue;
      if (before->second.first + 1 == segment.row[k]) {
        products += before->second.second * residuals[at];
        ++pairs;
      }
      before->second = {segment.row[k], residuals[at]};
    }
  }
  if (pairs == 0 || squares <= 0) return {};
  return {products / pairs / (squares / static_cast<double>(residuals.size())), pairs};
}

/// A servo that hunts: what it does grows out of nothing that was recorded, so that fits find no way to its cause.
std::string swingText(const FitProblem& problem, const GapReport& report, const SearchThresholds& thresholds) {
  const auto swing = selfExcitedSwing(problem, report.trials, thresholds.selfExcitation);
  if (!swing) return "";
  const std::string unit = unitOfChannel(swing->channel);
  return "In " + swing->trial + ", from " + digits(swing->from_s, 2) + " to " + digits(swing->to_s, 2) + " s, " +
         swing->channel + " swings at " + digits(swing->frequency_hz, 2) + " Hz by ±" + digits(swing->amplitude, 2) +
         (unit.empty() ? "" : " " + unit) +
         ", where its command and the simulator have less than a fifth of that: the servo may hunt by itself, as a "
         "gear that gives way or plays, a delay, a lagging sensor or a large gain make it. No fit begun where it does "
         "not hunt finds the cause; record it with gains at which it does not. ";
}

/// What the verdict rests on; mean squared errors in noise floors².
struct Findings {
  double given = 0, calibrated = 0, final = 0;
  double step = 0;       ///< what the integration itself is wrong by: no physics that was left out
  double givenStep = 0;  ///< the same of the simulator as given, of what made the recordings alone
  double excess = 0;
  bool moves = false;             ///< something, by more than a few noise floors
  bool calibrationHelps = false;  ///< a paired test says so
  bool named = false;             ///< effects were accepted
  bool identifiable = false;      ///< a number is, or the recordings are sensitive to an effect at a typical size
  bool tried = false;             ///< effects were looked at
  RestColour colour;

  double beyondStep() const { return final - step; }
  double leftBeyondStep() const { return std::max(0.0, beyondStep() - 1); }
};

Findings findingsOf(const GapReport& report, const FitProblem& problem, const SearchResult& found,
                    const SearchThresholds& thresholds) {
  const SearchThresholds::Verdict& limits = thresholds.verdict;
  Findings e;
  e.given = found.given.mean();
  e.calibrated = found.calibrated.mean();
  e.final = found.final.mean();
  e.step = stepErrorOf(found.stepChange) + found.final.aligned.numericalFloor(thresholds.shift.ofTaken);
  e.givenStep = found.given.aligned.numericalFloor(thresholds.shift.ofTaken);
  e.excess = std::max(0.0, e.calibrated - 1);
  e.moves = motionOf(problem) >= limits.leastMotion;
  e.calibrationHelps = compare(found.given.blocks, found.calibrated.blocks).t > limits.calibrationT &&
                       e.given - e.calibrated > std::max(limits.calibrationGain * e.given, limits.calibrationGain);
  e.named = !found.effects.empty();
  e.identifiable =
      e.named ||
      std::any_of(report.calibrated.begin(), report.calibrated.end(),
                  [](const auto& number) { return number.excited; }) ||
      std::any_of(found.attempts.begin(), found.attempts.end(), [](const Attempt& a) { return a.excited; });
  e.tried = !found.attempts.empty();
  // Where stamps jitter, so do commands, and what follows a late one is late for a while.
  const bool jitters = std::ranges::any_of(problem.trials, &FitTrial::jitters);
  if (!jitters) e.colour = colourOf(problem, found.final.heldOut);
  return e;
}

/// Standing still although the simulator moves, or numbers that fit better, tell a lot; so does a number that is
/// identifiable.
bool tellsNothing(const Findings& e, const SearchThresholds::Verdict& limits) {
  return e.calibrated <= limits.unexplained && !e.calibrationHelps && !e.identifiable && (!e.moves || e.tried);
}

void judgeUntold(GapReport& report, const FitProblem& problem, const Findings& e,
                 const SearchThresholds::Verdict& limits) {
  report.verdict = Verdict::notExcited;
  report.sentence =
      e.moves ? "These recordings are sensitive to none of the calibrated numbers, and to no effect of a typical size"
              : "Nothing in these recordings moves by more than " + toText(limits.leastMotion) + noiseFloors;
  std::string remedy = "Record larger and faster motions, with reversals.";
  if (problem.noisyTorques) {
    report.sentence += ", as the noise of the recorded torques moves the joints by about as much";
    remedy = report.nextStep =
        "Let the joints follow the recorded motion (\"drive\": \"motion\" in the scene), then analyse again: torques "
        "are "
        "compared then, which noise in them disturbs less.";
  }
  report.sentence += ": they cannot tell the simulator from reality. " + remedy;
}

std::string errorText(const Findings& e) {
  return "The cross-validated error falls from " + inFloors(e.given) + " as given over " +
         digits(std::sqrt(e.calibrated)) + " calibrated to " + digits(std::sqrt(e.final)) + ". ";
}

std::string explainedText(const GapReport& report) { return wholePercent(report.remainder.explainedShare); }

/// A large rest weighs more than the share that a name explains, however large that is.
std::string caveatText(const GapReport& report, const Findings& e, const SearchThresholds::Verdict& limits) {
  if (e.beyondStep() <= limits.clearlyLeft) return "";
  return "The named effects explain " + explainedText(report) + " of the squared error beyond the noise, yet " +
         inFloors(e.final) + " are left: the name may be a stand-in for something else. ";
}

std::string colourText(const Findings& e) {
  return "successive samples of it correlate by " + digits(e.colour.correlation, 2);
}

/// Recordings that no fit saw. Other gains or speeds than those that were fitted show there what blocks of the fitted
/// recordings cannot: a number or an effect that fits, and misleads.
/// `named`: effects, or a law that was measured, are in the final simulator.
std::string unseenText(const GapReport& report, bool named, std::size_t fittedTrials,
                       const SearchThresholds::Verdict& limits) {
  const auto unseen = unseenError(report);
  if (!unseen)  // None was held out; of one recording all blocks have the same motion.
    return fittedTrials == 1 ? "It was learned from one recording and checked on other parts of the same motion: "
                               "whether it holds for another motion or another gain is not known; hold such a "
                               "recording out before it is adopted. "
                             : "";
  const auto floors = [](double error) {
    return std::isnan(error) ? "a fault of the simulation" : inFloors(error * error);
  };
  const auto number = [](double error) { return std::isnan(error) ? "a fault" : digits(error); };
  std::string text = "Recordings that no fit saw are left by " + floors(unseen->asGiven) + " as given, " +
                     number(unseen->calibrated) + " calibrated";
  if (named) text += ", " + number(unseen->withEffects) + " with what was found";
  text += ". ";
  const auto gotWorse = [&](double before, double after) { return unseenGotWorse(before, after, limits.unseenWorse); };
  const bool byEffects = named && gotWorse(unseen->calibrated, unseen->withEffects);
  const bool misleads = byEffects || gotWorse(unseen->asGiven, unseen->withEffects) ||
                        (!named && gotWorse(unseen->asGiven, unseen->calibrated));
  if (misleads)
    text += std::string(byEffects ? "There it does worse than calibration alone: it"
                                  : "There the numbers as given do better: what was calibrated") +
            " does not hold for motions like those; record and fit some of them before it is adopted. ";
  return text;
}

std::string ofGivenText(const GapReport& report) {
  return wholePercent(report.explainedShare) + " of the squared error of the simulator as given";
}

/// Other numbers took their part of it, too.
std::string leftOutText(const GapReport& report) {
  return (report.calibrated.empty() ? "What was left out explains " : "What was left out and other numbers explain ") +
         ofGivenText(report);
}

struct Named {
  std::string list, rivals;
};
Named namedIn(const GapReport& report) {
  Named named;
  for (const auto& finding : findingsOf(report)) {
    named.list += (named.list.empty() ? "" : "; ") + findingText(finding);
    for (const GapReport::Effect* each : finding) named.rivals += rivalsText(*each);
  }
  return named;
}

/// What was learned in the place of a name, and what it is worth.
std::string lawText(const GapReport& report) {
  if (!report.law.known()) return "";
  return "Its shape was measured: " + report.law.sentence + ". With it " + digits(report.law.error) + noiseFloors +
         " are left; it takes " + wholePercent(report.law.shareOfRest) +
         " of the squared error that is left without it. ";
}

void judgeNamed(GapReport& report, const Findings& e, const SearchThresholds::Verdict& limits) {
  report.verdict = Verdict::missingPhysics;
  const Named named = namedIn(report);
  report.sentence = leftOutText(report) + ": " + named.list + ". " + caveatText(report, e, limits) + whereText(report) +
                    errorText(e) + named.rivals + movedByRivalsText(report);
}

/// What is named stays when a learned law takes up the rest, or takes most where nothing was learned.
void judgePartly(GapReport& report, const Findings& e) {
  report.verdict = Verdict::partlyExplained;
  const Named named = namedIn(report);
  report.sentence = leftOutText(report) + ": " + named.list + ". Beside it " + inFloors(e.final) +
                    " are left that have no name here. " + lawText(report) + whereText(report) + errorText(e) +
                    named.rivals + movedByRivalsText(report);
}

void judgeUnexplained(GapReport& report, const Findings& e, const SearchThresholds::Verdict& limits) {
  report.verdict = Verdict::unexplained;
  const std::string partly = namedIn(report).list;
  const std::string first = "Named effects and other numbers explain " + ofGivenText(report) + ". ";
  if (e.named && e.leftBeyondStep() <= limits.unexplainedShare * e.excess)
    report.sentence = first + whereText(report) + errorText(e) + "Most of it, " + explainedText(report) +
                      " of the squared error, is taken up by " + partly + ", but what is left, " + inFloors(e.final) +
                      ", no effect of the library explains: the cause may be another. ";
  else
    report.sentence =
        (e.named ? first : "Other numbers explain " + ofGivenText(report) + ". ") + whereText(report) + errorText(e) +
        (report.cutShort ? "No effect that was looked at until then explains what is missing"
                         : "No effect of the library explains what is missing") +
        (partly.empty() ? "" : " (it is partly taken up by " + partly + ", which need not be the cause)") + ". " +
        lawText(report);
}

void judgeNoMismatch(GapReport& report, const Findings& e) {
  report.verdict = Verdict::noMismatch;
  report.sentence = "The simulator as given agrees with these recordings within " + inFloors(e.given) +
                    ": nothing is missing that they could show. ";
}

void judgeSufficient(GapReport& report, const Findings& e, const SearchThresholds::Verdict& limits) {
  report.verdict = Verdict::parametersSuffice;
  report.sentence = errorText(e) + "Other numbers for what is calibrated suffice; " +
                    (report.tried.empty() ? "nothing is left for a missing effect to explain. "
                                          : "no missing effect improves the cross-validated error. ");
  if (e.final > limits.stillNoise && e.colour.stands(limits))
    report.sentence += "What is left is small, but not noise alone: " + colourText(e) +
                       ". Something small may be missing, or the sensor's noise is not white. ";
}

/// Neither other numbers nor an effect are shown to help, and what is left is not much, or the integration hides it.
void judgeTheRest(GapReport& report, const Findings& e, std::size_t blocks, const SearchThresholds::Verdict& limits) {
  if (e.final > limits.unexplained) {
    report.verdict = Verdict::unexplained;
    report.sentence = errorText(e) + "What is left may be the integration's own error, " + inFloors(e.step) +
                      " at this step, or hide behind it: a smaller step_s would tell. ";
  } else if (e.given > limits.unexplained) {
    report.verdict = Verdict::notExcited;
    report.sentence = errorText(e) + "That other numbers help is not certain over " + std::to_string(blocks) +
                      " blocks of recordings: they cannot tell. Record more. ";
  } else if (e.colour.stands(limits)) {
    report.verdict = Verdict::unexplained;
    report.sentence = errorText(e) + "What is left is small, but not noise alone: " + colourText(e) +
                      ". Neither other numbers nor an effect of the library take it away; a sensor whose noise is not "
                      "white would look the same. ";
  } else {
    judgeNoMismatch(report, e);
    report.sentence += "What is above the noise floor looks like noise: the floor may be larger than was estimated. ";
  }
}

}  // namespace

void judge(GapReport& report, const FitProblem& problem, const SearchResult& found, bool curveIsBetter,
           const SearchThresholds& thresholds) {
  const SearchThresholds::Verdict& limits = thresholds.verdict;
  const Findings e = findingsOf(report, problem, found, thresholds);
  report.remainder.explainedShare = e.excess > 0 ? std::clamp(1 - std::max(0.0, e.final - 1) / e.excess, 0.0, 1.0) : 1;
  if (e.given > 0) report.explainedShare = std::clamp(1 - e.final / e.given, 0.0, 1.0);
  if (tellsNothing(e, limits)) {
    judgeUntold(report, problem, e, limits);
    return;
  }
  const bool hasUntestedShape =
      !report.law.known() && !report.remainder.on.empty() && report.remainder.shareOfRest > limits.shapeLeft;
  const bool tooMuchLeft =
      e.named ? e.beyondStep() > limits.stillNoise &&
                    (curveIsBetter || hasUntestedShape || report.law.known() ||
                     e.leftBeyondStep() > limits.unexplainedShare * e.excess ||
                     (e.beyondStep() > limits.clearlyLeft && e.leftBeyondStep() > limits.clearlyLeftShare * e.excess) ||
                     e.beyondStep() > limits.muchLeft)
              : e.beyondStep() > limits.unexplained;
  // Beside a law the names were tested with it in the model; where no law was found they must take most.
  const bool namesHold = e.named && !curveIsBetter && !hasUntestedShape &&
                         (report.law.known() || e.leftBeyondStep() <= limits.partlyLeft * e.excess);
  if (e.named && !tooMuchLeft)
    judgeNamed(report, e, limits);
  else if (tooMuchLeft && namesHold)
    judgePartly(report, e);
  else if (tooMuchLeft)
    judgeUnexplained(report, e, limits);
  else if (!e.calibrationHelps && e.given - e.givenStep <= limits.atNoise)
    judgeNoMismatch(report, e);
  else if (e.calibrationHelps && e.final <= limits.unexplained)
    judgeSufficient(report, e, limits);
  else
    judgeTheRest(report, e, found.given.blocks.size(), limits);
  if (!e.moves && (report.verdict == Verdict::noMismatch || report.verdict == Verdict::parametersSuffice))
    report.sentence += "Nothing in the recordings moves by more than " + toText(limits.leastMotion) + noiseFloors +
                       ": they can show little. ";
  if (leavesSomethingToAdopt(report.verdict))
    report.sentence += unseenText(report, e.named || report.law.known(), problem.trials.size(), limits);
  if (report.verdict == Verdict::unexplained || report.verdict == Verdict::partlyExplained ||
      e.beyondStep() > limits.clearlyLeft)
    report.sentence += swingText(problem, report, thresholds);
  if (!report.remainder.on.empty() && !report.law.known())
    report.sentence += "A force at " + report.remainder.at + " that depends on " + report.remainder.on +
                       " would take " + wholePercent(report.remainder.shareOfRest) +
                       " of the rest; its curve is in the report. ";
  std::string unidentifiable;
  const auto add = [&](const std::string& what) { unidentifiable += (unidentifiable.empty() ? "" : ", ") + what; };
  for (const GapReport::Number& number : report.calibrated)
    if (!number.excited) add(number.name);
  for (const GapReport::Effect& effect : report.tried)
    if (effect.accepted && !tellsSize(effect)) add("how large " + inWords(effect.effect, effect.at) + " is");
  if (!unidentifiable.empty()) report.sentence += "Not identifiable from these recordings: " + unidentifiable + ". ";
  if (!report.next.why.empty())
    report.sentence +=
        (report.next.separation >= thresholds.nextRecording.leastSeparation ? "The suggested next recording "
                                                                            : "Another recording ") +
        report.next.why + ". ";
  while (!report.sentence.empty() && report.sentence.back() == ' ') report.sentence.pop_back();
}

}  // namespace btr
