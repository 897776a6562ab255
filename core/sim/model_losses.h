#pragma once
#include <string>
#include <vector>

#include "core/sim/scene.h"

namespace btr {

/// What the robots of a scene lack of what their files say, or have that was assumed, where it can change their motion:
/// "hopper (hopper.urdf, line 11): link leg: the geometry <cone> is not known; it collides with nothing". What the
/// scene makes good (a servo's own torque limit) or does not ask for (collisions) is left out.
std::vector<std::string> modelLosses(const SceneSpec& spec, const ModelSet& models);

}  // namespace btr
