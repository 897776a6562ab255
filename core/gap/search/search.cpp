// Structure search: which effects does the simulator lack?
#include "core/gap/search/search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/interruptible.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/search/calibrator.h"
#include "core/gap/search/confirmer.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/model_comparison.h"
#include "core/gap/search/model_reduction.h"
#include "core/gap/search/refinement.h"
#include "core/gap/search/rivals/rival_finder.h"
#include "core/gap/search/rivals/unidentifiable.h"
#include "core/gap/search/screening/candidate_search.h"
#include "core/gap/search/screening/pair_search.h"
#include "core/gap/search/selection.h"
#include "core/gap/search/siblings.h"

namespace btr {
namespace {

/// A shift that takes something, and that is not as far as it may be, where it would stand for something else.
bool isKnown(const Alignment& aligned, const SearchThresholds::Shift& limits) {
  return aligned.took > limits.leastTaken && aligned.ofMost < limits.inside;
}

/// One search: holds its parts and calls one after another.
class StructureSearch {
 public:
  StructureSearch(const FitProblem& problem, const SearchOptions& options) : service_(problem, options) {}

  SearchResult run();

 private:
  int most() const { return service_.options().maximumEffects; }
  std::size_t findings() const { return findingsIn(service_.problem().library, selection_.final.fit.model.effects); }
  bool hasRoomFor(std::size_t effects) const { return static_cast<int>(findings() + effects) <= most(); }
  /// What the last `effects` of the selected model are at other joints.
  void spread(std::size_t effects);
  /// The simulator without effects: where the search begins.
  void beginFrom(const Calibration& calibration);
  /// No more than noise, the integration of either side, and `ofLaws` [noise floors²].
  bool isNothingLeft(double ofLaws) const;
  /// Enough to look for two effects that need each other: more than what was found hides by itself.
  bool isLeftForTwo() const;
  /// What was just found, in more detail where it leaves something.
  void refine();
  /// One effect at a time, or two that need each other, for as long as they help. `stage`: as many are there.
  void addEffects(int stage);
  /// Fewer names or effects that do as well.
  void reduce();
  /// Rivals of what was found. Where one has taken an effect's place and much is left, others may help beside it that
  /// did not help before.
  std::vector<Found> findRivals();
  /// Of the first effect, the numbers as given are a base as well where calibration went far and left much: there it
  /// may have bent them to take up what is missing.
  std::vector<Fit> basesOf(bool first) const;
  Round nextRound(int stage);
  /// Which of them is accepted; the others that pass say so.
  std::optional<std::size_t> winnerOf(std::vector<TriedCandidate>& tried) const;
  /// The effects of the selected model without rivals, judged as when they came in.
  std::vector<Found> asTheyCame() const;
  /// Uncertainties of the rivals' fits.
  void measureRivals(std::vector<Found>& effects) const;

