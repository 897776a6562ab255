// What a URDF file leaves open: every choice of the reader is said, with its line, and what it does to the motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/model/model_texts.h"

namespace btr::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using Loss = Warning::Loss;

auto warns(int line, Loss loss, const std::string& at, const std::string& text) {
  return AllOf(Field(&Warning::line, line), Field(&Warning::loss, loss), Field(&Warning::at, at),
               Field(&Warning::text, HasSubstr(text)));
}

const std::string body = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>";

/// Line 1 begins the robot; a link "a" in line 2, then each piece in a line of its own.
RobotModel read(const std::vector<std::string>& lines) {
  std::string text = "<robot name='r'>\n<link name='a'>" + body + "</link>\n";
  for (const std::string& line : lines) text += line + "\n";
  return parseUrdf(text + "</robot>", "r.urdf");
}
std::string refused(const std::vector<std::string>& lines) {
  return refusal([&] { read(lines); });
}
std::string linkOf(const std::string& name, const std::string& more = "") {
  return "<link name='" + name + "'>" + body + more + "</link>";
}
std::string jointOf(const std::string& name, const std::string& type, const std::string& more,
                    const std::string& child = "b", const std::string& parent = "a") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child +
         "'/><axis xyz='0 1 0'/>" + more + "</joint>";
}

TEST(UrdfLosses, AJointWithoutLimitsMovesWithoutThem) {
  const auto model = read({linkOf("b"), jointOf("j", "revolute", "")});
  EXPECT_THAT(model.warnings, ElementsAre(warns(4, Loss::limits, "j", "it moves without limits")));
}

TEST(UrdfLosses, LowerAndUpperLeftOutAreNotTakenAsAJointThatCannotMove) {
  const auto model = read({linkOf("b"), jointOf("j", "revolute", "<limit effort='2' velocity='3'/>")});
  EXPECT_LT(model.joints[0].lower, -1e8);
  EXPECT_THAT(model.warnings, ElementsAre(warns(4, Loss::limits, "j", "URDF reads as 0 to 0 rad")));
  const auto half = read({linkOf("b"), jointOf("j", "prismatic", "<limit upper='0.2' effort='2' velocity='3'/>")});
  EXPECT_EQ(0, half.joints[0].lower);
  EXPECT_THAT(half.warnings, ElementsAre(warns(4, Loss::limits, "j", "lower is left out and taken as 0 m"),
                                         warns(4, Loss::none, "", "1 joint has no servo in the file")));
}

TEST(UrdfLosses, AContinuousJointHasNoLimits) {
  const auto model =
      read({linkOf("b"), jointOf("j", "continuous", "<limit lower='-1' upper='1' effort='2' velocity='3'/>")});
  EXPECT_LT(model.joints[0].lower, -1e8);
  EXPECT_THAT(model.warnings, ElementsAre(warns(4, Loss::limits, "j", "were ignored")));
}

TEST(UrdfLosses, EffortZeroIsNotAServoWithoutTorque) {
  const auto model =
      read({linkOf("b"), jointOf("j", "revolute", "<limit lower='0' upper='1' effort='0' velocity='0'/>")});
  EXPECT_FALSE(model.joints[0].servo.maxTorque_nm);
  EXPECT_THAT(model.warnings, ElementsAre(warns(4, Loss::effort, "j", "its servo gets 0.85 N m"),
                                          warns(4, Loss::none, "", "its speed has no limit")));
}

TEST(UrdfLosses, AShapeThatIsNotKnownCollidesWithNothing) {
  const auto model = read({linkOf("b",
                                  "<collision><geometry><cone/></geometry></collision>"
                                  "<visual><geometry><cone/></geometry></visual>"),
                           jointOf("j", "fixed", "")});
  EXPECT_THAT(model.warnings, ElementsAre(warns(3, Loss::collision, "b",
                                                "link b: the geometry <cone> is not known; it "
                                                "collides with nothing"),
                                          warns(3, Loss::none, "b", "it is not drawn")));
}

TEST(UrdfLosses, CollisionShapesAreDrawnWhereNoVisualOfTheLinkCanBeRead) {
  const std::string lost =
      "<visual><geometry><mesh filename='a.stl'/></geometry><material name='red'><color rgba='1 0 0 1'/></material>"
      "</visual>";
  const std::string ball = "<collision><geometry><sphere radius='0.1'/></geometry></collision>";
  const auto model = read({linkOf("b", lost + ball), jointOf("j", "continuous", ""),
                           linkOf("c", lost + ball + "<visual><geometry><box size='1 1 1'/></geometry></visual>"),
                           jointOf("k", "continuous", "", "c")});
  ASSERT_EQ(1u, model.links[1].shapes.size());
  EXPECT_TRUE(model.links[1].shapes[0].drawn && model.links[1].shapes[0].collides);
  EXPECT_EQ((std::array<float, 4>{1, 0, 0, 1}), model.links[1].shapes[0].colour);
  ASSERT_EQ(2u, model.links[2].shapes.size());
  EXPECT_FALSE(model.links[2].shapes[0].drawn);
  EXPECT_THAT(model.warnings, ElementsAre(warns(3, Loss::none, "b", "; its collision shapes are drawn"),
                                          warns(5, Loss::none, "c", "; it is not drawn")));
}

