#pragma once
#include "core/gap/recordings/binding.h"
#include "core/gap/replay/start_state.h"
#include "core/sim/scene.h"

namespace btr {

/// By robot and joint of its model: is anything recorded of it, a command or where it is?
std::vector<std::vector<bool>> recordedJoints(const Scene& scene, const Binding& binding);

/// Servos that nobody recorded are told what the scene says (see replay.h), and before a recording began they have long
/// come to rest there under the weight that they carry: q = q_scene + τ/p, τ the torque of gravity on all links beyond
/// the joint, at most what the servo gives. What those links touch is not known and counts for nothing.
void letUnrecordedServosHang(const Scene& scene, const Binding& binding, StartState& state);

}  // namespace btr
