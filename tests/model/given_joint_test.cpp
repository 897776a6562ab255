// What other readers accept of robot files, though the text asks for more: what is made of it, and that it is said.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/model/kinematics.h"
#include "tests/model/model_texts.h"

namespace btr::test::given {
namespace {

using Eigen::Vector3d;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;

const std::string body = "<inertial><mass value='2'/><inertia ixx='1' iyy='1' izz='1'/></inertial>";

/// A fixed base and one joint at (0, 0, 1) that moves the link `tip`.
RobotModel read(const std::string& type, const std::string& joint, const std::string& tip = body) {
  return parseUrdf("<robot name='r'><link name='world'/><link name='tip'>" + tip + "</link><joint name='j' type='" +
                       type + "'><parent link='world'/><child link='tip'/><origin xyz='0 0 1'/>" + joint +
                       "</joint></robot>",
                   "robot.urdf");
}
void expectSaid(const RobotModel& model, const std::string& text) {
  EXPECT_THAT(model.warnings, Contains(Field(&Warning::text, HasSubstr(text))));
}

TEST(GivenJoint, AnAxisOfAnyLengthIsADirection) {
  const std::string limits = "<limit lower='-1' upper='1'/>";
  const RobotModel model = read("revolute", "<axis xyz='0 3 -4'/>" + limits);
  EXPECT_LT((model.joints[0].axis - Vector3d(0, 0.6, -0.8)).norm(), 1e-15);
  expectSaid(model, "joint j: its axis has not the length 1");
  for (const Warning& warning : read("revolute", "<axis xyz='0.707 0 0.707'/>" + limits).warnings)
    EXPECT_THAT(warning.text, testing::Not(HasSubstr("axis"))) << "a few digits are no finding";
}

TEST(GivenJoint, LimitsThatNobodyGaveAreNone) {
  const RobotModel model = read("revolute", "<limit lower='0' upper='0' effort='0' velocity='0'/>");
  EXPECT_EQ(Joint::Type::rotate, model.joints[0].type);
  EXPECT_EQ(Joint().lower, model.joints[0].lower);
  EXPECT_EQ(Joint().upper, model.joints[0].upper);
  expectSaid(model, "joint j: both limits are 0");
}

TEST(GivenJoint, OneNumberForBothLimitsFixesIt) {
  const double at = 0.3;
  const std::vector<double> atZero{0};
  const RobotModel turned = read("revolute", "<axis xyz='0 0 1'/><limit lower='0.3' upper='0.3'/>");
  EXPECT_EQ(Joint::Type::fixed, turned.joints[0].type);
  const Eigen::Isometry3d pose = forwardKinematics(turned, Eigen::Isometry3d::Identity(), atZero)[1];
  EXPECT_LT((pose.linear() * Vector3d::UnitX() - Vector3d(std::cos(at), std::sin(at), 0)).norm(), 1e-15);
  expectSaid(turned, "both limits are 0.3 rad: it is fixed there");

  const RobotModel moved = read("prismatic", "<axis xyz='1 0 0'/><limit lower='0.3' upper='0.3'/><mimic joint='k'/>");
  const Vector3d place = forwardKinematics(moved, Eigen::Isometry3d::Identity(), atZero)[1].translation();
  EXPECT_LT((place - Vector3d(at, 0, 1)).norm(), 1e-15);

  const RobotModel choreonoid = parseVrml(
      vrmlHeader + "Humanoid { humanoidBody DEF ROOT Joint { jointType \"fixed\" children [ DEF A Segment { " +
          goodMass +
          " } DEF J Joint { jointType \"slide\" jointAxis 0 0 1 llimit 0.2 ulimit 0.2 children DEF B Segment { " +
          goodMass + " } } ] } }",
      "robot.wrl");
  EXPECT_EQ(Joint::Type::fixed, choreonoid.joints[0].type);
  EXPECT_NEAR(0.2, choreonoid.joints[0].origin.translation().z(), 1e-15);
}

TEST(GivenJoint, AMassWithoutInertiaIsABallOfIron) {
  const RobotModel model = read("continuous", "",
                                "<inertial><mass value='2'/><inertia ixx='0' ixy='0' ixz='0' iyy='0' iyz='0' "
                                "izz='0'/></inertial>");
  const Eigen::Matrix3d& inertia = model.links[1].inertial.inertia_kg_m2;
  const double radius = std::sqrt(inertia(1, 1) / (0.4 * 2));
  EXPECT_NEAR(2, 7870 * 4 / 3. * M_PI * std::pow(radius, 3), 1e-12) << "what a ball of this radius weighs";
  EXPECT_TRUE(inertia.isApprox(inertia(0, 0) * Eigen::Matrix3d::Identity()));
  expectSaid(model, "link tip: its inertia is 0");
}

TEST(GivenJoint, WhatHasNoExtentIsLeftOutAndSaid) {
  const auto shape = [](const std::string& kind, const std::string& geometry) {
    return body + "<" + kind + "><geometry>" + geometry + "</geometry></" + kind + ">";
  };
  for (const std::string flat : {"<box size='1 1 0'/>", "<sphere radius='0'/>", "<cylinder radius='1' length='0'/>"}) {
    const RobotModel drawn = read("continuous", "", shape("visual", flat));
    EXPECT_TRUE(drawn.links[1].shapes.empty()) << flat;
    expectSaid(drawn, "has a size of 0; it is not drawn");
    const RobotModel touched = read("continuous", "", shape("collision", flat));
    EXPECT_TRUE(touched.links[1].shapes.empty()) << flat;
    EXPECT_THAT(touched.warnings, Contains(Field(&Warning::loss, Warning::Loss::collision))) << flat;
  }
  for (const std::string wrong :
       {"<box size='1 -1 1'/>", "<sphere radius='-1'/>", "<cylinder radius='1' length='-2'/>"})
    EXPECT_THROW(read("continuous", "", shape("visual", wrong)), InputError) << wrong;
}

TEST(GivenJoint, NamesOfOneByteALetterBecomeUtf8) {
  const std::string latin =
      "<robot name='r'><!-- f\xFCr --><link name='F\xFC\xDF"
      "e'>" +
      body + "</link></robot>";
  EXPECT_EQ(
      "F\u00fc\u00df"
      "e",
      parseUrdf(latin, "robot.urdf").links[0].name);
  const std::string vrml =
      vrmlHeader + "Humanoid { humanoidBody DEF F\xFC\xDF Joint { children DEF B Segment { " + goodMass + " } } }";
  EXPECT_EQ("B", parseVrml(vrml, "robot.wrl").links[0].name);
}

}  // namespace
}  // namespace btr::test::given
