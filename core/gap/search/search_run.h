// Structure search, inside: see search.h.
#pragma once
#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/refused_jobs.h"
#include "core/gap/search/search.h"

namespace btr {

/// Whether a model without something predicts worse than the one with it.
inline bool isMissed(const Scored& without, const Scored& with, const SearchThresholds::Confirmation& limits) {
  const PairedTest comparison = compare(without.blocks, with.blocks);
  return comparison.t >= limits.missedT && comparison.gain >= limits.leastGain;
}

inline bool costsLess(const Fit& a, const Fit& b) { return a.cost < b.cost; }

/// One search from calibration to rivals.
class SearchRun {
 public:
  SearchRun(const FitProblem& problem, const SearchOptions& options) : problem_(problem), options_(options) {}

  SearchResult run();

 private:
  struct Tried {
    Attempt attempt;
    Fit fit;
    Scored scored;
    bool passes = false;      ///< better than without it, by the rules
    std::size_t promise = 0;  ///< its place among the screened candidates
  };
  struct FitJob {
    FitModel model;
    std::vector<std::vector<double>> shifts;
    const Linearised* inherited = nullptr;  ///< see FitOptions
    double tolerance = FitOptions{}.tolerance;
  };
  const SearchThresholds& limits() const { return options_.thresholds; }
  bool isConsidered(const std::string& effect) const {
    return options_.names.empty() ||
           std::find(options_.names.begin(), options_.names.end(), effect) != options_.names.end();
  }
  std::function<bool(std::size_t)> reporter(const std::string& stage, std::size_t count, double from, double to) const {
    if (!options_.progress) return {};
    return [this, stage, count, from, to](std::size_t done) {
      const double share = count > 0 ? static_cast<double>(done) / static_cast<double>(count) : 1;
      return tell(stage, from + (to - from) * share);
    };
  }

