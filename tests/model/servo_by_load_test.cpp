// Joints without a servo in their file: gains and torque by what they carry, against statics.
#include "core/model/servo_by_load.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/model/load_model.h"

namespace btr::test::by_load {
namespace {

constexpr double g = 9.81;

std::string body(double mass, const std::string& place, const std::string& shape = "") {
  return "<inertial><origin xyz='" + place + "'/><mass value='" + std::to_string(mass) +
         "'/><inertia ixx='0.001' iyy='0.001' izz='0.001'/></inertial>" + shape;
}
std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& more = "", const std::string& type = "continuous") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child +
         "'/><axis xyz='0 1 0'/>" + more + "</joint>";
}
std::string link(const std::string& name, const std::string& inside) {
  return "<link name='" + name + "'>" + inside + "</link>";
}
RobotModel read(const std::string& inside) { return parseUrdf("<robot name='r'>" + inside + "</robot>", "r.urdf"); }

/// A fixed arm of two links: 3 kg at 0.2 m from the shoulder, 1 kg at 0.3 m from the elbow, which is 0.5 m out.
std::string arm(const std::string& shoulder = "", const std::string& elbow = "") {
  return link("world", "") + link("upper", body(3, "0.2 0 0")) + link("lower", body(1, "0.3 0 0")) +
         joint("shoulder", "world", "upper", shoulder) +
         joint("elbow", "upper", "lower", "<origin xyz='0.5 0 0'/>" + elbow);
}

TEST(ServoByLoad, AnArmHoldsWhatItCarries) {
  const RobotModel model = read(arm());
  const double shoulder = 3 * g * 0.2 + 1 * g * 0.8, elbow = 1 * g * 0.3;
  const double inertia = 3 * 0.2 * 0.2 + 0.001 + 1 * 0.8 * 0.8 + 0.001;
  const ServoData& first = model.joints[0].servo;
  EXPECT_NEAR(shoulder / 0.02, *first.p_nm_rad, 1e-9);
  EXPECT_NEAR(2 * std::sqrt(shoulder / 0.02 * inertia), *first.d_nm_s_rad, 1e-9);
  EXPECT_NEAR(3 * shoulder, *first.maxTorque_nm, 1e-9);
  EXPECT_NEAR(elbow / 0.02, *model.joints[1].servo.p_nm_rad, 1e-9);
  EXPECT_THAT(model.warnings, testing::Contains(testing::Field(
                                  &Warning::text, testing::HasSubstr("2 joints have no servo in the file"))));
}

TEST(ServoByLoad, WhatTheFileGivesStays) {
  const RobotModel model = read(arm("<limit effort='40' velocity='1'/>", "<dynamics damping='0.5'/>"));
  EXPECT_EQ(40, *model.joints[0].servo.maxTorque_nm);
  EXPECT_EQ(0.5, *model.joints[1].servo.viscousFriction_nm_s_rad);
}

TEST(ServoByLoad, EffortZeroSaysTheTorqueThatWasChosen) {
  const RobotModel model = read(arm("", "<limit effort='0' velocity='1'/>"));
  EXPECT_THAT(
      model.warnings,
      testing::Contains(testing::Field(
          &Warning::text, testing::HasSubstr("elbow: effort 0 is taken as not given: its servo gets 8.829 N m"))));
}

TEST(ServoByLoad, AJointThatASmallServoHoldsKeepsIt) {
  const RobotModel model = read(link("world", "") + link("tip", body(0.1, "0.1 0 0")) + joint("j", "world", "tip"));
  EXPECT_FALSE(model.joints[0].servo.p_nm_rad || model.joints[0].servo.maxTorque_nm);
}

TEST(ServoByLoad, ASlideJointCarriesAWeight) {
  const RobotModel model = read(link("world", "") + link("lift", body(4, "0.3 0 0")) +
                                joint("j", "world", "lift", "<limit lower='0' upper='1'/>", "prismatic"));
  EXPECT_NEAR(4 * g / 0.001, *model.joints[0].servo.p_nm_rad, 1e-6);
  EXPECT_NEAR(3 * 4 * g, *model.joints[0].servo.maxTorque_nm, 1e-9);
}

// Of a gripper or a small lift: an ERS-7's 7.5 N m/rad would be 7.5 N/m, and 0.9 kg sag by more than a metre.
TEST(ServoByLoad, ASmallSlideJointGivesWayByAMillimetre) {
  for (const double mass : {0.9, 0.02}) {
    const RobotModel model = read(link("world", "") + link("lift", body(mass, "0 0 0")) +
                                  joint("j", "world", "lift", "<limit lower='0' upper='1'/>", "prismatic"));
    const ServoData& servo = model.joints[0].servo;
    ASSERT_TRUE(servo.p_nm_rad && servo.d_nm_s_rad);
    EXPECT_NEAR(0.001, mass * g / *servo.p_nm_rad, 1e-9);
    EXPECT_NEAR(1, *servo.d_nm_s_rad / (2 * std::sqrt(*servo.p_nm_rad * mass)), 1e-9) << "critically damped";
    EXPECT_GE(*servo.maxTorque_nm, mass * g);
  }
}

// A trunk of 20 kg on two legs that reach the floor, and an arm that does not.
TEST(ServoByLoad, AFreeRobotStandsOnTheLimbsThatReachTheFloor) {
  const std::string foot =
      "<collision><origin xyz='0 0 -0.5'/><geometry><sphere radius='0.05'/></geometry></collision>";
  const RobotModel model = read(link("trunk", body(20, "0.1 0 0")) + link("left", body(0.5, "0 0 -0.2", foot)) +
                                link("right", body(0.5, "0 0 -0.2", foot)) + link("arm", body(0.5, "0 0 -0.2")) +
                                joint("hip_left", "trunk", "left") + joint("hip_right", "trunk", "right") +
                                joint("arm_joint", "trunk", "arm"));
  // In front of a hip: the trunk 0.1 m from its axis, the other leg and the arm 0.2 m.
  const double half = 0.5 * (20 * g * 0.1 + 2 * 0.5 * g * 0.2);
  EXPECT_NEAR(half / 0.02, *model.joints[0].servo.p_nm_rad, 1e-9);
  EXPECT_NEAR(half / 0.02, *model.joints[1].servo.p_nm_rad, 1e-9);
  EXPECT_NEAR(0.5 * g * 0.2 / 0.02, *model.joints[2].servo.p_nm_rad, 1e-9) << "the arm carries itself alone";
}

}  // namespace
}  // namespace btr::test::by_load
