#include "core/gap/recordings/doctor/joint_series.h"

#include <algorithm>
#include <cmath>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/doctor/even_grid.h"
#include "core/gap/recordings/doctor/following.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/recordings/resample.h"

namespace btr {
namespace {

using Input = Binding::Input;
using Measured = Binding::Measured;

constexpr double settling_s = 0.5;
constexpr std::size_t mostPoints = 20000;

const Input* inputOf(const Binding& binding, const Measured& measured, Input::What what) {
  const auto found = std::find_if(binding.inputs.begin(), binding.inputs.end(), [&](const Input& input) {
    return input.what == what && input.robot == measured.object && input.joint == measured.part;
  });
  return found == binding.inputs.end() ? nullptr : &*found;
}

/// Points of the grid where the drive has been on for `settling_s`.
std::vector<char> settledPoints(std::span<const double> time, std::span<const double> enabled, double start,
                                double period, std::size_t count) {
  std::vector<char> used(count, 1);
  double on = 1, since = -1e9;
  std::size_t row = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = start + static_cast<double>(i) * period;
    for (; row < time.size() && time[row] <= t; ++row) {
      if (!std::isfinite(enabled[row])) continue;
      if (on == 0 && enabled[row] != 0) since = time[row];
      on = enabled[row];
    }
    used[i] = on != 0 && t - since >= settling_s;
  }
  return used;
}

}  // namespace

std::vector<JointSeries> jointSeries(const Scene& scene, const Recording& recording, const Binding& binding,
                                     double& period_s) {
  std::vector<JointSeries> all;
  const std::vector<double>& time = recording.columns.at(0);
  if (time.size() < 50) return all;
  const double length = time.back() - time.front();
  period_s = std::max(rhythm(recording), length / static_cast<double>(mostPoints));
  const auto count = static_cast<std::size_t>(length / period_s) + 1;
  if (count < 50) return all;

  for (const Measured& measured : binding.measured) {
    if (measured.what != Measured::What::position) continue;
    const Drive::Kind kind = scene.robots[measured.object].drives[measured.part].kind;
    const Input* command = inputOf(binding, measured, Input::What::command);
    const std::vector<double>& positions = recording.columns[measured.column];
    if (std::none_of(positions.begin(), positions.end(), [](double value) { return std::isfinite(value); })) continue;
    if (!command || (kind != Drive::Kind::servo && kind != Drive::Kind::dcMotor)) continue;
    JointSeries series;
    series.robot = measured.object;
    series.joint = measured.part;
    series.commandChannel = recording.channels[command->column];
    series.positionChannel = recording.channels[measured.column];
    const auto grid = [&](std::size_t column) {
      return onGrid(time, recording.columns[column], time.front(), period_s, count);
    };
    series.command = grid(command->column);
    series.position = grid(measured.column);
    const Input* enabled = inputOf(binding, measured, Input::What::enabled);
    series.used = enabled ? settledPoints(time, recording.columns[enabled->column], time.front(), period_s, count)
                          : std::vector<char>(count, 1);
    const auto [lowest, highest] = std::minmax_element(series.position.begin(), series.position.end());
    series.lowest = *lowest;
    series.highest = *highest;
    series.commandSpread = spread(series.command, series.used);
    series.positionSpread = spread(series.position, series.used);
    all.push_back(std::move(series));
  }
  return all;
}

}  // namespace btr
