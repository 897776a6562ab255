#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/model/load_model.h"

namespace btr {

/// The part of a mesh file that has one colour.
struct MeshPart {
  std::vector<Eigen::Vector3f> vertices;      ///< in the file's frame, scaled [m]
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside, also where the scale mirrors
  std::optional<std::array<float, 4>> colour;
};

/// Reads an STL (text or binary), OBJ or DAE file with assimp. A DAE file's unit applies; its up axis does not, as in
/// all of ROS; no further files (an OBJ file's materials) are opened. Parts without area are left out. Throws
/// InputError naming the file if it cannot be read, holds no surface, or more than `mostTriangles`.
std::vector<MeshPart> readMesh(const MeshFile& file, const Eigen::Vector3d& scale, std::size_t mostTriangles);

}  // namespace btr
