#include "core/gap/search/slip.h"

#include <algorithm>
#include <cmath>

#include "core/gap/fit/segments.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/search/disagreement.h"
#include "core/spec/figures.h"

namespace btr {
namespace {

/// One channel of one trial, with a slip taken out of it.
class SlippedChannel {
 public:
  SlippedChannel(const Recording& recording, std::size_t column, double size, const FitModel& model, int iterations,
                 const std::function<FitProblem(const std::vector<Recording>&)>& ready)
      : recording_(recording), column_(column), size_(size), model_(model), iterations_(iterations), ready_(ready) {}

  struct Try {
    double by = 0, error = INFINITY;
  };
  double error(bool drifts, std::size_t row, double by) const {
    Recording moved = recording_;
    const std::vector<double>& time = recording_.columns[0];
    for (std::size_t i = row; i < moved.rows(); ++i)
      moved.columns[column_][i] -= by * (drifts ? (time[i] - time[row]) / (time.back() - time[row]) : 1);
    return errorsByTrial(ready_({std::move(moved)}), model_, iterations_)[0];
  }
  /// The lowest point of the parabola through three sizes.
  Try best(bool drifts, std::size_t row, double without) const {
    const double up = error(drifts, row, size_), down = error(drifts, row, -size_);
    const double bend = up + down - 2 * without;
    if (!(bend > 0)) return {};
    return {size_ * (down - up) / (2 * bend), without - (down - up) * (down - up) / (8 * bend)};
  }

 private:
  const Recording& recording_;
  std::size_t column_;
  double size_;
  const FitModel& model_;
  int iterations_;
  const std::function<FitProblem(const std::vector<Recording>&)>& ready_;
};

}  // namespace

std::optional<Slip> findSlip(const Recording& recording, const FitTrial& trial, const FitModel& model, int iterations,
                             const std::function<FitProblem(const std::vector<Recording>&)>& ready) {
  constexpr std::size_t moments = 7;
  constexpr double triedFloors = 20;
  const std::size_t rows = recording.rows();
  if (rows < 2 * moments) return std::nullopt;
  const double without = errorsByTrial(ready({recording}), model, iterations)[0];
  std::optional<Slip> found;
  for (std::size_t c = 0; c < trial.binding.measured.size(); ++c) {
    using What = Binding::Measured::What;
    const Binding::Measured& measured = trial.binding.measured[c];
    if (trial.noiseFloor[c] <= 0) continue;
    if (measured.what != What::position && measured.what != What::ballPosition && measured.what != What::basePosition)
      continue;
    const SlippedChannel channel(recording, measured.column, triedFloors * trial.noiseFloor[c], model, iterations,
                                 ready);
    for (const bool drifts : {false, true}) {
      std::size_t row = 0;
      SlippedChannel::Try best;
      const auto attempt = [&](std::size_t at) {
        const SlippedChannel::Try tried = channel.best(drifts, at, without);
        if (tried.error >= best.error) return;
        best = tried;
        row = at;
      };
      for (std::size_t k = 1; k < moments; ++k) attempt(k * rows / moments);
      if (!(best.error < without)) continue;
      for (std::size_t step = rows / moments / 2; step > 0; step /= 2) {
        const std::size_t middle = row;
        if (middle > step) attempt(middle - step);
        if (middle + step + 1 < rows) attempt(middle + step);
      }
      const double error = channel.error(drifts, row, best.by);
      if (error < without && (!found || error < found->error))
        found = Slip{recording.channels[measured.column], drifts, recording.columns[0][row], best.by, error};
    }
  }
  return found;
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
