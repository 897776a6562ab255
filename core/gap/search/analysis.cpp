// Gap analysis from recordings to a report.
#include "core/gap/search/analysis.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/fit/interruptible.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/fit/unit_at.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/residual.h"
#include "core/gap/search/explanation.h"
#include "core/gap/search/faster_commands.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/laws/law_search.h"
#include "core/gap/search/laws/law_words.h"
#include "core/gap/search/laws/remainder.h"
#include "core/gap/search/report_series.h"
#include "core/gap/search/report_words.h"
#include "core/gap/search/rivals/next_recording.h"
#include "core/gap/search/rivals/rival_intervals.h"
#include "core/gap/search/screening/locate.h"
#include "core/gap/search/search.h"
#include "core/gap/search/trials/agreement.h"
#include "core/gap/search/trials/consultation.h"
#include "core/gap/search/verdict.h"
#include "core/spec/error.h"
#include "core/spec/figures.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"
#include "core/spec/system/cancelled.h"

namespace btr {
namespace {

/// An effect that is absent at its lower bound is not "at its bound" there.
bool isAtBound(double value, const FitParameter& p) {
  // Of a wide range a small part is far from its end for a small number.
  const double close =
      SearchThresholds::Verdict{}.atBound * std::min(p.maximum - p.minimum, std::max(p.scale, std::abs(value)));
  const bool endsInNothing = p.effect >= 0 && p.hasNeutral && p.given <= p.minimum;
  return p.maximum - value < close || (!endsInNothing && value - p.minimum < close);
}

/// Of an effect that was fitted and rejected: no interval was asked for.
std::vector<GapReport::Number> numbersOf(const FitProblem& problem, const Attempt& attempt) {
  const std::vector<FitParameter> fitted = fitParameters(attempt.candidate.declared, 0);
  std::vector<GapReport::Number> numbers;
  for (const Parameter& p : attempt.candidate.declared) {
    const double value = attempt.values.at(p.name);
    const auto known = std::find_if(fitted.begin(), fitted.end(), [&](const auto& f) { return f.name == p.name; });
    numbers.push_back({p.name, unitAt(problem.scene, problem.models, attempt.candidate.at, p),
                       p.neutral.value_or(p.byDefault), value, GapReport::Interval::none(),
                       known != fitted.end() && isAtBound(value, *known), attempt.excited});
  }
  return numbers;
}

GapReport::Number numberOf(const FitModel& model, const Uncertainty& uncertainty, std::size_t parameter) {
  const FitParameter& p = model.parameters[parameter];
  const double value = model.values[parameter];
  return {p.name,
          p.unit,
          p.given,
          value,
          interval95(model, uncertainty, parameter),
          isAtBound(value, p),
          isIdentifiable(p, uncertainty.half95(parameter))};
}

/// Of an effect of the final simulator, or of the scene (−1), with what rivals would make of them.
std::vector<GapReport::Number> finalNumbers(const SearchResult& found, int effect) {
  const FitModel& model = found.final.fit.model;
  std::vector<GapReport::Number> numbers;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    if (model.parameters[i].effect != effect) continue;
    numbers.push_back(numberOf(model, found.finalUncertainty, i));
    numbers.back().amongRivals = intervalAmongRivals(found, i);
  }
  return numbers;
}

/// Effects of the final simulator first, then what else was looked at.
void addEffects(GapReport& report, const FitProblem& problem, const SearchResult& found) {
  for (std::size_t i = 0; i < found.effects.size(); ++i) {
    const Found& each = found.effects[i];
    GapReport::Effect effect;
    effect.effect = each.effect.effect;
    effect.at = each.effect.at;
    effect.law = problem.library.make(effect.effect)->law();
    effect.accepted = true;
    effect.parameters = finalNumbers(found, static_cast<int>(i));
    effect.heldoutErrorReduction = 1 - std::sqrt(std::max(0.0, 1 - each.comparison.gain));
    effect.pValue = each.comparison.pValue;
    effect.qValue = each.qValue;
    effect.rivals = each.rivals;
    for (const Attempt& attempt : found.attempts)
      if (attempt.candidate.effect == effect.effect && attempt.candidate.at == effect.at) {
        effect.screenRank = attempt.rank;
        effect.screenShare = attempt.share;
        effect.reason = attempt.reason;
        // Whole numbers are not fitted, but they belong to what was found where they could be others.
        for (const Parameter& p : attempt.candidate.declared)
          if (p.integer && p.minimum < p.maximum) {
            const double value = each.effect.parameters.at(p.name);
            effect.parameters.push_back({p.name, p.unit, p.byDefault, value, {value, value}, false, true});
          }
      }
    report.tried.push_back(effect);
  }
  std::vector<const Attempt*> others;
  for (const Attempt& attempt : found.attempts) {
    const bool isFinal = std::any_of(found.effects.begin(), found.effects.end(), [&](const Found& each) {
      return each.effect.effect == attempt.candidate.effect && each.effect.at == attempt.candidate.at;
    });
    if (!isFinal) others.push_back(&attempt);
  }
  std::stable_sort(others.begin(), others.end(), [](const Attempt* a, const Attempt* b) {
    if (a->scored != b->scored) return a->scored;
    return a->scored ? a->comparison.gain > b->comparison.gain : a->share > b->share;
  });
  for (const Attempt* attempt : others) {
    GapReport::Effect effect;
    effect.effect = attempt->candidate.effect;
    effect.at = attempt->candidate.at;
    effect.law = problem.library.make(effect.effect)->law();
    effect.screenRank = attempt->rank;
    effect.screenShare = attempt->share;
    effect.reason = attempt->reason;
    if (attempt->scored) {
      effect.heldoutErrorReduction = 1 - std::sqrt(std::max(0.0, 1 - attempt->comparison.gain));
      effect.pValue = attempt->comparison.pValue;
    }
    effect.qValue = attempt->qValue;
    if (attempt->fitted) effect.parameters = numbersOf(problem, *attempt);
    report.tried.push_back(effect);
  }
}

void addCorrelations(GapReport& report, const FitModel& model, const Uncertainty& uncertainty, double strong) {
  const auto nameOfParameter = [&](std::size_t i) {
    const FitParameter& p = model.parameters[i];
    return p.effect < 0 ? p.name : model.effects[static_cast<std::size_t>(p.effect)].effect + "." + p.name;
  };
  for (std::size_t i = 0; i < model.parameters.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double r = uncertainty.correlation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      if (std::abs(r) > strong)
        report.strongCorrelations.push_back(nameOfParameter(j) + " ~ " + nameOfParameter(i) + ": " +
                                            toText(std::round(1000 * r) / 1000));
    }
}

/// What ends in a fault with the numbers that were found explains nothing, and nobody should adopt it.
void restNothingOnFaults(GapReport& report) {
  const bool ends = std::ranges::any_of(report.channels, [](const auto& c) { return std::isnan(c.withEffects); });
  if (!ends) return;
  report.verdict = GapReport::Verdict::unexplained;
  report.after = report.before;
  report.ladder.clear();
  report.sentence =
      "With the best numbers that were found the simulation still ends in a fault before its recording does (see the "
      "notes), so nothing is shown to be missing, or to suffice. A step_s that is too long, a mass that is too small "
      "and "
      "a gain that is too high are the usual causes. ";
}

/// The law as the report has it, its first curve also as the shape of what is left.
void addLaw(GapReport& report, const FitProblem& problem, const LearnedLaw& law, const SearchResult& named) {
  report.law = inReport(problem, law, named.given.mean(), named.final.mean());
  const GapReport::LawCurve& curve = report.law.curves[0];
  GapReport::Remainder& rest = report.remainder;
  rest.at = report.law.at;
  rest.on = curve.on;
  rest.unitX = curve.unitX;
  rest.unitY = curve.unitY;
  rest.x = curve.x;
  rest.y = curve.y;
  for (std::size_t i = 0; i < curve.y.size(); ++i) rest.standardError.push_back((curve.high[i] - curve.y[i]) / 1.96);
  rest.shareOfRest = report.law.shareOfRest;
  rest.pValue = report.law.pValue;
}

/// The integration's own error in the final simulator: against half the step.
void addStepErrors(GapReport& report, const FitProblem& problem, const SearchResult& found) {
  const Eigen::VectorXd difference = 4.0 / 3.0 * found.stepChange;
  addErrors(report, problem, difference, &GapReport::Channel::stepError, &GapReport::Channel::stepError);
  for (const GapReport::Channel& channel : report.channels)
    if (channel.stepError > channel.noiseFloor)
      report.notes.push_back(
          channel.name + ": the integration's own error, about " + digits(channel.stepError, 2) + " " + channel.unit +
          " at a step of " + toText(problem.scene.step_s) + " s, is not below the noise floor; " +
          (problem.scene.step_s > problem.givenStep_s ? "beside what is left of the error the fits took no finer one"
                                                      : "a smaller step_s would make the analysis sharper"));
}

/// Where positions are compared a little earlier or later than they are recorded, and it matters.
void addAlignment(GapReport& report, const FitProblem& problem, const Scored& final,
                  const SearchThresholds::Shift& limits) {
  const double shift_s = final.aligned.shift_s;
  if (!(final.aligned.took > limits.leastTaken) || shift_s == 0) return;
  report.notes.push_back("joints are compared with what is simulated " + digits(std::abs(1000 * shift_s), 2) + " ms " +
                         (shift_s > 0 ? "later" : "earlier") +
                         ": within half a step of the scene or, where motions are followed, half a row (" +
                         digits(1000 * mostShift_s(problem), 2) +
                         " ms), where what made the recordings may have integrated or read them; no physics is "
                         "looked for in that");
}

}  // namespace

