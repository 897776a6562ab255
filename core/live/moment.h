#pragma once
#include "core/spec/scene_spec.h"

namespace btr {

class Session;

/// The scene as a session's world has it at this moment: everything where it is and as fast as it is, robots with
/// the angles and velocities of their joints, objects that came, without those that went. Who moves them, and numbers
/// and effects that were changed, are the game's, not the scene's. Relative paths of models are those of the session's
/// scene.
SceneSpec momentOf(const Session& session);

}  // namespace btr
