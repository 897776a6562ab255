#include "core/gap/search/explanation.h"

#include <algorithm>
#include <utility>

#include "core/gap/fit/interruptible.h"
#include "core/gap/search/step_guard.h"
#include "core/spec/parameter.h"
#include "core/spec/system/cancelled.h"

namespace btr {
namespace {

constexpr double window_s = 1;

/// From a search that was made to what it leaves.
Explanation completed(const std::vector<Recording>& recordings, const MadeReady& ready, FitProblem problem,
                      SearchResult found, const SearchOptions& search, bool learnRest) {
  const double window = problem.window_s;
  Explanation made{std::move(problem), std::move(found), {}, {}};
  const auto agree = [&] {
    made.agreement = agreeOn(recordings, made.problem, made.found, search,
                             [&](const std::vector<Recording>& some) { return ready(some, window); });
  };
  const bool isCut = !unlessEnough(agree) || made.found.cutShort;
  if (made.agreement.without) {
    made.problem = made.agreement.without->problem;
    made.found = made.agreement.without->found;
  }
  made.found.cutShort = made.found.cutShort || isCut;
  if (made.found.step_s < made.problem.scene.step_s) {
    made.problem.scene.step_s = made.found.step_s;
    if (made.found.step_s < made.problem.givenStep_s)
      made.problem.notes.push_back(
          (made.found.effects.empty() ? "what was recorded needs a step of " : "what was found needs a step of ") +
          toText(made.found.step_s) + " s: set step_s so where this simulator is used");
  }
  if (!learnRest || made.found.cutShort) return made;
  if (search.progress && !search.progress("measuring what has no name", 0.93)) throw Cancelled{};
  // Beside much that is left a coarse step does, but a curve may take all of it: it is no curve of what the step errs.
  {
    StepGuard ofLaw(made.problem.scene.step_s);
    if (stepErrorOf(made.found.stepChange) > search.thresholds.law.leastExcess)
      ofLaw.set(std::min(ofLaw.before_s(), made.problem.givenStep_s));
    const SearchResult named = made.found;
    if (unlessEnough([&] { made.law = learnBesideNames(made.problem, made.found, search); })) {
      if (made.law.law) ofLaw.keep();
    } else {
      made.found = named;
      made.found.cutShort = true;
    }
  }
  return made;
}

/// No name, no curve, and far more than noise is left.
bool explainsNothing(const Explanation& made, const SearchThresholds& limits) {
  return made.found.effects.empty() && !made.law.law && made.found.final.mean() > limits.verdict.muchLeft;
}

Explanation inWindows(const std::vector<Recording>& recordings, const MadeReady& ready, const SearchOptions& search,
                      bool learnRest, const std::string& why) {
  SearchOptions again = search;
  if (search.progress)
    again.progress = [&](const std::string& stage, double share) {
      return search.progress(stage + " in windows", share);
    };
  FitProblem problem = ready(recordings, window_s);
  problem.notes.push_back(why + ": windows of " + toText(window_s) + " s instead");
  SearchResult found = searchEffects(problem, again);
  return completed(recordings, ready, std::move(problem), std::move(found), again, learnRest);
}

}  // namespace

Explanation explain(const std::vector<Recording>& recordings, const MadeReady& ready, const SearchOptions& search,
                    bool learnRest) {
  FitProblem problem = ready(recordings, -1);
  SearchResult found = searchEffects(problem, search);
  if (found.unstable)
    return inWindows(recordings, ready, search, learnRest, "free runs depend on the last digits of the parameters");
  Explanation made = completed(recordings, ready, std::move(problem), std::move(found), search, learnRest);
  if (made.found.cutShort) return made;
  const bool isWhole =
      !made.problem.scene.robots.empty() && made.problem.window_s == 0 && !made.problem.walks && !made.problem.impacts;
  if (!isWhole || !explainsNothing(made, search.thresholds)) return made;
  Explanation windowed = inWindows(recordings, ready, search, learnRest,
                                   "whole trials are lost whatever the numbers, and tell nothing from anything");
  return explainsNothing(windowed, search.thresholds) ? made : windowed;
}

}  // namespace btr
