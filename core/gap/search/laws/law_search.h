#pragma once
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "core/gap/fit/linearise.h"
#include "core/gap/fit/score.h"
#include "core/gap/fit/uncertainty.h"
#include "core/gap/search/laws/law_terms.h"
#include "core/gap/search/search.h"
#include "core/gap/search/thresholds.h"

namespace btr {

/// A law that was fitted, in the simulator that it was learned beside.
struct LearnedLaw {
  Law law;
  Scored scored;  ///< of the model with it as its last effect
  Linearised linear;
  Uncertainty uncertainty;
  double shareOfRest = 0;  ///< of the squared error that the model without it leaves
  double pValue = 1;       ///< paired, against the model without it, times the curves that were looked at
};

/// What no effect explains: a curve at one joint, chosen by cross-validation over trials, refined in replay, kept where
/// a paired test says so among all that was looked at. Nothing where too little is left, or it has no shape, or the
/// library does not know the effect. `linear`: of `without`. A curve that leaves more than `hopeless` (mean squared
/// error) after its first fit is not fitted on.
std::optional<LearnedLaw> learnLaw(const FitProblem& problem, const Scored& without, const Linearised& linear, int jobs,
                                   const SearchThresholds& thresholds,
                                   double hopeless = std::numeric_limits<double>::infinity());

/// What a law beside the named effects leaves of these.
struct LawBesideNames {
  bool applies = false;  ///< joints were recorded, of which laws are learned
  std::optional<LearnedLaw> law;
  std::vector<std::string> fell;  ///< named effects that are useless, or another size, with the law: taken back
};
/// Learns a law of one curve beside what was found. Named effects stay only if they are missed, and keep their size,
/// with the law in the model; and if no law alone does as well as both. The others are taken out of `found`, whose
/// final simulator is then fitted without them (and has no law). Where no name is left they are looked for once more
/// with the law in the simulator, and come into `found`; else a second curve may join the first.
LawBesideNames learnBesideNames(const FitProblem& problem, SearchResult& found, const SearchOptions& options);

/// `found` with the law in its final simulator.
SearchResult withLearned(const FitProblem& problem, const SearchResult& found, const LearnedLaw& law);

}  // namespace btr
