#pragma once
#include "core/spec/scene_spec.h"

namespace btr {

class Session;

/// The scene as a session's world has it at this moment: robots where they stand and with their joints' angles, balls
/// and obstacles with their velocities, objects that came, without those that went. Robots begin at rest in it, as a
/// scene has no velocities of theirs; who moves them, and numbers and effects that were changed, are the game's, not
/// the scene's. Relative paths of models are those of the session's scene.
SceneSpec momentOf(const Session& session);

}  // namespace btr
