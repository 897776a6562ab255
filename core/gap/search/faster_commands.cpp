#include "core/gap/search/faster_commands.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/gap/fit/score.h"
#include "core/gap/recordings/between_rows.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/search/calibrator.h"
#include "core/gap/search/fit_service.h"
#include "core/gap/search/model_comparison.h"
#include "core/sim/scene.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

constexpr double onLine = 0.5;  // of a row: the mean of a straight line

using Sources = std::vector<std::string>;

/// Trials of which the file leaves it open; none of what walks or is tossed.
Sources openTrials(const FitProblem& problem) {
  Sources open;
  for (std::size_t t = 0; t < problem.trials.size() && !problem.walks && !problem.impacts; ++t)
    if (const FitTrial& trial = problem.trials[t];
        mayGoOnBetweenRows(problem.sceneOf(problem.given, t), trial.recording, trial.binding))
      open.push_back(trial.recording.source);
  return open;
}

FitProblem marked(FitProblem problem, const Sources& open, double ahead) {
  for (FitTrial& trial : problem.trials)
    if (std::ranges::find(open, trial.recording.source) != open.end()) trial.recording.betweenRows = ahead;
  return problem;
}

struct Asked {
  double ahead = 0;
  Scored scored;
};

/// How far ahead commands would have to be beside a model, which is fitted again to the same trials: a residual is
/// linear in that, so a parabola through three places finds it.
class Asking {
 public:
  Asking(const FitProblem& problem, const Sources& open, const SearchOptions& search)
      : problem_(problem), open_(open), search_(search) {}

  Asked best(const Asked& now) const {
    constexpr double wide = onLine / 2, narrow = 0.05;
    const Asked coarse = around(now, wide, wide);
    if (coarse.ahead == now.ahead) return now;
    return around(coarse, std::clamp(coarse.ahead, narrow, onLine - narrow), narrow);
  }

 private:
  /// The lowest point of the parabola through `middle` and what is `apart` of it to either side; the model begins where
  /// `now` is.
  Asked around(const Asked& now, double middle, double apart) const {
    std::vector<Asked> at;
    for (const double ahead : {middle - apart, middle, middle + apart})
      at.push_back(ahead == now.ahead ? now : fittedAt(ahead, now.scored));
    const double low = at[0].scored.mean(), mid = at[1].scored.mean(), high = at[2].scored.mean();
    Asked best = *std::ranges::min_element(at, {}, [](const Asked& each) { return each.scored.mean(); });
    const double curvature = low - 2 * mid + high;
    if (!(curvature > 0)) return best;
    const double lowest = std::clamp(middle + apart * (low - high) / (2 * curvature), 0.0, onLine);
    if (lowest == best.ahead) return best;
    Asked there = fittedAt(lowest, best.scored);
    return there.scored.mean() < best.scored.mean() ? there : best;
  }

  Asked fittedAt(double ahead, const Scored& from) const {
    constexpr double at = 0.02;  // of the search
    const std::string stage = "asking what commands do between rows";
    FitService service(marked(problem_, open_, ahead), search_);
    const std::vector<Fit> fits =
        service.fitAll({{from.fit.model, from.fit.shifts}}, search_.thresholds.calibration.iterations, stage, at, at);
    return {ahead, service.scoreAll(fits, stage, at, at)[0]};
  }

  const FitProblem& problem_;
  const Sources& open_;
  const SearchOptions& search_;
};

/// Beside physics that is missing any number takes a little: this one counts where it takes most.
bool takesMost(const Scored& held, const Scored& ahead, const SearchThresholds::Confirmation& limits) {
  return excessOf(ahead) <= (1 - limits.mostOfExcess) * excessOf(held) && isMissed(held, ahead, limits);
}

/// With the numbers alone; 0 where that leaves nothing, or free runs say nothing.
Asked aheadByNumbers(const FitProblem& asRead, const Sources& open, const SearchOptions& search) {
  FitService service(asRead, search);
  Calibration calibration = Calibrator(service).calibrate();
  Asked held{0, std::move(calibration.calibrated)};
  if (calibration.unstable || held.scored.mean() <= search.thresholds.screening.nothingLeft) return held;
  const Asked best = Asking(service.problem(), open, search).best(held);
  return takesMost(held.scored, best.scored, search.thresholds.confirmation) ? best : held;
}

}  // namespace

Explanation explainWithCommands(GapProblem& problem, const MadeReady& ready, const SearchOptions& search,
                                bool learnRest, std::string& note) {
  constexpr int rounds = 2;
  const FitProblem asRead = ready(problem.recordings, -1);
  Sources open = openTrials(asRead);
  if (open.empty()) return explain(problem.recordings, ready, search, learnRest);

  // Trials that were held out are recorded like the others.
  const Scene scene = asRead.sceneOf(problem.simulator, 0);
  for (const Recording& trial : problem.heldOut)
    if (mayGoOnBetweenRows(scene, trial, bind(scene, trial))) open.push_back(trial.source);
  const auto mark = [&](double ahead) {
    for (auto* trials : {&problem.recordings, &problem.heldOut})
      for (Recording& trial : *trials)
        if (std::ranges::find(open, trial.source) != open.end()) trial.betweenRows = ahead;
  };

  double ahead = aheadByNumbers(asRead, open, search).ahead;
  mark(ahead);
  Explanation made = explain(problem.recordings, ready, search, learnRest);
  for (int round = 0; round < rounds; ++round) {
    const Scored& found = made.found.final;
    if (made.found.cutShort) break;
    if (made.found.effects.empty() && found.mean() <= search.thresholds.verdict.stillNoise) break;
    const Asked best = Asking(made.problem, open, search).best({ahead, found});
    if (!takesMost(found, best.scored, search.thresholds.confirmation)) break;
    mark(best.ahead);
    Explanation second = explain(problem.recordings, ready, search, learnRest);
    if (second.found.final.mean() >= found.mean()) {
      mark(ahead);
      break;
    }
    ahead = best.ahead;
    made = std::move(second);
  }
  if (ahead > 0)
    note =
        "commands change smoothly from row to row, and nothing says that they hold in between, as they do where the "
        "controller writes the table: they were taken to be " +
        digits(100 * ahead, 2) +
        " % of the way to the next row ahead on average (a straight line between rows is 50 %, as where a "
        "controller is faster than its logger; a command that holds is 0). \"between_rows\": " +
        digits(ahead, 3) + " in the mapping says so to other commands of this program, \"hold\" the contrary";
  return made;
}

}  // namespace btr
