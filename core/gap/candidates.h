#pragma once
#include <string>
#include <vector>

#include "core/gap/fit.h"

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

/// All effects of the library (or of `names`, if it is not empty) at all places of a scene, without those that are
/// `there` already.
std::vector<EffectCandidate> candidatesFor(const Scene& scene, const EffectLibrary& library,
                                           const std::vector<PlacedEffect>& there,
                                           const std::vector<std::string>& names);
/// What an effect declares, as far as the recordings can show it at a place: periods are called so only where the
/// motion passes two of them. A minimum above the maximum: not at all.
std::vector<Parameter> parametersAt(const FitProblem& problem, const std::string& effect, const std::string& at);
/// The same for a fit: without those that the simulator as given or `model` already has, and those that the recordings
/// cannot show.
std::vector<EffectCandidate> candidatesFor(const FitProblem& problem, const FitModel& model,
                                           const std::vector<std::string>& names);

/// The variant moved along its own direction: neutral + step·(variant − neutral), within the bounds.
Values scaledVariant(const EffectCandidate& candidate, const Values& variant, double step);

/// How one candidate would do: a score test. The excess residual is regressed on what the candidate changes, together
/// with the sensitivities of the parameters that are fitted already and of the initial states.
struct Screened {
  std::size_t candidate = 0;
  bool excited = false;  ///< the recordings feel it at a typical size
  double share = 0;      ///< of the sum of squared residuals that it would take away
  struct Start {
    Values effect;
    std::vector<double> parameters;  ///< of the model, moved along to where they would go
    double share = 0;
  };
  std::vector<Start> starts;  ///< the best that was looked at, then what others promise, best first; none: not felt at
                              ///< any size
};
/// In the order of the candidates. Candidates of a model that cannot be simulated are not excited.
std::vector<Screened> screen(const FitProblem& problem, const Fit& fit, const Linearised& linear,
                             const std::vector<EffectCandidate>& candidates, int jobs,
                             const std::function<bool(std::size_t)>& goOn = {});

}  // namespace btr
