#pragma once
#include <cstddef>
#include <functional>
#include <string>

#include "core/model/robot_model.h"

namespace btr {

/// Limits on what a file may ask of the reader; a file that asks for more is refused with the name of the limit.
struct ModelBudget {
  std::size_t bytes = 64u << 20;
  std::size_t nodes = 200'000;
  std::size_t values = 20'000'000;
  std::size_t depth = 200;
  std::size_t triangles = 2'000'000;  ///< of the whole file
  std::size_t text = 1u << 20;        ///< one string
  std::size_t identifier = 4096;
  std::size_t inlineDepth = 8;
  std::size_t inlineFiles = 64;
};

/// A mesh file that a URDF file names: where it was found, for messages, and its bytes.
struct MeshFile {
  std::string path;
  std::string bytes;
};
/// Gives the mesh file of that name, as it stands in the URDF file; throws InputError if there is none.
using MeshSource = std::function<MeshFile(const std::string& name)>;
/// Mesh files as the URDF file `robot` means them. Relative names and file:// lead from the robot's folder;
/// package://NAME/… and model://NAME/… lead to a folder NAME above or beside the robot's folder, one of
/// ROS_PACKAGE_PATH or AMENT_PREFIX_PATH, or, where the robot was taken out of its package, to the robot's folder or
/// the one above it.
MeshSource meshesBeside(const std::string& robot, const ModelBudget& budget = {});

/// Reads .wrl (VRML97, OpenHRP/Choreonoid vocabulary) or .urdf by the file's ending, then runs checkModel. Inline files
/// are opened only below the file's own folder; meshes as meshesBeside() finds them. Throws InputError
/// "FILE:LINE: …"; what was merely ignored becomes a warning.
RobotModel loadModel(const std::string& path, const ModelBudget& budget = {});

/// The same from memory; `place` begins messages; Inline nodes are refused; without a source, mesh
/// files are not read.
RobotModel parseVrml(const std::string& text, const std::string& place, const ModelBudget& budget = {});
RobotModel parseUrdf(const std::string& text, const std::string& place, const ModelBudget& budget = {},
                     const MeshSource& meshes = {});

/// Semantic checks: mass > 0, inertia symmetric and positive definite, limits in order, unit axes, unique names, one
/// root. Throws InputError at the first violation. Moments that violate the triangle inequality become a warning.
void checkModel(RobotModel& model, const std::string& place);

/// What `btr model check` prints: links, joints, masses, centre of mass, warnings with line numbers.
std::string describeModel(const RobotModel& model);

}  // namespace btr