  /// Tells whoever waits; shares never go back.
  bool tell(const std::string& stage, double share) const {
    told_ = std::max(told_, share);
    return options_.progress(stage, told_);
  }
  /// Few jobs run one after another, the segments of each in all workers, where there are enough of them.
  int workersFor(std::size_t count) const;
  /// Nothing for a fit whose numbers the scene refuses; those are counted in refused_.
  std::vector<std::optional<Fit>> tryFits(const std::vector<FitJob>& jobs, int iterations, const std::string& stage,
                                          double from, double to) const;
  static std::vector<Fit> thoseOf(std::vector<std::optional<Fit>> tried);  ///< that came to an end
  /// The same for fits that must not fail: throws InputError if the scene refuses one.
  std::vector<Fit> fitAll(const std::vector<FitJob>& jobs, int iterations, const std::string& stage, double from,
                          double to) const;
  std::vector<Fit> fitOn(const std::vector<Fit>& fits, int iterations, const std::string& stage, double from,
                         double to) const;
  /// What was scored with another step is fitted on and scored with the present one: only then it can be compared.
  void bringToStep(Scored& scored, const std::string& stage, double at) const;
  /// Fits models that lack something of `full` with a step that it bears, and scores them; those that come near it are
  /// fitted on at the present step.
  std::vector<Scored> fitAndScore(const std::vector<FitJob>& jobs, const Fit& full, const std::string& stage,
                                  double from, double to);
  /// Nothing for a fit whose numbers, as half of the blocks would have them, the scene refuses.
  std::vector<std::optional<Scored>> tryScores(const std::vector<Fit>& fits, const std::string& stage, double from,
                                               double to) const;
  /// The same for fits that must not fail: throws InputError.
  std::vector<Scored> scoreAll(const std::vector<Fit>& fits, const std::string& stage, double from, double to) const;
  Scored calibrate();
  /// A candidate with a whole number that leaves much: other numbers, begun in short windows.
  void fitFromWindows(Fit& fit, const FitModel& without, const std::string& stage, double at) const;
  /// Of a walk: the calibrated numbers begun where replays alone, all over their ranges, say that it is best.
  void scatter(Fit& fit, const std::string& stage, double at) const;
  /// Candidates at joints, where none explains it yet: an effect's own numbers begun so in short windows, all others as
  /// one of the fits without it has them.
  void fitFromScatter(std::vector<Tried>& tried, const std::vector<std::size_t>& which, const std::vector<Fit>& without,
                      const std::string& stage, double at) const;
  /// A search over the same recordings in windows of that length, in which a motion begins anew and stays near.
  SearchRun inWindows(double length_s) const;
  /// Fits from windows of that length, gone on with in ever longer ones and at last over whole trials from `shifts`.
  std::vector<Fit> inLongerWindows(std::vector<Fit> fits, double length_s,
                                   const std::vector<std::vector<double>>& shifts, const std::string& stage,
                                   double at) const;
  /// The best of replays with these parameters drawn all over their ranges and then ever closer around the best.
  FitModel drawnAround(const FitModel& start, const std::vector<std::vector<double>>& shifts,
                       const std::vector<std::size_t>& which, const std::string& purpose, const std::string& stage,
                       double at) const;
  void climbWholeNumbers(Fit& fit, const std::string& stage, double at) const;
  void startAnew(Fit& fit, const std::string& stage, double at) const;
  Scored converged(const Scored& scored, const std::string& stage, double at);
  /// The final model converged or brought to the present step, and its rung of the ladder with it.
  void settle(SearchResult& result, bool fitToTheEnd, const std::string& stage, double at);
  /// All candidates, screened and, where they promise something, fitted, scored and compared with `without`; scored
  /// ones first, best first. Fits begin from any of the models, of which the first is that of `without`, with its
  /// sensitivities if they are known. Where something passes that needs a finer step, that step stays and `without` is
  /// scored with it. With `lastChance` all that promise anything are fitted before none is said to help.
  std::vector<Tried> tryCandidates(Scored& without, const std::vector<Fit>& models, const Linearised* known,
                                   std::size_t toFit, const std::string& stage, double from, double to,
                                   bool lastChance = false);
  /// Fits some of them to the end and scores those that come near the best with the step `judged_s` or a finer one, of
  /// which one may pass; true if one does. The step stays as it was if none does.
  bool confirm(std::vector<Tried>& tried, const std::vector<std::size_t>& which, Scored& without, double judged_s,
               const std::string& stage, double from, double to);
  /// The coarsest step, from that of the calibrated simulator on, that a model bears: what to add to it is looked for
  /// there, and judged at the present one.
  double stepToSearchWith(const Fit& fit) const;
  /// Whether the fit's last effect could as well be much larger, though not absent: friction that holds a joint still
  /// is known from below only, and has no standard error.
  bool isAtLeast(const Fit& fit) const;
  void shake(std::vector<Fit>& fits, const std::string& stage, double at) const;
  void scan(Fit& fit, const std::string& stage, double at) const;
  void leap(Fit& fit, const std::string& stage, double at) const;
  std::vector<Fit> basesOf(const SearchResult& result, bool first) const;
  bool passes(const Scored& without, const Scored& with, std::size_t newEffect, PairedTest& comparison,
              std::string& reason) const;
  /// Adjusts the p-values of a round for all that it looked at; what passes only without that does not pass.
  void controlFalseDiscoveries(std::vector<Tried>& tried) const;
  /// The p-value of an effect adjusted for all candidates of its place in the model.
  static double rateAmong(const std::vector<Tried>& others, const Found& found);
  /// Two effects that need each other still show a little alone.
  bool promisesAPair(const std::vector<Tried>& tried) const;
  bool tryPair(const Scored& current, const std::vector<Tried>& singles, Scored& pair);
  /// Marks the last two effects of the final model as accepted, with a rung of the ladder: `what` is done.
  void acceptPair(SearchResult& result, const Scored& pair, const std::string& what);
  /// What else there was when an effect was accepted alone.
  struct Choice {
    Scored without;             ///< the model before
    std::string accepted;       ///< the effect, as text
    std::vector<Tried> others;  ///< candidates, best first
  };
  /// Where an effect left much and nothing more was found beside it: two others in its place, if they do better. True
  /// if they do.
  bool chooseTwoOthers(SearchResult& result, const Choice& choice);
  /// Calibrated numbers that the recordings do not feel stay as given from here on: each costs a replay a step.
  void holdUntold(SearchResult& result);
  /// Numbers that were held and are felt beside what was added: a servo that saturates with the rotor that was left out
  /// alone. Fitted again with them where that helps.
  void giveBack(std::vector<Fit>& fits, const std::string& stage, double at) const;
  /// In the end, numbers that the recordings hardly tell are as given where they explain the recordings as well: what
  /// they went elsewhere for is noise, and other motions may feel it. True if one is.
  bool leaveUntold(SearchResult& result) const;
  /// Sensitivities and uncertainties of the final model.
  void measure(SearchResult& result) const;
  void measureRivals(SearchResult& result) const;  ///< uncertainties of their fits
  /// Of the first effect: true if the calibrated numbers, begun where the effect left them, do as well without it. They
  /// are the calibrated simulator then, and the search begins anew.
  bool calibrateFrom(SearchResult& result);
  void prune(SearchResult& result);
  void takeApart(SearchResult& result);
  bool isRicher(const EffectCandidate& candidate, const PlacedEffect& effect) const;
  std::vector<Tried> inPlaceOf(std::size_t i, const SearchResult& result, Scored& without);
  bool replace(std::size_t i, const std::vector<Tried>& others, SearchResult& result) const;
  /// Adds simpler effects that together say the same in the place of the final model's effect `i`.
  void addTogether(std::size_t i, const SearchResult& result, const std::vector<Tried>& others, Found& found) const;
  /// Other effects in the place of one of the final model's.
  struct Offered {
    Scored without;  ///< with the place empty
    std::vector<Tried> others;
  };
  /// `known`: by what stands beside the place, as text.
  Offered& offeredTo(std::size_t i, const SearchResult& result, std::map<std::set<std::string>, Offered>& known);
  /// The final model's effect `i` with its rivals.
  Found foundAt(std::size_t i, const Offered& offered, SearchResult& result) const;
  void findRivals(SearchResult& result);
  /// Adds what the recordings may not tell from effect `i`, or tell for the better: its size is taken away in steps,
  /// and at each what is offered its place is fitted on. From afar, a fit would stop in a side minimum.
  void handOver(std::size_t i, const SearchResult& result, std::vector<Tried>& others);
  struct Way;
  FitModel simplerFormOf(const Fit& full, const FitModel& rest, const EffectCandidate& candidate) const;
  std::vector<Way> waysFrom(const Fit& base, const FitModel& rest, const PlacedEffect& own) const;
  void addRival(const EffectCandidate& candidate, const Scored& scored, const SearchResult& result,
                std::vector<Tried>& others) const;
  void compareAtOneStep(SearchResult& result, std::vector<Tried>& others);
  void remember(std::vector<Attempt>& attempts, const Attempt& attempt) const;
  GapReport::Step step(const std::string& what, const Scored& scored) const;

  /// Change of the residuals with half the step.
  Eigen::VectorXd stepChange(const Fit& fit) const;
  /// Halves the step until half of it changes no fit by more than what hides in the noise, and fits again; keeps the
  /// step where none does (walks that part at each landing). Of `fits`, the first `judged` are asked.
  void refineStep(std::vector<Fit>& fits, std::size_t judged, const std::string& stage, double at);

  FitProblem problem_;  ///< its step may become finer on the way
  const SearchOptions& options_;
  double search_s_ = 0;             ///< the step that the calibrated simulator needs
  std::vector<FitParameter> held_;  ///< numbers that the calibrated simulator does not feel, as given
  mutable double told_ = 0;
  std::shared_ptr<RefusedJobs> refused_ = std::make_shared<RefusedJobs>();  ///< one for the searches in windows, too
  std::vector<Tried> firstStage_;
};

}  // namespace btr
