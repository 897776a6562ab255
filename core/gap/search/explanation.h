#pragma once
#include <functional>
#include <vector>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/search/laws/law_search.h"
#include "core/gap/search/search.h"
#include "core/gap/search/trials/agreement.h"

namespace btr {

/// What explains recordings: names, and a curve where they leave something.
struct Explanation {
  FitProblem problem;  ///< of the trials that were not set aside, with the step that was needed
  SearchResult found;
  Agreement agreement;
  LawBesideNames law;
};

/// Recordings that were made ready to be fitted: whole trials (0), windows of so many seconds, or whichever suits (−1).
using MadeReady = std::function<FitProblem(const std::vector<Recording>&, double window_s)>;

/// Looks at whole trials where it can. Where they are lost whatever the numbers (a swing that a hair makes larger, a
/// loop near its limit of stability) they tell nothing from anything: then in windows of 1 s, which begin where the
/// recording is. `learnRest`: a curve is learned for what has no name. Throws Cancelled where the search's progress
/// says so.
Explanation explain(const std::vector<Recording>& recordings, const MadeReady& ready, const SearchOptions& search,
                    bool learnRest);

}  // namespace btr
