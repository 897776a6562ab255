#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "core/sim/contact/collision.h"

namespace btr {

/// How far along a ray the collider begins; 0 for a ray that begins within it, nothing where the ray passes it by.
/// `solid` is the collider's pose in the world (its body's pose times its own), `direction` a unit vector.
std::optional<double> rayDistance(const Collider& collider, const Eigen::Isometry3d& solid,
                                  const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);

}  // namespace btr