void refuseUnknownEffects(const AnalysisOptions& options, const EffectLibrary& library) {
  std::string known;
  for (const std::string& name : library.names) known += (known.empty() ? "" : ", ") + name;
  for (const std::string& name : options.effects)
    if (std::find(library.names.begin(), library.names.end(), name) == library.names.end())
      throw InputError("effects to consider", "\"" + name + "\"", "one of " + known);
}

GapReport analyse(const GapProblem& given, const EffectLibrary& library, const AnalysisOptions& options,
                  const AnalysisProgress& tell) {
  const auto passed_s = [begin = std::chrono::steady_clock::now()] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  std::string stage = "making ready";
  double share = 0;
  const AnalysisProgress progress = [&](const std::string& now, double at) {
    stage = now;
    share = at;
    return !tell || tell(stage, share);
  };
  std::string cutWhile;
  const auto isEnough = [&] {
    if (!options.isEnough || !options.isEnough()) return false;
    cutWhile = stage;
    return true;
  };
  const Interruptible interruptible([&] { return progress(stage, share); }, isEnough);
  if (given.recordings.empty()) throw InputError("gap analysis", "no recording", "at least one recorded trial");
  refuseUnknownEffects(options, library);
  const SearchThresholds& limits = options.thresholds;
  const Consultation consultation = consult(given, library, options.asRecorded, limits.verdict);
  GapProblem asked = given;  // and what was found out of its recordings
  const auto prepare = [&](const std::vector<Recording>& recordings, double window_s) {
    FitProblem ready = makeFitProblem(given, recordings, library, window_s);
    ready.jobs = options.jobs;
    return ready;
  };
  SearchOptions search;
  search.jobs = options.jobs;
  search.maximumEffects = options.maximumEffects;
  search.names = options.effects;
  search.seed = options.seed;
  search.thresholds = limits;
  search.progress = progress;
  std::string betweenRows;
  const Explanation explanation = explainWithCommands(asked, prepare, search, options.learnRest, betweenRows);
  const FitProblem& problem = explanation.problem;
  const SearchResult& found = explanation.found;
  const Agreement& agreement = explanation.agreement;
  const LawBesideNames& law = explanation.law;
  const SearchResult final = law.law ? withLearned(problem, found, *law.law) : found;

  GapReport report;
  report.seed = options.seed;
  report.version = UCHILSIM_VERSION;
  report.notes = consultation.notes;
  if (!betweenRows.empty()) report.notes.push_back(betweenRows);
  report.notes.insert(report.notes.end(), problem.notes.begin(), problem.notes.end());
  report.notes.insert(report.notes.end(), found.refused.begin(), found.refused.end());
  for (const std::string& name : law.fell)
    report.notes.push_back(name + " was named at first; a curve that was learned does as well without it");
  report.ladder = final.ladder;
  report.before = given.simulator;
  report.after = final.final.fit.model.simulator(problem);
  report.step_s = problem.scene.step_s;
  report.window_s = problem.window_s;
  report.calibrated = finalNumbers(final, -1);
  // The calibrated simulator has no effects.
  for (std::size_t i = 0; i < found.calibrated.fit.model.parameters.size(); ++i)
    if (GapReport::Number number = numberOf(found.calibrated.fit.model, found.calibratedUncertainty, i);
        std::none_of(report.calibrated.begin(), report.calibrated.end(),
                     [&](const GapReport::Number& other) { return other.name == number.name; })) {
      // It was held as given from there on: what the calibration said of it belongs to another value.
      number.value = number.before;
      number.ci95 = GapReport::Interval::none();
      number.atBound = number.excited = false;
      report.calibrated.push_back(number);
    }
  addErrors(report, problem, found.given.heldOut, &GapReport::Channel::asGiven, &GapReport::Channel::maeAsGiven);
  addErrors(report, problem, found.calibrated.heldOut, &GapReport::Channel::calibrated,
            &GapReport::Channel::maeCalibrated);
  addErrors(report, problem, final.final.heldOut, &GapReport::Channel::withEffects,
            &GapReport::Channel::maeWithEffects);
  addEffects(report, problem, final);
  addCorrelations(report, found.final.fit.model, found.finalUncertainty, limits.verdict.strongCorrelation);
  addStepErrors(report, problem, final);
  addAlignment(report, problem, final.final, limits.shift);
  addSeries(report, problem, final, Whose::fitted);
  report.disagreements = agreement.told;
  if (const std::string text = textOf(agreement.told, given.recordings.size()); !text.empty())
    report.notes.push_back(text.substr(0, text.size() - 1));
  if (!agreement.aside.empty()) {
    std::vector<Recording> recordings;
    for (const std::size_t trial : agreement.aside) recordings.push_back(asked.recordings[trial]);
    FitProblem aside = prepare(recordings, problem.window_s);
    aside.scene.step_s = problem.scene.step_s;
    addSeries(report, aside, final, Whose::setAside);
  }
  if (!given.heldOut.empty()) {
    if (!progress("scoring held-out recordings", 0.95)) throw Cancelled{};
    FitProblem heldOut = prepare(asked.heldOut, problem.window_s);
    heldOut.scene.step_s = problem.scene.step_s;
    addSeries(report, heldOut, final, Whose::heldOut);
  }
  if (!progress("locating", 0.96)) throw Cancelled{};
  report.located = locate(found.calibrated.fit.model, problem, limits.location);
  if (!progress("looking at what remains", 0.97)) throw Cancelled{};
  if (law.law) addLaw(report, problem, *law.law, found);
  const bool isWhole = !found.cutShort;
  if (options.learnRest && isWhole && !law.applies)
    report.remainder = findRemainder(problem, found, options.jobs, limits);
  const bool curveIsBetter = isWhole && !law.applies && aCurveDoesBetter(problem, found, options.jobs, limits);
  if (options.designNext) report.next = designNext(problem, found, options.seed, limits.nextRecording);
  report.cutShort = !isWhole;
  judge(report, problem, found, curveIsBetter, limits);
  if (!leavesSomethingToAdopt(report.verdict)) report.after = report.before;
  restNothingOnFaults(report);
  if (!isWhole) {
    report.notes.insert(report.notes.begin(),
                        "cut short by the limit of its time, while " + cutWhile +
                            ": other effects, rivals of these and curves were not looked for from there on");
    report.sentence =
        "The analysis was cut short (see the notes): more may be missing than is named. " + report.sentence;
  }
  report.sentence = consultation.caveat + report.sentence;
  if (std::string text = textOf(agreement.told, given.recordings.size()); !text.empty()) {
    text.pop_back();
    report.sentence += " " + text;
  }
  report.seconds = passed_s();
  progress("done", 1);
  return report;
}

}  // namespace btr
