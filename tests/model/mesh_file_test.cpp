// Mesh files of URDF robots: each kind gives the surface that its text says, whatever its scale, and what cannot be
// read is named. The files are written here.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "core/model/mesh_file.h"
#include "tests/model/model_texts.h"

namespace btr::test {
namespace {
namespace fs = std::filesystem;
using Eigen::Vector3d;
using Eigen::Vector3f;
using testing::HasSubstr;

using Triangle = std::array<Vector3f, 3>;

/// A box with its corner at the origin, seen from outside.
std::vector<Triangle> boxOf(const Vector3f& size) {
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis)
    for (const bool far : {false, true}) {
      Vector3f u = Vector3f::Zero(), v = Vector3f::Zero(), at = Vector3f::Zero();
      u[(axis + 1) % 3] = size[(axis + 1) % 3];
      v[(axis + 2) % 3] = size[(axis + 2) % 3];
      if (far) at[axis] = size[axis];
      if (!far) std::swap(u, v);
      triangles.push_back({at, at + u, at + u + v});
      triangles.push_back({at, at + u + v, at + v});
    }
  return triangles;
}

std::string textStl(const std::vector<Triangle>& triangles) {
  std::ostringstream text;
  text << "solid box\n";
  for (const auto& triangle : triangles) {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const auto& corner : triangle) text << "vertex " << corner.transpose() << '\n';
    text << "endloop\nendfacet\n";
  }
  text << "endsolid box\n";
  return text.str();
}

std::string binaryStl(const std::vector<Triangle>& triangles) {
  std::string bytes(80, ' ');
  const auto put = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  put(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    for (int i = 0; i < 3; ++i) put(0.f);
    for (const auto& corner : triangle)
      for (int i = 0; i < 3; ++i) put(corner[i]);
    put(std::uint16_t{0});
  }
  return bytes;
}

std::string objText(const std::vector<Triangle>& triangles) {
  std::ostringstream text;
  for (const auto& triangle : triangles)
    for (const auto& corner : triangle) text << "v " << corner.transpose() << '\n';
  for (std::size_t i = 0; i < triangles.size(); ++i)
    text << "f " << 3 * i + 1 << ' ' << 3 * i + 2 << ' ' << 3 * i + 3 << '\n';
  return text.str();
}

/// In a node that is moved by `shift`, in units of `unit` metres.
std::string daeText(const std::vector<Triangle>& triangles, double unit, const std::string& up, const Vector3d& shift) {
  std::ostringstream text, corners, indices;
  for (const auto& triangle : triangles)
    for (const auto& corner : triangle) corners << corner.transpose() << ' ';
  for (std::size_t i = 0; i < 3 * triangles.size(); ++i) indices << i << ' ';
  const std::size_t count = 9 * triangles.size();
  text << "<?xml version='1.0'?>\n<COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'>\n"
       << "<asset><unit meter='" << unit << "'/><up_axis>" << up << "</up_axis></asset>\n"
       << "<library_effects><effect id='e'><profile_COMMON><technique sid='t'><phong><diffuse><color>1 0 0 1</color>"
       << "</diffuse></phong></technique></profile_COMMON></effect></library_effects>\n"
       << "<library_materials><material id='red'><instance_effect url='#e'/></material></library_materials>\n"
       << "<library_geometries><geometry id='g'><mesh><source id='p'><float_array id='pa' count='" << count << "'>"
       << corners.str() << "</float_array><technique_common><accessor source='#pa' count='" << count / 3
       << "' stride='3'><param name='X' type='float'/><param name='Y' type='float'/><param name='Z' type='float'/>"
       << "</accessor></technique_common></source><vertices id='v'><input semantic='POSITION' source='#p'/></vertices>"
       << "<triangles material='m' count='" << triangles.size() << "'><input semantic='VERTEX' source='#v' offset='0'/>"
       << "<p>" << indices.str() << "</p></triangles></mesh></geometry></library_geometries>\n"
       << "<library_visual_scenes><visual_scene id='s'><node id='n'><translate>" << shift.transpose()
       << "</translate><instance_geometry url='#g'><bind_material><technique_common><instance_material symbol='m' "
       << "target='#red'/></technique_common></bind_material></instance_geometry></node></visual_scene>"
       << "</library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>\n";
  return text.str();
}

