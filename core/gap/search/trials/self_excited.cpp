#include "core/gap/search/trials/self_excited.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <span>
#include <unsupported/Eigen/FFT>

#include "core/gap/fit/fit_problem.h"
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/channel_name.h"
#include "core/gap/recordings/doctor/even_grid.h"
#include "core/gap/replay/residual.h"
#include "core/gap/search/gap_report.h"
#include "core/gap/search/thresholds.h"

namespace btr {
namespace {

/// Power by frequency: bin k is k/(count·period), and all bins but the first add up to the variance about the line.
std::vector<double> spectrum(std::vector<double> values) {
  const std::size_t n = values.size();
  const double middle = static_cast<double>(n - 1) / 2;
  double mean = 0, slope = 0, spread = 0;
  for (const double value : values) mean += value / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    slope += (static_cast<double>(i) - middle) * (values[i] - mean);
    spread += std::pow(static_cast<double>(i) - middle, 2);
  }
  slope /= spread;
  double weights = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double hann =
        0.5 - 0.5 * std::cos(2 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
    values[i] = hann * (values[i] - mean - slope * (static_cast<double>(i) - middle));
    weights += hann * hann;
  }
  std::vector<std::complex<double>> transformed;
  Eigen::FFT<double>().fwd(transformed, values);
  std::vector<double> power(n / 2 + 1, 0);
  // Both halves of the spectrum, brought back to what the window lets through of the squares.
  for (std::size_t k = 1; k < power.size(); ++k)
    power[k] = 2 * std::norm(transformed[k]) / static_cast<double>(n) / weights;
  return power;
}

double within(std::span<const double> power, std::size_t peak, double bandwidth) {
  // Hann's window spreads a line over its neighbours.
  const auto half = std::max<std::size_t>(1, static_cast<std::size_t>(bandwidth * static_cast<double>(peak)));
  double sum = 0;
  for (std::size_t k = peak - half; k <= std::min(peak + half, power.size() - 1); ++k) sum += power[k];
  return sum;
}

struct Peak {
  double frequency_hz = 0, power = 0;
};

/// Of an even grid's samples.
std::optional<Peak> ownPeak(const std::vector<double>& recorded, const std::vector<double>& simulated,
                            const std::vector<double>& command, double period_s, double noiseFloor,
                            const SearchThresholds::SelfExcitation& limits) {
  std::vector<double> error(recorded);
  for (std::size_t i = 0; i < error.size(); ++i) error[i] -= simulated[i];
  const std::vector<double> mine = spectrum(recorded), its = spectrum(simulated), asked = spectrum(command),
                            wrong = spectrum(error);
  const auto first = static_cast<std::ptrdiff_t>(limits.leastPeriods);
  const auto peak = static_cast<std::size_t>(std::max_element(wrong.begin() + first, wrong.end()) - wrong.begin());
  const auto near = [&](const std::vector<double>& spectrum) { return within(spectrum, peak, limits.bandwidth); };
  const double power = near(mine);
  double allWrong = 0;
  for (const double each : wrong) allWrong += each;
  if (noiseFloor <= 0 || power < std::pow(limits.leastFloors * noiseFloor, 2) ||
      power < limits.timesAnother * near(its) || power < limits.timesAnother * near(asked) ||
      near(wrong) < limits.shareOfError * allWrong)
    return std::nullopt;
  return Peak{static_cast<double>(peak) / (static_cast<double>(recorded.size()) * period_s), power};
}

/// Column of the position that a joint's servo is commanded to; 0 where it has no command.
std::size_t commandOf(const FitTrial& trial, const Binding::Measured& measured) {
  if (measured.what != Binding::Measured::What::position) return 0;
  const auto unit = [&](std::size_t column) { return unitOfChannel(trial.recording.channels[column]); };
  for (const Binding::Input& input : trial.binding.inputs)
    if (input.what == Binding::Input::What::command && input.robot == measured.object && input.joint == measured.part &&
        unit(input.column) == unit(measured.column))
      return input.column;
  return 0;
}

}  // namespace

std::optional<SelfExcitedSwing> selfExcitedSwing(const FitProblem& problem, const std::vector<GapReport::Trial>& trials,
                                                 const SearchThresholds::SelfExcitation& thresholds) {
  std::optional<SelfExcitedSwing> found;
  double strongest = 0;
  for (std::size_t t = 0; t < std::min(trials.size(), problem.trials.size()); ++t) {
    const FitTrial& trial = problem.trials[t];
    const std::vector<double>& time = trial.recording.columns[0];
    const double period = trial.recording.samplePeriod();
    if (time.size() < 3 * thresholds.leastSamples || !(period > 0)) continue;
    const auto count = static_cast<std::size_t>((time.back() - time.front()) / 3 / period);
    if (count < thresholds.leastSamples) continue;
    for (const Binding::Measured& measured : trial.binding.measured) {
      const std::size_t command = commandOf(trial, measured);
      const auto series =
          std::ranges::find(trials[t].series, trial.recording.channels[measured.column], &GapReport::Series::channel);
      if (command == 0 || series == trials[t].series.end()) continue;
      for (int third = 0; third < 3; ++third) {
        const double start = time.front() + third * static_cast<double>(count) * period;
        const auto grid = [&](const std::vector<double>& values) { return onGrid(time, values, start, period, count); };
        const auto peak = ownPeak(grid(series->recorded), grid(series->withEffects),
                                  grid(trial.recording.columns[command]), period, series->noiseFloor, thresholds);
        const double floors = peak ? std::sqrt(peak->power) / series->noiseFloor : 0;
        if (floors <= strongest) continue;
        strongest = floors;
        found = {series->channel,
                 trials[t].name,
                 start,
                 start + static_cast<double>(count) * period,
                 peak->frequency_hz,
                 std::sqrt(2 * peak->power)};
      }
    }
  }
  return found;
}

}  // namespace btr
