#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/search.h"

namespace btr {

/// Which trials a search rests on.
struct Agreement {
  std::vector<GapReport::Disagreement> told;
  std::vector<std::size_t> aside;  ///< indices into the recordings that were given
  /// The search without them, and what it searched; nothing where none is set aside.
  struct Without {
    FitProblem problem;
    SearchResult found;
  };
  std::optional<Without> without;
};

/// Looks for trials that disagree with the others in what was found of all of them. Where some stand outside, the
/// search is done once more without them; what this makes of them, or a simulator that fits all of them after all,
/// takes them back in. `ready` makes a fit problem of recordings.
Agreement agreeOn(const std::vector<Recording>& recordings, const FitProblem& problem, const SearchResult& found,
                  const SearchOptions& options, const std::function<FitProblem(const std::vector<Recording>&)>& ready);

/// "1 of 10 trials was set aside, as it disagrees with the others: pendulum_3.csv (its …). "; "" for none.
std::string textOf(const std::vector<GapReport::Disagreement>& told, std::size_t trials);

}  // namespace btr
