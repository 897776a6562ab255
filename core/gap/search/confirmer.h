#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/score.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/screening/tried_candidate.h"
#include "core/gap/search/selection.h"
#include "core/gap/search/thresholds.h"

namespace btr {

/// True of an effect that is a time alone, shorter than half the scene's step: so far within a step what made the
/// recordings may have integrated or read elsewhere.
bool isWithinHalfAStep(const FitProblem& problem, const FitModel& model, std::size_t effect);

/// What the rules say of a model with one effect more.
struct Acceptance {
  bool passes = false;
  PairedTest comparison;
  std::string reason;  ///< one clause for people
};

/// Adjusts the p-values of a round for all that it looked at (search_discoveries.h); what passes only without that does
/// not pass.
void controlFalseDiscoveries(std::vector<TriedCandidate>& tried, double mostFalse);

/// Fits to the end, scores on what was not fitted to, accepts or not. Thresholds: Confirmation.
class Confirmer {
 public:
  /// Keeps references. `held`: numbers that fits may need beside an effect (held_numbers.h).
  Confirmer(FitService& service, const std::vector<FitParameter>& held) : service_(service), held_(held) {}

  /// Fits some of the candidates to the end and scores those that come near the best with the step `judged_s` or a
  /// finer one. The model `without` them, scored with the step that one needs which passes: the step stays then.
  /// Nothing if none passes: the step is as it was.
  std::optional<Scored> confirm(std::vector<TriedCandidate>& tried, const std::vector<std::size_t>& candidates,
                                const Scored& without, double judged_s, const std::string& stage, double from,
                                double to);
  /// By effect `newEffect` of `with`; both scored with the same step.
  Acceptance judge(const Scored& without, const Scored& with, std::size_t newEffect) const;
  /// What was accepted, fitted on where it still is far from the noise: a curved valley takes its iterations.
  Scored converged(const Scored& scored, const std::string& stage, double at);
  /// The final model converged or brought to the present step, and its rung of the ladder with it.
  void settle(Selection& selection, bool fitToTheEnd, const std::string& stage, double at);

 private:
  /// Fits to the end; those that the scene refuses leave `which`.
  std::vector<Fit> fitted(std::vector<TriedCandidate>& tried, std::vector<std::size_t>& which, const std::string& what,
                          double from, double to) const;
  /// Of a fit near the best, whose cost is `least`: restarts where they may find more. What leaves more than
  /// `worthTaking` [noise floors²] is left as it is.
  void restart(Fit& fit, double least, double worthTaking, const std::string& what, double at) const;
  /// Whether the fit's last effect could as well be much larger, though not absent: friction that holds a joint still
  /// is known from below only, and has no standard error.
  bool isAtLeast(const Fit& fit) const;

  FitService& service_;
  const std::vector<FitParameter>& held_;
};

}  // namespace btr