TEST(UrdfLosses, LossesAreListedHoweverManyOtherWarningsThereAre) {
  std::vector<std::string> lines(300, "<gazebo/>");
  lines.push_back(linkOf("b"));
  lines.push_back(jointOf("j", "revolute", ""));
  const auto model = read(lines);
  EXPECT_EQ(201u, model.warnings.size());
  EXPECT_EQ(Loss::limits, model.warnings.back().loss);
}

TEST(Urdf, FramesOfMassZeroAreJoinedLikeFramesWithoutMass) {
  const auto model =
      read({"<link name='tool'><inertial><mass value='0.0'/><inertia ixx='0' iyy='0' izz='0'/></inertial>"
            "<collision><geometry><sphere radius='0.01'/></geometry></collision></link>",
            "<joint name='j' type='fixed'><parent link='a'/><child link='tool'/><origin xyz='0 0 -0.2'/>"
            "<axis xyz='0 0 0'/></joint>"});
  ASSERT_EQ(1u, model.links.size());
  EXPECT_DOUBLE_EQ(1, model.links[0].inertial.mass_kg);
  EXPECT_EQ(Eigen::Vector3d(0, 0, -0.2), model.links[0].shapes.at(0).pose.translation());
  EXPECT_THAT(model.warnings, ElementsAre(warns(3, Loss::none, "", "link tool was joined to a")));
}

TEST(HostileUrdf, MassZeroMayNotMove) {
  const std::string massless =
      "<link name='b'><inertial><mass value='0'/><inertia ixx='0' iyy='0' izz='0'/></inertial></link>";
  // Unless it is nothing but a place: see below.
  EXPECT_THAT(refused({massless, jointOf("j", "continuous", ""), linkOf("c"), jointOf("k", "fixed", "", "c", "b")}),
              HasSubstr("r.urdf:3: link b: mass 0 kg is not allowed; 0.000001 to 1000000 kg"));
  EXPECT_THAT(refused({"<link name='b'><visual><geometry><sphere radius='0.1'/></geometry></visual></link>",
                       jointOf("j", "continuous", "")}),
              HasSubstr("r.urdf:3: link b: mass 0 kg is not allowed"));
  EXPECT_THAT(refused({massless, jointOf("j", "continuous", ""), linkOf("c"),
                       jointOf("k", "continuous", "<mimic joint='j'/>", "c")}),
              HasSubstr("r.urdf:3: link b: mass 0 kg is not allowed"));
  EXPECT_THAT(
      refused({"<link name='b'><inertial><mass value='-1'/><inertia ixx='1' iyy='1' izz='1'/></inertial></link>",
               jointOf("j", "fixed", "")}),
      HasSubstr("r.urdf:3: value -1 is not allowed"));
}

TEST(UrdfLosses, AMovingPlaceAtTheEndOfTheTreeIsLeftOut) {
  // PR2: a prismatic joint for the simulator of its time, which moves a link without anything.
  const auto model =
      read({"<link name='dummy'/>",
            jointOf("slider", "prismatic", "<limit lower='0' upper='1' effort='1' velocity='1'/>", "dummy"),
            linkOf("b"), jointOf("j", "continuous", "")});
  ASSERT_EQ(2u, model.links.size());
  EXPECT_EQ("j", model.joints[0].name);
  EXPECT_THAT(model.warnings,
              ElementsAre(warns(4, Loss::limits, "slider", "joint slider and link dummy are left out")));
}

TEST(Urdf, CapsulesLieAlongZAndKeepTheirEndsApart) {
  const auto model =
      read({linkOf("b", "<collision><geometry><capsule radius='0.02' length='0.16'/></geometry></collision>"),
            jointOf("j", "fixed", "")});
  const Shape& shape = model.links[1].shapes.at(0);
  EXPECT_EQ(Shape::Kind::capsule, shape.kind);
  EXPECT_EQ(Eigen::Vector3d(0.02, 0.16, 0), shape.size_m);
  EXPECT_TRUE((shape.pose.linear() * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d::UnitZ(), 1e-12));
}

