#pragma once
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/start_state.h"
#include "core/sim/scene.h"
#include "core/spec/system/cancelled.h"

namespace btr {

/// Simulated values at the recorded times.
struct ReplayedRecording {
  std::vector<std::vector<double>> values;  ///< by Binding::measured, one a row; NaN after a fault
  std::string fault;                        ///< empty, or why and when the simulation was ended
};

/// Builds a World and drives it with the recorded inputs: each is held from its sample to the next (an empty cell holds
/// the last one; where inputs go on between rows, at what inputFrom() says), changes happen exactly at the recorded
/// times, the state is read at the recorded times. Steps are the scene's step_s or, between samples, equal and slightly
/// smaller. Rows `first` … `last` − 1; a pure function of its arguments. Joints whose motion is prescribed start where
/// the recording has them, with the central difference as their rate; one step then covers the time between two
/// samples, so that the torque of a row is that of the path's second difference there. (In the last row there is none:
/// that of the row before.) Of a recording that went through a low-pass filter, the torques of a replay of all rows do,
/// too (followed_torques.h). `goesOn` is asked now and then; when it says no, this throws Cancelled.
ReplayedRecording replayRecording(const Scene& scene, const Recording& recording, const Binding& binding,
                                  const StartState& start, std::size_t first = 0,
                                  std::size_t last = std::numeric_limits<std::size_t>::max(),
                                  const std::function<bool()>& goesOn = {});

}  // namespace btr
