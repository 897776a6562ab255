#pragma once
#include <string>

#include "core/sim/scene.h"

namespace btr {

/// The unit of an effect's number at a place. Effects of joints declare that of a turning joint and, as the last words
/// of its meaning, that of a slide joint: "dry friction, N on a slide joint".
std::string unitAt(const SceneSpec& scene, const ModelSet& models, const std::string& at, const Parameter& parameter);

}  // namespace btr
