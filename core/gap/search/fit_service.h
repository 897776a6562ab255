#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/search/refused_jobs.h"
#include "core/gap/search/screening/candidates.h"
#include "core/gap/search/search.h"
#include "core/gap/search/step_guard.h"

namespace btr {

/// A fit to be made.
struct FitJob {
  FitModel model;
  std::vector<std::vector<double>> shifts;
  const Linearised* inherited = nullptr;  ///< see FitOptions
  double tolerance = FitOptions{}.tolerance;
};

inline bool costsLess(const Fit& a, const Fit& b) { return a.cost < b.cost; }

/// What all parts of a search share: fits and scores of many models at once, the step that they are made with,
/// progress, what the scene refuses. `from`, `to`, `at` are shares of the whole search, for progress.
class FitService {
 public:
  /// Copies the problem, since its step may become finer; keeps a reference to the options.
  FitService(const FitProblem& problem, const SearchOptions& options) : problem_(problem), options_(options) {}

  const FitProblem& problem() const { return problem_; }
  const SearchOptions& options() const { return options_; }
  const SearchThresholds& thresholds() const { return options_.thresholds; }
  bool isConsidered(const std::string& effect) const;
  /// What may be added to a model, of all considered effects, or of these.
  std::vector<EffectCandidate> candidatesBeside(const FitModel& model) const;
  std::vector<EffectCandidate> candidatesBeside(const FitModel& model, const std::vector<std::string>& names) const;
  std::vector<Parameter> parametersOf(const PlacedEffect& effect) const;  ///< see parametersAt

  /// For jobs that report how many are done; none where nobody waits.
  std::function<bool(std::size_t)> reporter(const std::string& stage, std::size_t count, double from, double to) const;
  /// Tells whoever waits; shares never go back. Throws Cancelled where that is asked for.
  void announce(const std::string& stage, double share) const;

  /// Nothing for a fit whose numbers the scene refuses; those are counted.
  std::vector<std::optional<Fit>> tryFits(const std::vector<FitJob>& jobs, int iterations, const std::string& stage,
                                          double from, double to) const;
  /// The same for fits that must not fail: throws InputError if the scene refuses one.
  std::vector<Fit> fitAll(const std::vector<FitJob>& jobs, int iterations, const std::string& stage, double from,
                          double to) const;
  std::vector<Fit> refit(const std::vector<Fit>& fits, int iterations, const std::string& stage, double from,
                         double to) const;
  /// Nothing for a fit whose numbers, as half of the blocks would have them, the scene refuses.
  std::vector<std::optional<Scored>> tryScores(const std::vector<Fit>& fits, const std::string& stage, double from,
                                               double to) const;
  /// One fit, scored; nothing if the scene refuses it or its score.
  std::optional<Scored> tryScored(const FitJob& job, int iterations, const std::string& stage, double at) const;
  /// The same for fits that must not fail: throws InputError.
  std::vector<Scored> scoreAll(const std::vector<Fit>& fits, const std::string& stage, double from, double to) const;
  /// What was scored with another step is fitted on and scored with the present one: only then it can be compared.
  void bringToStep(Scored& scored, const std::string& stage, double at) const;
  /// Fits models that lack something of `full` with a step that it bears, and scores them; those that come near it are
  /// fitted on at the present step.
  std::vector<Scored> fitAndScore(const std::vector<FitJob>& jobs, const Fit& full, const std::string& stage,
                                  double from, double to);

  double step_s() const { return problem_.scene.step_s; }
  /// The only ways to change the step: for as long as the guard lives, or longer if it is kept.
  StepGuard guardStep() { return StepGuard(problem_.scene.step_s); }
  StepGuard guardStep(double now_s) { return StepGuard(problem_.scene.step_s, now_s); }
  /// From here on joints are compared so much further on (alignment.h).
  void setShift(double shift_s) { problem_.shift_s = shift_s; }
  /// The present step is the one that the calibrated simulator needs.
  void setCalibratedStep() { calibrated_s_ = step_s(); }
  /// The coarsest step, from that of the calibrated simulator on, that a model bears: what to add to it is looked for
  /// there, and judged at the present one.
  double stepToSearchWith(const Fit& fit) const;
  /// Mean squared residual of a fit, shifted in time by what is no physics (alignment.h) [noise floors²].
  double leftBy(const Fit& fit) const;
  /// Change of the residuals with half the step.
  Eigen::VectorXd stepChange(const Fit& fit) const;
  /// Halves the step until half of it changes no fit by more than what hides in the noise, and fits again; keeps the
  /// step where none does (walks that part at each landing). Of `fits`, the first `judged` are asked.
  void refineStep(std::vector<Fit>& fits, std::size_t judged, const std::string& stage, double at);

  /// The same over the same recordings in windows of that length, in which a motion begins anew and stays near.
  FitService inWindows(double length_s) const;
  /// What was left out, counted (refused_jobs.h).
  std::vector<std::string> refused() const { return refused_->notes(); }

 private:
  /// Few jobs run one after another, the segments of each in all workers, where there are enough of them.
  int workersFor(std::size_t count) const;
  bool report(const std::string& stage, double share) const;  ///< false: to be cancelled

  FitProblem problem_;  ///< its step may become finer on the way
  const SearchOptions& options_;
  double calibrated_s_ = 0;
  mutable double reported_ = 0;
  std::shared_ptr<RefusedJobs> refused_ = std::make_shared<RefusedJobs>();  ///< one for the services in windows, too
};

/// Those that came to an end.
std::vector<Fit> completed(std::vector<std::optional<Fit>> tried);

}  // namespace btr
