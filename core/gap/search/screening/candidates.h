#pragma once
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/fit_model.h"
#include "core/gap/fit/fit_problem.h"
#include "core/gap/fit/gap_problem.h"
#include "core/gap/search/thresholds.h"

namespace btr {

/// An effect at a place where it can sit, and sizes at which it is tried.
struct EffectCandidate {
  std::string effect, at;
  std::vector<Parameter> declared;
  /// All parameters; neutral but for one, at a finite, typical size, and at joints that stand still at the largest.
  std::vector<Values> variants;

  PlacedEffect placed(const Values& values) const { return {effect, at, values}; }
  std::string text() const { return effect + " at " + at; }
};

/// Which candidates are looked at: all of them, or those at one place, or of some effects there.
struct Eligible {
  std::string at{};                                ///< the one place; empty: any
  std::optional<std::set<std::string>> effects{};  ///< nothing: all

  bool isNone() const { return effects && effects->empty(); }
  bool operator()(const EffectCandidate& candidate) const {
    return (at.empty() || candidate.at == at) && (!effects || effects->contains(candidate.effect));
  }
};

/// All effects of the library (or of `names`, if it is not empty) at all places of a scene, without those that are
/// `there` already.
std::vector<EffectCandidate> candidatesFor(const Scene& scene, const EffectLibrary& library,
                                           const std::vector<PlacedEffect>& there,
                                           const std::vector<std::string>& names,
                                           const SearchThresholds::Candidates& thresholds = {});
/// What an effect declares, as far as the recordings can show it at a place: periods are called so only where the
/// motion passes two of them. A minimum above the maximum: not at all.
std::vector<Parameter> parametersAt(const FitProblem& problem, const std::string& effect, const std::string& at,
                                    const SearchThresholds::Candidates& thresholds = {});
/// The same for a fit: without those that the simulator as given or `model` already has, and those that the recordings
/// cannot show.
std::vector<EffectCandidate> candidatesFor(const FitProblem& problem, const FitModel& model,
                                           const std::vector<std::string>& names,
                                           const SearchThresholds::Candidates& thresholds = {});

/// True if the candidate is a richer form of the effect at the same place: not a rival of what it contains.
bool isRicher(const EffectLibrary& library, const EffectCandidate& candidate, const PlacedEffect& effect);
/// True if the candidate is a simpler form of the effect at the same place.
bool isSimplerForm(const EffectLibrary& library, const EffectCandidate& candidate, const PlacedEffect& effect);

/// The declared angle that goes round (FitParameter::goesRound), as of a wave; nullptr if there is none.
const Parameter* phaseOf(const std::vector<Parameter>& declared);

/// The variant moved along its own direction: neutral + step·(variant − neutral), within the bounds.
Values scaledVariant(const EffectCandidate& candidate, const Values& variant, double step);

}  // namespace btr
