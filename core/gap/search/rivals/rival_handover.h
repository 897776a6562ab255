#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/score.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/screening/candidates.h"

namespace btr {

/// What stands in the place of an effect after a handover.
struct HandedOver {
  EffectCandidate candidate;
  Scored scored;  ///< at the step that effects are looked for with
};

/// Rivals that no screening sees: an effect hands its place over to another one bit by bit. What the recordings cannot
/// distinguish lies at the two ends of one valley; from afar, a fit of the other end finds some hill between.
/// Thresholds: Rivals.
class RivalHandover {
 public:
  /// Keeps a reference.
  explicit RivalHandover(FitService& service) : service_(service) {}

  /// What the recordings may not distinguish from effect `i` of a model, or find better: its size is taken away in
  /// steps, and at each what is offered its place is fitted on. Only what is `eligible`.
  std::vector<HandedOver> handOver(std::size_t i, const Scored& final, const Eligible& eligible);

 private:
  struct Way;
  std::vector<Way> waysFrom(const Fit& base, const FitModel& rest, const PlacedEffect& own, const Eligible& eligible,
                            bool muchLeft) const;
  FitModel simplerFormOf(const Fit& full, const FitModel& rest, const EffectCandidate& candidate, bool muchLeft) const;

  void keepInRace(std::vector<FitJob>& jobs, std::vector<EffectCandidate>& offered, double most) const;

  FitService& service_;
};

}  // namespace btr
