#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <string>

#include "core/spec/error.h"
#include "core/spec/scene_spec.h"

/// Which object a name means, and numbers of acts as vectors: for the parts of Session.
namespace btr::objects {

inline Eigen::Vector3d vectorOf(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

inline Eigen::Isometry3d poseOf(const std::array<double, 3>& p, const std::array<double, 4>& q) {
  return Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
}

/// specs.size() if there is none.
template <class Specs>
std::size_t indexOf(const Specs& specs, const std::string& name) {
  const auto found = std::find_if(specs.begin(), specs.end(), [&](const auto& spec) { return spec.name == name; });
  return static_cast<std::size_t>(found - specs.begin());
}

/// Where a name belongs.
struct Place {
  enum class Kind { robot, ball, obstacle } kind;
  std::size_t index;
};

/// Throws InputError, of `place`, for a name that no object has.
inline Place placeOf(const SceneSpec& scene, const std::string& name, const std::string& place) {
  if (const auto i = indexOf(scene.robots, name); i < scene.robots.size()) return {Place::Kind::robot, i};
  if (const auto i = indexOf(scene.balls, name); i < scene.balls.size()) return {Place::Kind::ball, i};
  if (const auto i = indexOf(scene.obstacles, name); i < scene.obstacles.size()) return {Place::Kind::obstacle, i};
  throw InputError(place, "\"" + name + "\"", "a robot, ball or obstacle of this game");
}

}  // namespace btr::objects
