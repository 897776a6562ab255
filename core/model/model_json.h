#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/model/robot_model.h"

namespace btr {

/// A model for another process, every number as it is: links with their masses and shapes, joints, sensors. Meshes,
/// colours and what only a simulator uses (servos, warnings) stay behind.
nlohmann::json toJson(const RobotModel& model);
/// Throws InputError, beginning with `place`, for what no toJson() wrote.
RobotModel modelFromJson(const std::string& text, const std::string& place);

}  // namespace btr
