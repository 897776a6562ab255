#include "core/gap/replay/followed_torques.h"

#include <algorithm>
#include <cmath>

#include "core/gap/recordings/lowpass.h"

namespace btr {

bool isFollowedTorque(const Binding& binding, const Binding::Measured& measured) {
  return measured.what == Binding::Measured::What::torque &&
         binding.input(Binding::Input::What::motion, measured.object, measured.part);
}

std::vector<std::size_t> followedTorques(const Binding& binding) {
  std::vector<std::size_t> torques;
  for (std::size_t i = 0; i < binding.measured.size(); ++i)
    if (isFollowedTorque(binding, binding.measured[i])) torques.push_back(i);
  return torques;
}

double comparedBelow_hz(const Recording& recording) {
  const double below_hz = recording.filterCutoff_hz / 2;
  return below_hz > 0 && 2 * below_hz < 1 / recording.samplePeriod() ? below_hz : 0;
}

void filterAsCompared(const Recording& recording, std::vector<double>& values) {
  constexpr int order = 4;
  const double below_hz = comparedBelow_hz(recording);
  if (!(below_hz > 0) || !std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) return;
  values = LowPass(order, below_hz, 1 / recording.samplePeriod()).zeroPhase(values);
}

void filterFollowedTorques(Recording& recording, const Binding& binding) {
  if (!(comparedBelow_hz(recording) > 0)) return;
  for (const std::size_t i : followedTorques(binding)) {
    const std::size_t column = binding.measured[i].column;
    filterAsCompared(recording, recording.columns[column]);
    // Half the band, half the noise's square.
    if (column < recording.filteredNoise.size()) recording.filteredNoise[column] *= std::sqrt(0.5);
  }
}

}  // namespace btr
