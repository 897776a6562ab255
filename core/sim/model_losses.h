#pragma once
#include <string>
#include <vector>

#include "core/sim/scene.h"

namespace btr {

/// What the robots of a scene lack of what their files say, or have that was assumed, where it can change their motion:
/// "hopper (hopper.urdf, line 11): link leg: the geometry <cone> is not known; it collides with nothing". What the
/// scene makes good (a servo's own torque limit) or does not ask for (collisions) is left out.
std::vector<std::string> modelLosses(const SceneSpec& spec, const ModelSet& models);

/// What of the models cannot be shown as their files say, a sentence a model: "burger.urdf: 5 visual shapes cannot be
/// read: 4 drawn by their collision shapes, 1 not drawn".
std::vector<std::string> drawingLosses(const SceneSpec& spec, const ModelSet& models);

}  // namespace btr
