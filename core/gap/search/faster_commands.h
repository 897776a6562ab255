#pragma once
#include <string>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/search/explanation.h"
#include "core/gap/search/search.h"

namespace btr {

/// Explains recordings, and finds out what their commands do between rows (between_rows.h) where the file leaves it
/// open: commands that hold in the simulator and in truth went on are up to half a row late, which looks like a rate
/// that is fed forward. By how much of a row they are ahead is one number for all such trials. It is asked with the
/// numbers of the scene alone before anything is looked for, and again with what was found; another one is taken where
/// it predicts better. The recordings of the problem that were asked are marked with what was taken. `note`: what was
/// found out, left as it is where commands hold.
Explanation explainWithCommands(GapProblem& problem, const MadeReady& ready, const SearchOptions& search,
                                bool learnRest, std::string& note);

}  // namespace btr
