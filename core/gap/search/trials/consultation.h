#pragma once
#include <string>
#include <vector>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/thresholds.h"

namespace btr {

/// What the doctor says of all recordings of an analysis, before anything is simulated.
struct Consultation {
  std::vector<std::string> notes;  ///< of all recordings, held out or not: every finding, gravest first, then what
                                   ///< reading them changed, empty cells, counts
  std::string caveat;              ///< what must lead the report's sentence; "" for healthy recordings
};

/// Throws InputError where a finding is certain, with what to change in the mapping, unless `asRecorded`; and for
/// recordings that do not fit the scene.
Consultation consult(const GapProblem& problem, const EffectLibrary& library, bool asRecorded,
                     const SearchThresholds::Verdict& thresholds = {});

}  // namespace btr
