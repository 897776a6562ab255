#pragma once
#include "core/gap/recordings/binding.h"
#include "core/gap/recordings/recording.h"

namespace btr {

/// Leaves out how someone lifts, holds and lets go of what nothing drives, and how it is caught at the end. Three
/// cases:
/// - the only joint of a fixed robot, without a drive, that swings: where its acceleration is not what angle and rate
///   make of it in the rest of the recording (a·cos q + b·sin q, damping by rate, by its square and dry);
/// - fixed robots without any drive, of one joint or of a chain: where all joints rest at first and then set out by
///   themselves;
/// - a ball, in a scene without robots, that stays in the air where it is before it falls.
/// A note of the trial says until when. A trial that says itself where it begins (Mapping::from_s, until_s) stays.
void leaveOutHands(Recording& trial, const Scene& scene, const Binding& binding);

}  // namespace btr
