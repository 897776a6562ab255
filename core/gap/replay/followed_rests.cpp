#include "core/gap/replay/followed_rests.h"

#include <algorithm>
#include <cmath>

#include "core/gap/replay/followed_torques.h"
#include "core/sim/rest.h"

namespace btr {
namespace {

bool slides(const Scene& scene, const Binding::Measured& torque) {
  const SceneRobot& robot = scene.robots[torque.object];
  return robot.model.joints[torque.part].type == Joint::Type::slide;
}

/// By row: whether the joint is slower than that on either side.
std::vector<bool> restsAt(const std::vector<double>& time, const std::vector<double>& path, double below) {
  const auto isSlow = [&](std::size_t from) {
    return std::abs(path[from + 1] - path[from]) < below * (time[from + 1] - time[from]);
  };
  std::vector<bool> rests(path.size());
  for (std::size_t row = 0; row < path.size(); ++row)
    rests[row] = (row == 0 || isSlow(row - 1)) && (row + 1 == path.size() || isSlow(row));
  return rests;
}

/// Rests with what a filter mixes them into: the longer one is, the farther it is seen.
void widen(std::vector<bool>& rests, const std::vector<double>& time, double below_hz) {
  // A step is 5 % of itself away after so many periods of the filter, and so are three times a short rest [arithmetic].
  constexpr double reach = 0.75, timesItself = 3;
  std::vector<bool> wide = rests;
  for (std::size_t row = 0; row < rests.size(); ++row) {
    const std::size_t first = row;
    while (row < rests.size() && rests[row]) ++row;
    if (row == first) continue;
    const double around = std::min(reach / below_hz, timesItself * (time[row - 1] - time[first]));
    const auto from = std::upper_bound(time.begin(), time.end(), time[first] - around) - time.begin();
    const auto until = std::lower_bound(time.begin(), time.end(), time[row - 1] + around) - time.begin();
    if (from < until) std::fill(wide.begin() + from, wide.begin() + until, true);
  }
  rests = std::move(wide);
}

}  // namespace

std::vector<std::size_t> leaveOutRests(Recording& recording, const Binding& binding, const Scene& scene) {
  constexpr double leastMoving = 0.2;  // of a trial's rows, for a joint that turns [hand]
  std::vector<std::size_t> taken;
  const std::vector<double>& time = recording.columns[0];
  if (time.size() < 2) return taken;
  for (const std::size_t i : followedTorques(binding)) {
    const Binding::Measured& torque = binding.measured[i];
    const Binding::Input& motion = *binding.input(Binding::Input::What::motion, torque.object, torque.part);
    std::vector<bool> rests = restsAt(time, recording.columns[motion.column], restsBelow(slides(scene, torque)));
    if (const double below_hz = comparedBelow_hz(recording); below_hz > 0) widen(rests, time, below_hz);
    const auto resting = static_cast<double>(std::ranges::count(rests, true));
    if (resting == 0 || resting > (1 - leastMoving) * static_cast<double>(rests.size())) continue;
    std::vector<double>& values = recording.columns[torque.column];
    for (std::size_t row = 0; row < rests.size(); ++row)
      if (rests[row]) values[row] = NAN;
    taken.push_back(torque.column);
  }
  return taken;
}

}  // namespace btr
