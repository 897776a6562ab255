#include "core/model/mesh_file.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "core/spec/error.h"
#include "core/spec/file_ending.h"
#include "core/spec/json_reader.h"

namespace btr {
namespace fs = std::filesystem;
namespace {

bool isFile(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::vector<fs::path> foldersIn(const char* variable) {
  std::vector<fs::path> folders;
  const char* value = std::getenv(variable);
  const std::string text = value ? value : "";
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(':', at), text.size());
    if (end > at) folders.emplace_back(text.substr(at, end - at));
    at = end + 1;
  }
  return folders;
}

/// Where a file of a ROS package may lie, likeliest first.
std::vector<fs::path> placesOf(const std::string& package, const fs::path& rest, const fs::path& folder) {
  std::vector<fs::path> places;
  for (fs::path above = folder;; above = above.parent_path()) {
    if (above.filename() == package) places.push_back(above / rest);
    places.push_back(above / package / rest);
    if (above == above.parent_path()) break;
  }
  for (const fs::path& root : foldersIn("ROS_PACKAGE_PATH")) {
    if (root.filename() == package) places.push_back(root / rest);
    places.push_back(root / package / rest);
  }
  for (const fs::path& root : foldersIn("AMENT_PREFIX_PATH")) places.push_back(root / "share" / package / rest);
  places.push_back(folder / rest);
  places.push_back(folder.parent_path() / rest);
  return places;
}

using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

Matrix matrixOf(const aiMatrix4x4& m) {
  Matrix result;
  result << m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3, m.c4, m.d1, m.d2, m.d3, m.d4;
  return result;
}

std::optional<std::array<float, 4>> colourOf(const aiScene& scene, const aiMesh& mesh) {
  if (mesh.mMaterialIndex >= scene.mNumMaterials) return std::nullopt;
  const aiMaterial& material = *scene.mMaterials[mesh.mMaterialIndex];
  aiString name;
  // What assimp makes up where the file says nothing.
  if (material.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS && std::string(name.C_Str()) == AI_DEFAULT_MATERIAL_NAME)
    return std::nullopt;
  aiColor4D colour;
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) != aiReturn_SUCCESS) return std::nullopt;
  std::array<float, 4> result{colour.r, colour.g, colour.b, 1};
  for (float& value : result) {
    if (!(value >= 0)) return std::nullopt;
    value = std::min(value, 1.f);
  }
  return result;
}

/// Triangles of one of assimp's meshes at a place.
MeshPart partOf(const aiMesh& mesh, const Matrix& place) {
  MeshPart part;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D& v = mesh.mVertices[i];
    part.vertices.push_back((place * Eigen::Vector4d(v.x, v.y, v.z, 1)).head<3>().cast<float>());
  }
  const bool mirrored = place.topLeftCorner<3, 3>().determinant() < 0;
  for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
    const aiFace& face = mesh.mFaces[i];
    if (face.mNumIndices != 3) continue;
    std::array<int, 3> corners{};
    bool known = true;
    for (unsigned corner = 0; corner < 3; ++corner) {
      known = known && face.mIndices[corner] < mesh.mNumVertices;
      corners[corner] = static_cast<int>(face.mIndices[corner]);
    }
    if (!known) continue;
    const Eigen::Vector3f &a = part.vertices[static_cast<std::size_t>(corners[0])],
                          &b = part.vertices[static_cast<std::size_t>(corners[1])],
                          &c = part.vertices[static_cast<std::size_t>(corners[2])];
    if (!((b - a).cast<double>().cross((c - a).cast<double>()).norm() > 0)) continue;
    if (mirrored) std::swap(corners[1], corners[2]);
    part.triangles.push_back(corners);
  }
  return part;
}