struct Extent {
  Vector3d low = Vector3d::Constant(1e9), high = Vector3d::Constant(-1e9);
  double volume = 0;  ///< positive where the triangles look outwards
};

Extent extentOf(const std::vector<MeshPart>& parts) {
  Extent extent;
  for (const auto& part : parts)
    for (const auto& triangle : part.triangles) {
      const auto at = [&](std::size_t i) {
        return part.vertices.at(static_cast<std::size_t>(triangle[i])).cast<double>().eval();
      };
      for (std::size_t i = 0; i < 3; ++i) {
        extent.low = extent.low.cwiseMin(at(i));
        extent.high = extent.high.cwiseMax(at(i));
      }
      extent.volume += at(0).dot(at(1).cross(at(2))) / 6;
    }
  return extent;
}

const Vector3f size(0.1f, 0.2f, 0.3f);

TEST(MeshFile, EveryKindGivesTheSameBox) {
  const auto box = boxOf(size);
  const std::map<std::string, std::string> files{{"a.stl", textStl(box)},
                                                 {"b.STL", binaryStl(box)},
                                                 {"c.obj", objText(box)},
                                                 {"d.dae", daeText(box, 1, "Z_UP", {0, 0, 0})}};
  for (const auto& [name, bytes] : files) {
    const auto parts = readMesh({name, bytes}, Vector3d::Ones(), 100);
    const Extent extent = extentOf(parts);
    EXPECT_TRUE(extent.low.isZero(1e-6)) << name;
    EXPECT_TRUE(extent.high.isApprox(size.cast<double>(), 1e-6)) << name;
    EXPECT_NEAR(0.006, extent.volume, 1e-7) << name;
    ASSERT_EQ(1u, parts.size());
    EXPECT_EQ(12u, parts[0].triangles.size()) << name;
    EXPECT_EQ(8u, parts[0].vertices.size()) << name;
  }
}

TEST(MeshFile, AMirroringScaleKeepsTheOutsideOutside) {
  const Extent extent = extentOf(readMesh({"a.stl", textStl(boxOf(size))}, {0.001, -0.001, 0.002}, 100));
  EXPECT_TRUE(extent.low.isApprox(Vector3d(0, -0.0002, 0), 1e-5));
  EXPECT_TRUE(extent.high.isApprox(Vector3d(0.0001, 0, 0.0006), 1e-5));
  EXPECT_NEAR(0.006 * 2e-9, extent.volume, 1e-14);
}

TEST(MeshFile, ADaeHasItsUnitAndColourButNoUpAxis) {
  // As RViz and MoveIt read it: Y_UP turns nothing.
  const auto parts = readMesh({"a.dae", daeText(boxOf(size), 0.001, "Y_UP", {5, 0, 0})}, Vector3d::Ones(), 100);
  const Extent extent = extentOf(parts);
  EXPECT_TRUE(extent.low.isApprox(Vector3d(0.005, 0, 0), 1e-5)) << extent.low.transpose();
  EXPECT_TRUE(extent.high.isApprox(Vector3d(0.0051, 0.0002, 0.0003), 1e-5)) << extent.high.transpose();
  ASSERT_TRUE(parts[0].colour);
  EXPECT_EQ((std::array<float, 4>{1, 0, 0, 1}), *parts[0].colour);
}

TEST(MeshFile, WhatCannotBeReadNamesTheFile) {
  const auto refused = [](const std::string& name, const std::string& bytes, std::size_t most = 100) {
    return refusal([&] { readMesh({name, bytes}, Vector3d::Ones(), most); });
  };
  EXPECT_THAT(refused("leg.ply", "ply"), HasSubstr("leg.ply: meshes are STL, OBJ or DAE files"));
  for (const char* name : {"leg.stl", "leg.obj", "leg.dae"}) {
    EXPECT_THAT(refused(name, ""), HasSubstr(std::string(name) + ": it")) << name;
    EXPECT_THAT(refused(name, "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 9\n"),
                HasSubstr(std::string(name) + ": it"))
        << name;
  }
  const std::string whole = binaryStl(boxOf(size));
  EXPECT_THAT(refused("leg.stl", whole.substr(0, whole.size() / 2)), HasSubstr("leg.stl: it cannot be read"));
  EXPECT_THAT(refused("leg.stl", whole, 11), HasSubstr("more than 11 triangles"));
}

