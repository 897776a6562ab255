// What of a robot can touch something: capsules, meshes beside primitives, and what is said where nothing can.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/model/load_model.h"
#include "core/sim/contact/collision.h"
#include "core/sim/model_losses.h"
#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Shape capsule(double radius, double length) {
  Shape shape;
  shape.kind = Shape::Kind::capsule;
  shape.size_m = {radius, length, 0};
  return shape;
}

TEST(Capsule, TouchesTheFloorWithItsEnds) {
  const Collider collider = makeCollider(capsule(0.02, 0.16), Isometry3d::Identity(), 0);
  std::vector<ContactPoint> contacts;
  // Lying (along y), 1 mm deep: both ends carry.
  Isometry3d pose(Eigen::Translation3d(0, 0, 0.019));
  floorContacts(collider, pose, 0, contacts);
  ASSERT_EQ(2u, contacts.size());
  for (const auto& contact : contacts) {
    EXPECT_NEAR(0.001, contact.depth_m, 1e-12);
    EXPECT_NEAR(0.08, std::abs(contact.position_m.y()), 1e-12);
  }
  // Standing: the lower end alone, 0.08 + 0.02 below the middle.
  pose = Eigen::Translation3d(0, 0, 0.0995) * Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX());
  floorContacts(collider, pose, 0, contacts);
  ASSERT_EQ(1u, contacts.size());
  EXPECT_NEAR(0.0005, contacts[0].depth_m, 1e-12);
}

TEST(Capsule, IsRoundForABall) {
  const Collider collider = makeCollider(capsule(0.02, 0.16), Isometry3d::Identity(), 0);
  ContactPoint contact;
  // Beside the middle part, then beyond an end on a slant.
  ASSERT_TRUE(sphereContact(collider, Isometry3d::Identity(), {0.05, 0.03, 0}, 0.031, 0, contact));
  EXPECT_TRUE(contact.normal.isApprox(Vector3d::UnitX(), 1e-12));
  EXPECT_NEAR(0.001, contact.depth_m, 1e-12);
  const Vector3d slant = Vector3d(0, 1, 1).normalized();
  ASSERT_TRUE(sphereContact(collider, Isometry3d::Identity(), Vector3d(0, 0.08, 0) + 0.05 * slant, 0.031, 0, contact));
  EXPECT_TRUE(contact.normal.isApprox(slant, 1e-12));
  EXPECT_NEAR(0.001, contact.depth_m, 1e-12);
  EXPECT_FALSE(
      sphereContact(collider, Isometry3d::Identity(), Vector3d(0, 0.08, 0) + 0.052 * slant, 0.031, 0, contact));
}

TEST(Capsule, CarriesARobotThatHasNothingElse) {
  // A free rod: dropped flat from its resting height, it stays there.
  Scene scene = sceneOf(robot(bodyModel(0.5, {1e-3, 1e-4, 1e-3}, {capsule(0.02, 0.16)}), true), 5e-4);
  scene.floor = FloorSpec{};
  scene.robots[0].start.translation().z() = 0.02;
  World world(scene, 1);
  world.advance({{}}, 0.5);
  EXPECT_EQ("", world.fault());
  EXPECT_NEAR(0.02, world.robot(0).base.translation().z(), 5e-4);
}

