#pragma once
#include <string>

#include "core/sim/scene.h"

namespace btr::rival {

/// How MuJoCo solves contacts and joints.
struct MjcfOptions {
  std::string integrator = "Euler";
  bool ellipticCones = false;
  double impratio = 1;
  /// Joints get a row of dry friction, as stiff as the scene's step allows: else a joint at rest creeps.
  bool dryFriction = false;
};

/// The scene's first robot, its balls and its floor as MuJoCo's own model text: the same bodies, joints, rotor inertia,
/// colliding primitives, masses and frictions (the floor's under everything, a shell's between legs and balls); no
/// self-collision, no slip, no restitution. A free body is the joint "base", balls have the geoms "ball0", "ball1" ….
std::string mjcf(const Scene& scene, const MjcfOptions& options = {});

}  // namespace btr::rival
