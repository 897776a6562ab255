#pragma once
#include <string>
#include <vector>

#include "core/sim/scene.h"
#include "core/spec/parameter.h"

namespace btr {

/// Those of simulatorParameters() that mean something in a scene: masses of groups that a robot has, servos of robots
/// with legs, the floor's where there is one, and gravity.
std::vector<Parameter> simulatorParametersOf(const Scene& scene);

/// Why a parameter means nothing there: "only for robots whose model has a body".
std::string whoHas(const std::string& parameter);

}  // namespace btr
