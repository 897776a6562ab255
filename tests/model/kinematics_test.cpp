#include "core/model/kinematics.h"

#include <gtest/gtest.h>

#include <cmath>

namespace btr {
namespace {

using Eigen::Vector3d;

Link massAt(const std::string& name, double mass_kg, const Vector3d& com_m,
            const Vector3d& moments = {1e-3, 1e-3, 1e-3}) {
  Link link;
  link.name = name;
  link.inertial = {mass_kg, com_m, moments.asDiagonal()};
  return link;
}

/// Upper and lower arm of 1 m, turning about y, hanging down; a slide along z at the end.
RobotModel arm() {
  RobotModel model;
  model.links = {massAt("base", 1, {0, 0, 0}), massAt("upper", 2, {0, 0, -0.5}), massAt("lower", 1, {0, 0, -0.5}),
                 massAt("tip", 1, {0, 0, 0})};
  const auto joint = [](const char* name, int parent, Joint::Type type, const Vector3d& at, const Vector3d& axis) {
    Joint made;
    made.name = name;
    made.parentLink = parent;
    made.type = type;
    made.origin.translation() = at;
    made.axis = axis;
    return made;
  };
  model.joints = {joint("shoulder", 0, Joint::Type::rotate, {0, 0, 0}, {0, 1, 0}),
                  joint("elbow", 1, Joint::Type::rotate, {0, 0, -1}, {0, 1, 0}),
                  joint("slide", 2, Joint::Type::slide, {0, 0, -1}, {0, 0, -1})};
  return model;
}

TEST(ForwardKinematics, HangsDownAtZero) {
  const auto poses = forwardKinematics(arm(), Eigen::Isometry3d::Identity(), std::vector{0.0, 0.0, 0.0});
  EXPECT_TRUE(poses[3].translation().isApprox(Vector3d(0, 0, -2)));
}

TEST(ForwardKinematics, TurnsByTheRightHandRuleAndCarriesTheRoot) {
  Eigen::Isometry3d root = Eigen::Isometry3d::Identity();
  root.translation() = Vector3d(10, 0, 5);
  // 90 degrees about +y turns "down" (-z) to -x; the elbow bends back to hang down; the slide adds a quarter metre.
  const auto poses = forwardKinematics(arm(), root, std::vector{M_PI / 2, -M_PI / 2, 0.25});
  EXPECT_TRUE(poses[2].translation().isApprox(Vector3d(9, 0, 5), 1e-12));
  EXPECT_TRUE(poses[3].translation().isApprox(Vector3d(9, 0, 3.75), 1e-12));
}

TEST(MassProperties, AddMassesAndWeighCentres) {
  const Inertial total = massProperties(arm(), std::vector{0.0, 0.0, 0.0});
  EXPECT_DOUBLE_EQ(5, total.mass_kg);
  // (1·0 + 2·(-0.5) + 1·(-1.5) + 1·(-2)) / 5
  EXPECT_TRUE(total.centreOfMass_m.isApprox(Vector3d(0, 0, -0.9), 1e-12));
}

TEST(MassProperties, InertiaOfTwoPointsIsThatOfADumbbell) {
  // Reduced mass 2·3/5 = 1.2 kg, distance 0.5 m: 1.2·0.25 across, 0 along.
  const Inertial a{2, {0, 0, 0}, Eigen::Matrix3d::Zero()}, b{3, {0.5, 0, 0}, Eigen::Matrix3d::Zero()};
  const Inertial both = combined(a, b);
  EXPECT_TRUE(both.centreOfMass_m.isApprox(Vector3d(0.3, 0, 0), 1e-12));
  EXPECT_NEAR(0, both.inertia_kg_m2(0, 0), 1e-15);
  EXPECT_NEAR(0.3, both.inertia_kg_m2(1, 1), 1e-12);
  EXPECT_NEAR(0.3, both.inertia_kg_m2(2, 2), 1e-12);
}

TEST(MassProperties, ABodyCarriedByAQuarterTurnSwapsItsMoments) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()));
  pose.translation() = Vector3d(1, 0, 0);
  const Inertial moved = carried({2, {0.5, 0, 0}, Vector3d(1, 2, 3).asDiagonal()}, pose);
  EXPECT_TRUE(moved.centreOfMass_m.isApprox(Vector3d(1, 0.5, 0), 1e-12));
  EXPECT_TRUE(moved.inertia_kg_m2.diagonal().isApprox(Vector3d(2, 1, 3), 1e-12));
}

TEST(MassProperties, DoNotDependOnTheJointForABodyOnItsAxis) {
  RobotModel model = arm();
  model.links[1].inertial.centreOfMass_m.setZero();
  model.joints.resize(1);
  model.links.resize(2);
  const Inertial still = massProperties(model, std::vector{0.0}), turned = massProperties(model, std::vector{1.1});
  EXPECT_TRUE(still.inertia_kg_m2.isApprox(turned.inertia_kg_m2, 1e-12));
}

TEST(RobotModel, FindsLinksAndJointsByName) {
  EXPECT_EQ(2, arm().findLink("lower"));
  EXPECT_EQ(-1, arm().findLink("elbow"));
  EXPECT_EQ(1, arm().findJoint("elbow"));
  EXPECT_EQ(-1, arm().findJoint(""));
}

}  // namespace
}  // namespace btr