std::vector<MeshPart> partsOf(const aiScene& scene, const Eigen::Vector3d& scale, const std::string& path,
                              std::size_t mostTriangles) {
  Matrix scaling = Matrix::Identity();
  scaling.diagonal().head<3>() = scale;
  std::vector<MeshPart> parts;
  std::size_t triangles = 0;
  std::vector<std::pair<const aiNode*, Matrix>> open{{scene.mRootNode, scaling}};
  while (!open.empty()) {
    const auto [node, above] = open.back();
    open.pop_back();
    const Matrix place = above * matrixOf(node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      const aiMesh& mesh = *scene.mMeshes[node->mMeshes[i]];
      MeshPart part = partOf(mesh, place);
      if (part.triangles.empty()) continue;
      triangles += part.triangles.size();
      if (triangles > mostTriangles)
        throw InputError(path + ": more than " + std::to_string(mostTriangles) + " triangles are not allowed");
      for (const Eigen::Vector3f& vertex : part.vertices)
        if (!vertex.allFinite()) throw InputError(path + ": a corner that is not finite is not allowed");
      part.colour = colourOf(scene, mesh);
      parts.push_back(std::move(part));
    }
    for (unsigned i = node->mNumChildren; i-- > 0;) open.emplace_back(node->mChildren[i], place);
  }
  if (parts.empty()) throw InputError(path + ": it holds no surface");
  return parts;
}

}  // namespace

namespace {

std::string findMeshFile(const std::string& name, const std::string& robot) {
  std::error_code error;
  fs::path self = fs::canonical(robot, error);
  if (error) self = fs::absolute(robot, error);
  const fs::path folder = self.parent_path();
  const std::size_t scheme = name.find("://");
  const std::string kind = scheme == std::string::npos ? "" : name.substr(0, scheme);
  const std::string rest = scheme == std::string::npos ? name : name.substr(scheme + 3);
  std::vector<fs::path> places;
  if (kind == "package" || kind == "model") {
    const std::size_t slash = rest.find('/');
    if (slash == std::string::npos || slash == 0)
      throw InputError("mesh \"" + name + "\": " + kind + "://NAME/FILE is expected");
    places = placesOf(rest.substr(0, slash), fs::path(rest.substr(slash + 1)).relative_path(), folder);
  } else if (kind.empty() || kind == "file") {
    places = {folder / rest};  // an absolute path stays what it is
  } else {
    throw InputError("mesh \"" + name + "\": only package://, model://, file:// and paths are read");
  }
  for (const fs::path& place : places)
    if (isFile(place)) return place.lexically_normal().string();
  throw InputError("mesh \"" + name + "\": there is no such file" +
                   (places.size() > 1 ? ", nor in ROS_PACKAGE_PATH or AMENT_PREFIX_PATH" : ""));
}

/// Assimp shall open nothing but the bytes that it is given.
class NoFiles : public Assimp::IOSystem {
 public:
  bool Exists(const char*) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
  void Close(Assimp::IOStream*) override {}
};

}  // namespace

MeshSource meshesBeside(const std::string& robot, const ModelBudget& budget) {
  return [robot, most = budget.bytes](const std::string& name) -> MeshFile {
    const std::string path = findMeshFile(name, robot);
    return {path, readFile(path, most)};
  };
}

std::vector<MeshPart> readMesh(const MeshFile& file, const Eigen::Vector3d& scale, std::size_t mostTriangles) {
  const std::string ending = fileEnding(file.path);
  if (ending != ".stl" && ending != ".obj" && ending != ".dae")
    throw InputError(file.path + ": meshes are STL, OBJ or DAE files");

  Assimp::Importer importer;
  importer.SetIOHandler(new NoFiles);  // which the importer owns
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS,
                              aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                                  aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                                  aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS);
  const aiScene* scene = nullptr;
  try {
    scene = importer.ReadFileFromMemory(file.bytes.data(), file.bytes.size(),
                                        aiProcess_RemoveComponent | aiProcess_Triangulate |
                                            aiProcess_JoinIdenticalVertices | aiProcess_SortByPType |
                                            aiProcess_ValidateDataStructure,
                                        ending.c_str() + 1);
  } catch (const std::exception& failure) {
    throw InputError(file.path + ": it cannot be read: " + failure.what());
  }
  if (!scene || !scene->mRootNode)
    throw InputError(file.path + ": it cannot be read: " + std::string(importer.GetErrorString()).substr(0, 200));
  return partsOf(*scene, scale, file.path, mostTriangles);
}

}  // namespace btr
