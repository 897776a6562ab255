#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/thresholds.h"

namespace btr {

struct AnalysisOptions {
  int jobs = 1;  ///< worker processes; the result does not depend on it
  std::uint64_t seed = 1;
  int maximumEffects = 3;
  std::vector<std::string> effects;  ///< which to consider; empty: all
  bool designNext = true;
  /// Step 9: what named effects leave as a curve. It takes longer than all else on a floor; without it no verdict knows
  /// whether the rest has a shape.
  bool learnRest = true;
  /// Asked as progress is. Once it is true nothing more is looked for, and what was found is the report; nothing:
  /// never. The result depends on when.
  std::function<bool()> isEnough{};
  bool asRecorded = false;        ///< goes on where the doctor is certain that a column is not what its name says
  SearchThresholds thresholds{};  ///< of every decision on the way
};

/// Steps 1 to 9 of gap analysis: doctor, noise floor, replay, calibrate, locate, screen, confirm, rivals, remainder.
/// Deterministic for a seed, whatever the number of jobs. What the doctor has to say leads the sentence and the notes.
/// Throws InputError for recordings that the scene cannot replay, for those that the doctor refuses (see
/// consultation.h), for an effect that the library does not have; throws Cancelled when progress says so, which is
/// asked again with the same words while a step takes long.
GapReport analyse(const GapProblem& problem, const EffectLibrary& library, const AnalysisOptions& options,
                  const AnalysisProgress& progress = {});

/// Throws InputError for an effect among options.effects that the library does not have.
void refuseUnknownEffects(const AnalysisOptions& options, const EffectLibrary& library);

}  // namespace btr