  FitService service_;
  Calibrator calibrator_{service_};
  Calibration calibration_;
  Confirmer confirmer_{service_, calibration_.held};
  CandidateSearch candidates_{service_, confirmer_};
  PairSearch pairs_{service_, confirmer_, candidates_};
  Selection selection_;
  std::vector<TriedCandidate> firstRound_;
};

void StructureSearch::beginFrom(const Calibration& calibration) {
  calibration_ = calibration;
  selection_.ladder = {rungOf("as given", calibration_.given), rungOf("calibrated", calibration_.calibrated)};
  selection_.final = calibration_.base;
}

std::vector<Fit> StructureSearch::basesOf(bool first) const {
  const SearchThresholds::Calibration& limits = service_.thresholds().calibration;
  std::vector<Fit> bases{selection_.final.fit};
  if (!first || excessOf(selection_.final) < limits.muchLeft) return bases;
  const FitModel& model = selection_.final.fit.model;
  FitModel given = model;
  bool far = false;
  for (std::size_t i = 0; i < model.parameters.size(); ++i) {
    given.values[i] = model.parameters[i].given;
    far = far || std::abs(model.values[i] - given.values[i]) > limits.farFromGiven * model.parameters[i].scale;
  }
  if (far) bases.push_back({given, calibration_.given.fit.shifts, 0});
  return bases;
}

Round StructureSearch::nextRound(int stage) {
  const double from = 0.1 + 0.7 * stage / most();
  return candidates_.search({.without = selection_.final,
                             .models = basesOf(stage == 0),
                             .known = stage == 0 ? &calibration_.linear : nullptr,
                             .toFit = service_.thresholds().screening.fitted,
                             .stage = stage == 0 ? "" : ", effect " + std::to_string(stage + 1),
                             .from = from,
                             .to = from + 0.7 / most(),
                             .lastChance = true,
                             .beyondBest = stage == 0});
}

std::optional<std::size_t> StructureSearch::winnerOf(std::vector<TriedCandidate>& tried) const {
  std::optional<std::size_t> winner;
  for (std::size_t k = 0; k < tried.size(); ++k) {
    if (!tried[k].passes) continue;
    if (!winner)
      winner = k;
    else
      tried[k].attempt.reason = tried[*winner].attempt.candidate.text() + " does better";
  }
  if (winner) tried[*winner].attempt.accepted = true;
  return winner;
}

bool StructureSearch::isNothingLeft(double ofLaws) const {
  // What the integration itself is wrong by, ours or the recording's, is not physics that was left out.
  const double ofOthers = selection_.final.aligned.numericalFloor(service_.thresholds().shift.ofTaken);
  const SearchThresholds::Screening& limits = service_.thresholds().screening;
  const double nothing = service_.problem().noisyTorques ? limits.nothingUnderTorques : limits.nothingLeft;
  return selection_.final.mean() < nothing + ofLaws + ofOthers + stepErrorOf(service_.stepChange(selection_.final.fit));
}

bool StructureSearch::isLeftForTwo() const {
  const SearchThresholds::Screening& limits = service_.thresholds().screening;
  const double left = excessOf(selection_.final);
  const bool isLittle = left < limits.littleExcess && left < limits.littleOfExcess * excessOf(calibration_.calibrated);
  return left > limits.lastChanceExcess && !isLittle;
}

void StructureSearch::spread(std::size_t effects) {
  const std::size_t first = selection_.final.fit.model.effects.size() - effects;
  for (std::size_t i = first; i < first + effects; ++i)
    if (!isNothingLeft(0)) addSiblings(service_, confirmer_, selection_, i);
}

void StructureSearch::refine() {
  if (!isNothingLeft(0)) refineLaws(service_, confirmer_, selection_);
}

void StructureSearch::addEffects(int stage) {
  const SearchThresholds::Screening& limits = service_.thresholds().screening;
  bool recalibrated = false;
  std::optional<Choice> choice;  // of the last effect, where it was accepted by itself
  for (; stage < most(); ++stage) {
    if (isNothingLeft(imperfectionOf(calibration_.calibrated, selection_.final, limits))) break;
    Round round = nextRound(stage);
    std::vector<TriedCandidate>& tried = round.tried;
    selection_.final = round.without;
    if (stage == 0) firstRound_ = tried;
    const std::optional<std::size_t> winner = winnerOf(tried);
    for (const TriedCandidate& each : tried) selection_.remember(each.attempt);
    if (winner) {
      const std::string name = tried[*winner].attempt.candidate.text();
      choice = Choice{selection_.final, name, tried};
      choice->others.erase(choice->others.begin() + static_cast<std::ptrdiff_t>(*winner));
      const auto converged = [&] {
        return confirmer_.converged(tried[*winner].scored, "confirming", 0.1 + 0.7 * stage / most() + 0.7 / most());
      };
      Scored with = converged();
      const auto anew = stage == 0 && !recalibrated ? calibrator_.recalibrate(calibration_, with) : std::nullopt;
      if (anew) {
        for (Attempt& attempt : selection_.attempts)
          if (attempt.accepted) {
            attempt.accepted = false;
            attempt.reason = "useless once the calibrated numbers were fitted from where it left them";
          }
        beginFrom(*anew);
        recalibrated = true;
        choice.reset();
        --stage;
        continue;
      }
      // Beside what explains most, the shift in time that is no physics is known: numbers are fitted with it. (Without
      // it the shift would stand for what is missing, and calibration would do without the effect.)
      if (isKnown(with.aligned, service_.thresholds().shift)) {
        service_.setShift(with.aligned.shift_s);
        with = converged();
      }
      selection_.take(with, "+ " + name);
      spread(1);
      refine();
      continue;
    }
    const bool mayBeTwo = hasRoomFor(2) && isLeftForTwo() && pairs_.promisesAPair(tried);
    if (const auto pair = mayBeTwo ? pairs_.find(selection_.final, tried) : std::nullopt) {
      PairSearch::accept(selection_, *pair, "+ ");
      spread(2);
      refine();
      choice.reset();
      ++stage;
    } else if (choice && hasRoomFor(1) && pairs_.replaceOne(selection_, *choice)) {
      choice.reset();
    } else {
      break;
    }
  }
}

void StructureSearch::reduce() {
  mergeForms(service_, selection_, calibration_.calibrated);
  dropRedundant(service_, selection_, calibration_.calibrated);
}

std::vector<Found> StructureSearch::findRivals() {
  const auto namesNow = [&] {
    std::set<std::string> names;
    for (const PlacedEffect& effect : selection_.final.fit.model.effects) names.insert(effect.text());
    return names;
  };
  for (int round = 1;; ++round) {
    if (!selection_.final.fit.model.effects.empty()) confirmer_.settle(selection_, true, "fitting once more", 0.86);
    const std::set<std::string> before = namesNow();
    RivalSearch rivals = RivalFinder(service_, confirmer_, candidates_, calibration_.calibrated, firstRound_)
                             .find(std::move(selection_));
    selection_ = std::move(rivals.selection);
    const std::set<std::string> after = namesNow();
    if (round == service_.thresholds().rivals.rounds || after == before || !hasRoomFor(1) ||
        excessOf(selection_.final) < service_.thresholds().screening.doubtfulExcess)
      return std::move(rivals.effects);
    addEffects(static_cast<int>(findings()));
    dropRedundant(service_, selection_, calibration_.calibrated);
    if (namesNow() == after) return std::move(rivals.effects);
  }
}

std::vector<Found> StructureSearch::asTheyCame() const {
  std::vector<Found> found;
  for (const PlacedEffect& effect : selection_.final.fit.model.effects) {
    found.push_back({effect, {}, 1, {}, {}, {}});
    for (const Attempt& attempt : selection_.attempts) {
      if (attempt.candidate.text() != effect.text() || !attempt.accepted) continue;
      found.back().comparison = attempt.comparison;
      if (std::isfinite(attempt.qValue)) found.back().qValue = attempt.qValue;
    }
  }
  return found;
}

void StructureSearch::measureRivals(std::vector<Found>& effects) const {
  for (Found& found : effects)
    for (const Fit& rival : found.rivalFits) {
      found.rivalUncertainties.push_back(
          uncertaintyOf(service_.problem(), rival, linearise(service_.problem(), rival)));
      service_.announce("what rivals would make of the numbers", 0.95);
    }
}

SearchResult StructureSearch::run() {
  const Calibration calibration = calibrator_.calibrate();
  if (calibration.unstable) {
    SearchResult result;
    result.given = calibration.given;
    result.calibrated = calibration.calibrated;
    result.ladder = {rungOf("as given", calibration.given)};
    result.unstable = true;
    return result;
  }
  beginFrom(calibration);
  bool isWhole = unlessEnough([&] {
    addEffects(0);
    reduce();
    if (takeApart(service_, selection_, calibration_.calibrated)) refine();
    dropRedundant(service_, selection_, calibration_.calibrated);
  });
  std::vector<Found> effects;
  if (isWhole) {
    const Selection before = selection_;
    isWhole = unlessEnough([&] { effects = findRivals(); });
    if (!isWhole) selection_ = before;
  }
  if (!isWhole) {
    confirmer_.settle(selection_, false, "coming to an end", 0.9);
    effects = asTheyCame();
  }

  raiseUnreached(service_, selection_.final.fit);
  Measurement measured = measure(service_, selection_.final.fit);
  if (const auto back = backAsGiven(service_, selection_.final, measured)) {
    if (selection_.final.fit.model.effects.empty())
      calibration_.calibrated = back->of(calibration_.calibrated.fit.model);
    selection_.takeInstead(back->of(selection_.final.fit.model));
    measured = measure(service_, selection_.final.fit);
  }
  measureRivals(effects);

  SearchResult result;
  result.given = std::move(calibration_.given);
  result.calibrated = std::move(calibration_.calibrated);
  result.calibratedLinear = std::move(calibration_.linear);
  result.calibratedUncertainty = std::move(calibration_.uncertainty);
  result.final = std::move(selection_.final);
  result.attempts = std::move(selection_.attempts);
  result.ladder = std::move(selection_.ladder);
  result.effects = std::move(effects);
  result.cutShort = !isWhole;
  result.stepChange = std::move(measured.stepChange);
  result.finalLinear = std::move(measured.linear);
  result.finalUncertainty = std::move(measured.uncertainty);
  result.step_s = service_.step_s();
  result.refused = service_.refused();
  return result;
}

}  // namespace

double stepErrorOf(const Eigen::VectorXd& stepChange) {
  return stepChange.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, stepChange.size()));
}

double excessOf(const Scored& scored) { return std::max(0.0, scored.mean() - 1); }

SearchResult searchEffects(const FitProblem& problem, const SearchOptions& options) {
  return StructureSearch(problem, options).run();
}

}  // namespace btr
