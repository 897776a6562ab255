#pragma once
#include <cstddef>
#include <vector>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"

namespace btr {

/// The torque that a joint takes which follows its recorded motion.
bool isFollowedTorque(const Binding& binding, const Binding::Measured& measured);
/// All of them, by Binding::measured.
std::vector<std::size_t> followedTorques(const Binding& binding);

/// Below which frequency these torques are compared [Hz], where the recording went through a low-pass filter: half its
/// cutoff, as friction that turns with the filtered motion is a step that the filtered torque is not. 0: as they are.
double comparedBelow_hz(const Recording& recording);

/// Filters a column of a whole trial to that frequency, forward and backward; one with a gap stays as it is.
void filterAsCompared(const Recording& recording, std::vector<double>& values);

/// The recorded ones made ready for the comparison; replayRecording() does the same to those of whole trials.
void filterFollowedTorques(Recording& recording, const Binding& binding);

}  // namespace btr