TEST(Urdf, MimicJointsFollowWhoReallyLeads) {
  const std::string limit = "<limit lower='-1' upper='1' effort='2' velocity='3'/>";
  const auto model =
      read({linkOf("b"), linkOf("c"), linkOf("d"),
            jointOf("third", "revolute", limit + "<mimic joint='second' multiplier='3' offset='0.1'/>", "d"),
            jointOf("second", "revolute", limit + "<mimic joint='first' multiplier='-0.5' offset='0.2'/>", "c"),
            jointOf("first", "revolute", limit, "b")});
  EXPECT_TRUE(model.warnings.empty());
  const auto& second = model.joints[static_cast<std::size_t>(model.findJoint("second"))].mimic;
  const auto& third = model.joints[static_cast<std::size_t>(model.findJoint("third"))].mimic;
  ASSERT_TRUE(second && third);
  EXPECT_FALSE(model.joints[static_cast<std::size_t>(model.findJoint("first"))].mimic);
  EXPECT_EQ(model.findJoint("first"), second->leader);
  EXPECT_EQ(model.findJoint("first"), third->leader);
  EXPECT_DOUBLE_EQ(-0.5, second->multiplier);
  EXPECT_DOUBLE_EQ(3 * -0.5, third->multiplier);
  EXPECT_DOUBLE_EQ(3 * 0.2 + 0.1, third->offset);
  EXPECT_THAT(describeModel(model), HasSubstr("follows first: -1.5 times it plus 0.7"));
}

TEST(HostileUrdf, MimicNeedsALeaderThatMoves) {
  const auto mimic = [](const std::string& name) { return "<mimic joint='" + name + "'/>"; };
  EXPECT_THAT(refused({linkOf("b"), jointOf("j", "continuous", mimic("none"))}),
              HasSubstr("r.urdf:4: joint j mimics \"none\", which is no joint"));
  EXPECT_THAT(refused({linkOf("b"), jointOf("j", "continuous", mimic("j"))}), HasSubstr("itself"));
  EXPECT_THAT(
      refused({linkOf("b"), linkOf("c"), jointOf("j", "continuous", mimic("k")), jointOf("k", "fixed", "", "c")}),
      HasSubstr("\"k\", which does not move"));
  EXPECT_THAT(refused({linkOf("b"), linkOf("c"), jointOf("j", "continuous", mimic("k")),
                       jointOf("k", "continuous", mimic("j"), "c")}),
              HasSubstr("itself, through others"));
}

TEST(HostileUrdf, XacroIsToldToBeExpanded) {
  const std::string text =
      "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>\n<link name='a'/>\n"
      "<xacro:macro name='m'><link name='${n}'/></xacro:macro>\n</robot>";
  EXPECT_THAT(refusal([&] { parseUrdf(text, "r.urdf"); }),
              AllOf(HasSubstr("r.urdf:3: <xacro:macro>"), HasSubstr("expand the file first")));
  EXPECT_THAT(refusal([] { loadModel("robot.urdf.xacro"); }), HasSubstr("expanded first"));
  EXPECT_THAT(refused({linkOf("b"), jointOf("j", "fixed", "<origin xyz='${x} 0 0'/>"), "<xacro:leg/>"}),
              HasSubstr("r.urdf:5: <xacro:leg> belongs to xacro"));
}

// A PR2 of 2010 holds such calls: its macros were unknown when it was expanded.
TEST(UrdfLosses, WhatXacroLeftBehindIsIgnoredAndSaid) {
  const RobotModel model = read({"<xacro:head_gazebo_v0 name='head'/>"});
  EXPECT_THAT(model.warnings, ElementsAre(warns(3, Loss::none, "", "<xacro:head_gazebo_v0> was ignored")));
}

TEST(UrdfLosses, AnInertiaThatNoBodyHasIsSimulatedAndSaid) {
  const RobotModel model =
      read({"<link name='b'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='3'/>"
            "</inertial></link>",
            jointOf("j", "continuous", "")});
  EXPECT_EQ(3, model.links[1].inertial.inertia_kg_m2(2, 2));
  EXPECT_THAT(model.warnings, testing::Contains(warns(3, Loss::inertia, "b", "triangle inequality")));
}

TEST(UrdfTree, AJointMayHangFromAWorldThatNoLinkDeclares) {
  const RobotModel model = read({jointOf("anchor", "fixed", "<origin xyz='0 0 0.5'/>", "a", "world")});
  EXPECT_FALSE(model.freeBase);
  ASSERT_EQ(2u, model.links.size());
  EXPECT_EQ("world", model.links[0].name);
  EXPECT_DOUBLE_EQ(0.5, model.joints[0].origin.translation().z());
  EXPECT_TRUE(read({jointOf("free", "floating", "", "a", "world")}).freeBase);
}

TEST(Urdf, CommentsMayStandBeforeTheDeclaration) {
  const std::string text =
      "<!-- autogenerated by xacro -->\n<?xml version=\"1.0\" ?>\n<robot name='r'>\n<link name='a'>\n" + body +
      "</link></robot>";
  EXPECT_EQ(4, parseUrdf(text, "r.urdf").links[0].line);
}

}  // namespace
}  // namespace btr::test
