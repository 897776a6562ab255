#include "core/gap/horizon.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>

#include "core/gap/report_figures.h"

namespace btr {
namespace {

constexpr double bin_s = 0.1, least_s = 0.8;  // a walking dog's step takes about half a second
constexpr double apart = 1.5;                 // noise floors, of all channels together
constexpr double share = 0.5;                 // of the start's standard errors: a fit of the start knows it better
constexpr unsigned patterns = 4;              // of signs, all different

/// The start moved by a share of what is not known of it, each coordinate to the side that the pattern says.
std::vector<double> moved(const Segment& segment, unsigned pattern) {
  std::vector<double> shift;
  for (const Nuisance& nuisance : segment.nuisances) {
    // What rests is asked where it is, not how much it might move.
    const bool rests =
        nuisance.what == Nuisance::What::jointRate && segment.start.robots[nuisance.object].rates[nuisance.part] == 0;
    const bool down = std::popcount(static_cast<unsigned>(shift.size()) & pattern) % 2 == 1;
    shift.push_back(rests ? 0 : down ? -share : share);
  }
  return shift;
}

/// The time from which two runs are apart [s after the start]; infinite if they never are.
double partedAt(const FitProblem& problem, const Segment& segment, const std::vector<double>& one,
                const std::vector<double>& other) {
  const std::vector<double>& time = problem.trials[segment.trial].recording.columns[0];
  std::vector<double> squares, counts;
  for (std::size_t k = 0; k < one.size(); ++k) {
    const auto bin = static_cast<std::size_t>((time[segment.row[k]] - time[segment.first]) / bin_s);
    if (squares.size() <= bin) {
      squares.resize(bin + 1, 0);
      counts.resize(bin + 1, 0);
    }
    squares[bin] += (one[k] - other[k]) * (one[k] - other[k]);
    ++counts[bin];
  }
  for (std::size_t bin = 0; bin < squares.size(); ++bin)
    if (counts[bin] > 0 && squares[bin] > apart * apart * counts[bin]) return static_cast<double>(bin) * bin_s;
  return INFINITY;
}

double horizonOf(const FitProblem& problem, const Segment& segment) {
  const Scene scene = problem.sceneOf(problem.given, segment.trial);
  const std::vector<double> none(segment.nuisances.size(), 0.0);
  const std::vector<double> plain = residualsOf(problem, segment, scene, none);
  FitProblem finer = problem;
  finer.scene.step_s /= 2;
  double horizon = partedAt(problem, segment, plain,
                            residualsOf(finer, segment, finer.sceneOf(finer.given, segment.trial), none));
  for (unsigned pattern = 0; pattern < patterns; ++pattern)
    horizon = std::min(horizon, partedAt(problem, segment, plain,
                                         residualsOf(problem, segment, scene, moved(segment, pattern))));
  return std::max(horizon, least_s);
}

}  // namespace

void keepPredictable(FitProblem& problem) {
  for (const Segment& segment : problem.segments) {
    FitTrial& trial = problem.trials[segment.trial];
    const std::vector<double>& time = trial.recording.columns[0];
    const double horizon = horizonOf(problem, segment);
    std::size_t rows = trial.recording.rows();
    while (rows > segment.first + 8 && time[rows - 1] > time[segment.first] + horizon) --rows;
    if (rows == trial.recording.rows()) continue;
    trial.compared = rows;
    problem.notes.push_back(std::filesystem::path(trial.recording.source).filename().string() +
                            ": compared over its first " + digits(horizon, 2) +
                            " s: beyond, runs of one and the same simulator part ways, too, where they begin within "
                            "what is known of the start or have half the step");
  }
}

}  // namespace btr
