#pragma once
#include "core/model/robot_model.h"
#include "core/spec/scene_spec.h"

namespace btr {

/// An obstacle's solid, for contacts and for drawing: in its frame, whose origin is its middle. A ramp is a mesh with
/// its hull.
Shape obstacleShape(const ObstacleSpec& obstacle);

/// Middle of mass in its frame and, about it, the inertia of a uniform solid, in kg·m² for `mass_kg`. A ramp's frame is
/// not along its principal axes.
Inertial obstacleInertial(const ObstacleSpec& obstacle);

}  // namespace btr