/// A link with a box and, beside it, the tetrahedron of a mesh.
RobotModel boxAndMesh(bool meshesReplacePrimitives) {
  Shape mesh;
  mesh.kind = Shape::Kind::mesh;
  mesh.surface = std::make_shared<const Surface>(
      Surface{{{0, 0, 0}, {0.1f, 0, 0}, {0, 0.1f, 0}, {0, 0, 0.1f}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, {}});
  RobotModel model = bodyModel(1, {0.01, 0.01, 0.01}, {box({0.1, 0.1, 0.1}), mesh});
  model.meshesReplacePrimitives = meshesReplacePrimitives;
  return model;
}

TEST(CollidingShapes, MeshesReplacePrimitivesOnlyWhereTheModelSaysSo) {
  const auto colliding = [](const RobotModel& model, const std::string& collision) {
    std::string kinds;
    for (const Shape& shape : model.links[0].shapes)
      if (collidesIn(model, model.links[0], shape, collision)) kinds += shape.kind == Shape::Kind::mesh ? "m" : "p";
    return kinds;
  };
  EXPECT_EQ("p", colliding(boxAndMesh(true), "primitives"));
  EXPECT_EQ("m", colliding(boxAndMesh(true), "mesh"));
  EXPECT_EQ("", colliding(boxAndMesh(true), "none"));
  for (const char* collision : {"primitives", "mesh"}) EXPECT_EQ("pm", colliding(boxAndMesh(false), collision));
  EXPECT_EQ("", colliding(boxAndMesh(false), "none"));
  RobotModel meshOnly = boxAndMesh(true);
  meshOnly.links[0].shapes.erase(meshOnly.links[0].shapes.begin());
  EXPECT_EQ("m", colliding(meshOnly, "primitives"));
}

RobotModel urdf(const std::string& inside) {
  return parseUrdf(
      "<robot name='r'>\n<link name='a'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/>"
      "</inertial>" +
          inside + "</link>\n</robot>",
      "r.urdf");
}

std::vector<std::string> lossesOf(const RobotModel& model, RobotSpec robot = {}) {
  SceneSpec spec;
  spec.floor = FloorSpec{};
  robot.name = "dog";
  robot.model = "r.urdf";
  spec.robots = {robot};
  return modelLosses(spec, {{"r.urdf", std::make_shared<const RobotModel>(model)}});
}

TEST(ModelLosses, AreSaidWhereTheSceneAsksForThem) {
  const RobotModel cone = urdf(
      "<collision><geometry><cone/></geometry></collision>"
      "<collision><geometry><sphere radius='1'/></geometry></collision>");
  EXPECT_THAT(lossesOf(cone), ElementsAre(HasSubstr("dog (r.urdf, line 2): link a: the geometry <cone> is not known")));
  RobotSpec untouched;
  untouched.collision = "none";
  EXPECT_THAT(lossesOf(cone, untouched), IsEmpty());
}

TEST(DrawingLosses, ShapesThatCannotBeReadAreCountedOnceAModel) {
  const auto drawingLossesOf = [](const std::string& inside) {
    SceneSpec spec;
    spec.robots.resize(2);
    for (RobotSpec& robot : spec.robots) robot.model = "r.urdf";
    return drawingLosses(spec, {{"r.urdf", std::make_shared<const RobotModel>(urdf(inside))}});
  };
  const std::string lost = "<visual><geometry><mesh filename='a.stl'/></geometry></visual>";
  const std::string ball = "<collision><geometry><sphere radius='1'/></geometry></collision>";
  const std::string flat = "<visual><geometry><box size='1 1 0'/></geometry></visual>";
  EXPECT_THAT(drawingLossesOf(ball + flat), IsEmpty());
  EXPECT_THAT(drawingLossesOf(lost + lost + ball),
              ElementsAre("r.urdf: 2 visual shapes cannot be read: 2 drawn by their collision shapes"));
  EXPECT_THAT(drawingLossesOf(lost), ElementsAre("r.urdf: 1 visual shape cannot be read: 1 not drawn"));
}

TEST(ModelLosses, ARobotThatTheFloorCannotHoldIsNamed) {
  RobotSpec free;
  free.base = "free";
  EXPECT_THAT(lossesOf(urdf(""), free), ElementsAre(HasSubstr("no shape of it collides")));
  RobotSpec fixed;
  fixed.base = "fixed";
  EXPECT_THAT(lossesOf(urdf(""), fixed), IsEmpty());
}

TEST(ModelLosses, ATorqueLimitOfTheSceneMakesEffortZeroGood) {
  const RobotModel hand = parseUrdf(
      "<robot name='r'><link name='a'/><link name='b'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/>"
      "</inertial></link><joint name='j' type='revolute'><parent link='a'/><child link='b'/>"
      "<limit lower='0' upper='1' effort='0' velocity='1'/></joint></robot>",
      "r.urdf");
  RobotSpec robot;
  robot.base = "fixed";
  EXPECT_THAT(lossesOf(hand, robot), ElementsAre(HasSubstr("effort 0 is taken as not given")));
  robot.servos["j"].drive = "servo";
  EXPECT_EQ(1u, lossesOf(hand, robot).size());
  robot.servos["j"].numbers["max_torque_nm"] = 2;
  EXPECT_THAT(lossesOf(hand, robot), IsEmpty());
  robot.servos["j"] = {};
  robot.servos["j"].drive = "motion";
  EXPECT_THAT(lossesOf(hand, robot), IsEmpty());
}

}  // namespace
}  // namespace btr::test
