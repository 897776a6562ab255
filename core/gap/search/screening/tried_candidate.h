#pragma once
#include <cstddef>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/score.h"
#include "core/gap/search/search.h"

namespace btr {

/// A candidate on its way through screening and confirmation.
struct TriedCandidate {
  Attempt attempt;
  Fit fit;                  ///< of the model with it, once attempt.fitted
  Scored scored;            ///< the same, once attempt.scored
  bool passes = false;      ///< better than without it, by the rules
  std::size_t promise = 0;  ///< its place among the screened candidates
  double settled_s = 0;     ///< step with which it was fitted to the end and scored [s]; 0: it was not
};

}  // namespace btr
