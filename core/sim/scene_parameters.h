#pragma once
#include <string>
#include <vector>

#include "core/sim/scene.h"
#include "core/spec/parameter.h"

namespace btr {

/// A link of this mass group belongs to "leg" if its own is "leg" or "leg:…".
bool isOfGroup(const std::string& massGroup, const std::string& group);

/// The joint whose servo the simulator's servo parameters describe, the first of a leg; −1: the robot has none.
int referenceJoint(const RobotModel& model);

/// Those of simulatorParameters() that mean something in a scene: masses of groups that a robot has, servos of robots
/// with legs, the floor's where there is one, and gravity.
std::vector<Parameter> simulatorParametersOf(const SceneSpec& scene, const ModelSet& models);

/// Why a parameter means nothing there: "only for robots whose model has a body".
std::string whoHas(const std::string& parameter);

}  // namespace btr
