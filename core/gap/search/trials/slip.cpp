#include "core/gap/search/trials/slip.h"

#include <algorithm>
#include <cmath>

#include "core/gap/fit/fit.h"
#include "core/gap/fit/linearise.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/search/trials/disagreement.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

/// When, in which channel and how a trial's measuring may have gone wrong.
struct Kind {
  std::size_t channel = 0, row = 0;
  bool drifts = false;
  bool operator==(const Kind&) const = default;
};

/// How far along the wrong measuring is in a row: 0 before, at the end 1.
double shareAt(const Kind& kind, const std::vector<double>& time, std::size_t row) {
  if (row < kind.row) return 0;
  return kind.drifts ? (time[row] - time[kind.row]) / (time.back() - time[kind.row]) : 1;
}

/// A trial as it would have been recorded without a slip of this kind and size.
Recording without(const Recording& recording, std::size_t column, const Kind& kind, double by) {
  Recording moved = recording;
  for (std::size_t row = kind.row; row < moved.rows(); ++row)
    moved.columns[column][row] -= by * shareAt(kind, recording.columns[0], row);
  return moved;
}

/// What one more unit of a slip taken away changes in the residuals, what the initial states follow taken out.
Eigen::VectorXd columnOf(const FitProblem& problem, const Linearised& linear, const Kind& kind) {
  const FitTrial& trial = problem.trials[0];
  Eigen::VectorXd column = Eigen::VectorXd::Zero(linear.residuals.size());
  Eigen::Index at = 0;
  for (const Segment& segment : problem.segments)
    for (std::size_t k = 0; k < segment.row.size(); ++k, ++at)
      if (segment.channel[k] == kind.channel)
        column[at] =
            shareAt(kind, trial.recording.columns[0], segment.row[k]) / trial.floorAt(kind.channel, segment.row[k]);
  return linear.profile(problem, column);
}

struct Best {
  Kind kind;
  double by = 0, gain = 0;
};

/// The kind and size of slip that lowers the squares of `residuals` most, to first order.
Best bestSlip(const FitProblem& problem, const Linearised& linear, const Eigen::VectorXd& residuals) {
  constexpr double tells = 1e-6;  // a column that the initial states follow altogether
  Best best;
  const FitTrial& trial = problem.trials[0];
  for (std::size_t c = 0; c < trial.binding.measured.size(); ++c) {
    if (trial.noiseFloor[c] <= 0 || !isPlace(trial.binding.measured[c].what)) continue;
    for (std::size_t row = 1; row + 1 < trial.recording.rows(); ++row)
      for (const bool drifts : {false, true}) {
        const Kind kind{c, row, drifts};
        const Eigen::VectorXd column = columnOf(problem, linear, kind);
        const double square = column.squaredNorm(), along = column.dot(residuals);
        if (square < tells || along * along / square <= best.gain) continue;
        best = {kind, -along / square, along * along / square};
      }
  }
  return best;
}

}  // namespace

bool isPlace(Binding::Measured::What what) {
  using What = Binding::Measured::What;
  return what == What::position || what == What::ballPosition || what == What::basePosition;
}

std::optional<Slip> findSlip(const Recording& recording, const FitModel& model, int iterations,
                             const std::function<FitProblem(const std::vector<Recording>&)>& ready) {
  constexpr int rounds = 6;
  constexpr double settled = 0.01;
  Best slip;
  std::size_t column = 0;  // of the recording, in which it slipped
  Recording moved = recording;
  double error = INFINITY, before = 0;
  for (int round = 0; round < rounds; ++round) {
    const FitProblem problem = ready({moved});
    const Fit fit = fitModel(problem, model, {}, {.iterations = iterations, .startsOnly = true});
    const Linearised linear = linearise(problem, fit);
    error = linear.residuals.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, linear.residuals.size()));
    if (round == 0) before = error;
    // The residuals that the slip so far would leave if it were still there.
    Eigen::VectorXd residuals = linear.profiled;
    if (round > 0) residuals -= slip.by * columnOf(problem, linear, slip.kind);
    const Best next = bestSlip(problem, linear, residuals);
    if (next.gain == 0) break;
    const bool same = next.kind == slip.kind && std::abs(next.by - slip.by) <= settled * std::abs(next.by);
    if (round > 0 && same) break;
    slip = next;
    column = problem.trials[0].binding.measured[slip.kind.channel].column;
    moved = without(recording, column, slip.kind, slip.by);
    if (round + 1 == rounds) error = errorsByTrial(ready({moved}), model, iterations)[0];
  }
  if (slip.gain == 0 || !(error < before)) return std::nullopt;
  return Slip{recording.channels[column], slip.kind.drifts, recording.columns[0][slip.kind.row], slip.by, error};
}

std::string inWords(const Slip& slip) {
  const std::string size = digits(std::abs(slip.by)) + " " + unitOfChannel(slip.channel);
  const std::string way = slip.by < 0 ? "down" : "up";
  return slip.drifts ? "its " + slip.channel + " drifts " + way + " by " + size + " from " + digits(slip.from_s) +
                           " s on, as a marker that comes loose does"
                     : "its " + slip.channel + " jumps " + way + " by " + size + " at " + digits(slip.from_s) +
                           " s, as a marker that slips does";
}

}  // namespace btr