/// A folder as a robot's package has it, removed in the end.
class MeshFolders : public testing::Test {
 protected:
  MeshFolders() : root_(fs::temp_directory_path() / ("uchilsim-mesh-" + std::to_string(getpid()))) {
    fs::remove_all(root_);
    put("dog_description/urdf/dog.urdf", "");
  }
  ~MeshFolders() override { fs::remove_all(root_); }

  void put(const std::string& path, const std::string& bytes) {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path, std::ios::binary) << bytes;
  }
  std::string robot() const { return (root_ / "dog_description/urdf/dog.urdf").string(); }
  /// Loads a dog of one link with this geometry.
  RobotModel load(const std::string& mesh, const std::string& element = "collision") {
    put("dog_description/urdf/dog.urdf",
        "<robot name='dog'><link name='foot'><inertial><mass value='1'/><inertia ixx='1' "
        "iyy='1' izz='1'/></inertial>\n<" +
            element + "><geometry><mesh " + mesh + "/></geometry></" + element + "></link></robot>");
    return loadModel(robot());
  }
  fs::path root_;
};

TEST_F(MeshFolders, AreFoundByEveryNameThatRobotsUse) {
  put("dog_description/meshes/foot.stl", "here");
  put("other/meshes/eye.stl", "there");
  put("dog_description/urdf/near.stl", "near");
  const MeshSource find = meshesBeside(robot());
  EXPECT_EQ("here", find("package://dog_description/meshes/foot.stl").bytes);
  EXPECT_EQ("here", find("model://dog_description/meshes/foot.stl").bytes);
  EXPECT_EQ("here", find("../meshes/foot.stl").bytes);
  EXPECT_EQ("here", find("file://" + (root_ / "dog_description/meshes/foot.stl").string()).bytes);
  EXPECT_EQ("near", find("near.stl").bytes);
  EXPECT_EQ("there", find("package://other/meshes/eye.stl").bytes);
  // Taken out of its package.
  EXPECT_EQ("here", find("package://dog_as_it_was/meshes/foot.stl").bytes);
  EXPECT_THAT(refusal([&] { find("package://dog_description/meshes/hand.stl"); }),
              HasSubstr("mesh \"package://dog_description/meshes/hand.stl\": there is no such file"));
  EXPECT_THAT(refusal([&] { find("http://example.org/foot.stl"); }), HasSubstr("only package://"));
}

TEST_F(MeshFolders, ARobotCollidesWithItsMeshAndMayComeWithoutIt) {
  put("dog_description/meshes/foot.stl", binaryStl(boxOf(size)));
  const auto model = load("filename='package://dog_description/meshes/foot.stl' scale='1 1 -1'");
  EXPECT_TRUE(model.warnings.empty());
  const Shape& foot = model.links[0].shapes.at(0);
  EXPECT_TRUE(foot.collides && !foot.drawn);
  ASSERT_EQ(Shape::Kind::mesh, foot.kind);
  EXPECT_EQ(8u, foot.surface->vertices.size());

  const auto without = load("filename='package://dog_description/meshes/hand.stl'");
  ASSERT_EQ(1u, without.warnings.size());
  EXPECT_EQ(Warning::Loss::collision, without.warnings[0].loss);
  EXPECT_EQ(2, without.warnings[0].line);
  EXPECT_THAT(without.warnings[0].text,
              HasSubstr("link foot: mesh \"package://dog_description/meshes/hand.stl\": there "
                        "is no such file"));
  EXPECT_THAT(load("filename='hand.stl'", "visual").warnings.at(0).text, HasSubstr("it is not drawn"));
  EXPECT_THAT(refusal([&] { load("filename='../meshes/foot.stl' scale='1 0 1'"); }),
              HasSubstr("dog.urdf:2: scale must not be 0"));
}

}  // namespace
}  // namespace btr::test
