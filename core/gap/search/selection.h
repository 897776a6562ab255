#pragma once
#include <string>
#include <vector>

#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/score.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/search.h"

namespace btr {

/// The model that a search has come to, and how.
struct Selection {
  Scored final;
  std::vector<Attempt> attempts;        ///< one per effect and place
  std::vector<GapReport::Step> ladder;  ///< the last rung is `final`

  /// Takes a model, with a rung of its own.
  void take(const Scored& model, const std::string& what);
  /// Takes a model in the place of the last rung's.
  void takeInstead(const Scored& model);
  /// Keeps an attempt, of each candidate the one that came furthest, the first of those.
  void remember(const Attempt& attempt);
};

/// What is remembered of an effect that `model` has in the place of another one.
Attempt accepted(const EffectCandidate& candidate, const FitProblem& problem, const FitModel& model, std::size_t effect,
                 const PairedTest& comparison, std::string reason);

/// A rung of the ladder: error in noise floors, with its standard error over the blocks.
GapReport::Step rungOf(const std::string& what, const Scored& scored);

}  // namespace btr
