// Primitives, ranges and places in the sensor vector after Sony's Model Information for each robot.
#include "core/openr/robot_design.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/spec/error.h"

namespace btr::openr {
namespace {

using Kind = Primitive::Kind;

// OPrimitiveType
constexpr int sensorType = 6, speakerType = 7, microphoneType = 8, cameraType = 9, joint2 = 11, led2 = 12, joint3 = 13,
              joint4 = 14, led3 = 16;

const std::string head = "/r1/c1/c2/c3";  // the last joint of the neck, on which all of the head sits

std::int32_t microradians(double degrees) { return static_cast<std::int32_t>(std::lround(degrees * M_PI / 180 * 1e6)); }

Primitive joint(const std::string& path, const std::string& name, double low_deg, double high_deg) {
  return {Kind::joint, "PRM:" + path, name, joint2, microradians(low_deg), microradians(high_deg)};
}

/// A plunger with two states: 0 hanging, its highest angle pushed out.
Primitive ear(const std::string& path, const std::string& name, int type) {
  return {Kind::ear, "PRM:" + path, name, type, 0, microradians(15)};
}

Primitive sensor(const std::string& path, const std::string& name) {
  return {Kind::sensor, "PRM:" + path, name, sensorType};
}

Primitive lamp(const std::string& path, const std::string& name, int type) {
  return {Kind::lamp, "PRM:" + path, name, type};
}

/// The loudspeaker sits in the chest of the ERS-7, in the head of the others.
std::vector<Primitive> devices(const std::string& ofSpeaker) {
  return {{Kind::camera, "PRM:" + head + "/i1-FbkImageSensor:F1", "camera", cameraType},
          {Kind::microphone, "PRM:" + head + "/m1-Mic:M1", "microphone", microphoneType},
          {Kind::speaker, "PRM:" + ofSpeaker + "/s1-Speaker:S1", "speaker", speakerType}};
}

/// Where the parts of the legs hang, in the order left front, left rear, right front, right rear.
struct Leg {
  const char *root, *name;
  bool front;
};
constexpr Leg legs[] = {{"2", "LF", true}, {"3", "LR", false}, {"4", "RF", true}, {"5", "RR", false}};

void addAccelerations(RobotDesign& robot) {
  robot.sensors.push_back(sensor("/a1-Sensor:a1", "acceleration_front"));
  robot.sensors.push_back(sensor("/a2-Sensor:a2", "acceleration_right"));
  robot.sensors.push_back(sensor("/a3-Sensor:a3", "acceleration_up"));
}

void addToVector(RobotDesign& robot, const std::vector<std::string>& paths) {
  for (const std::string& path : paths) robot.sensorVector.push_back("PRM:" + path);
}

RobotDesign ers7() {
  RobotDesign robot{"ERS-7", {}, {}, {}, devices(""), {}, 208, 160};
  robot.joints = {joint("/r1/c1-Joint2:11", "NECK_TILT", -75, 0), joint("/r1/c1/c2-Joint2:12", "HEAD_PAN", -88, 88),
                  joint(head + "-Joint2:13", "HEAD_TILT", -15, 45), joint(head + "/c4-Joint2:14", "MOUTH", -55, -3)};
  for (const Leg& leg : legs) {
    const std::string at = std::string("/r") + leg.root, id = std::string("-Joint2:") + leg.root,
                      name = std::string(leg.name) + "_J";
    robot.joints.push_back(joint(at + "/c1" + id + "1", name + "1", leg.front ? -115 : -130, leg.front ? 130 : 115));
    robot.joints.push_back(joint(at + "/c1/c2" + id + "2", name + "2", -10, 88));
    robot.joints.push_back(joint(at + "/c1/c2/c3" + id + "3", name + "3", -25, 122));
    robot.sensors.push_back(sensor(at + "/c1/c2/c3/c4-Sensor:" + leg.root + "4", std::string("paw_") + leg.name));
  }
  robot.joints.push_back(joint("/r6/c1-Joint2:61", "TAIL_TILT", 5, 60));
  robot.joints.push_back(joint("/r6/c2-Joint2:62", "TAIL_PAN", -45, 45));
  robot.joints.push_back(ear(head + "/e5-Joint4:15", "L_EAR_BASE", joint4));
  robot.joints.push_back(ear(head + "/e6-Joint4:16", "R_EAR_BASE", joint4));

  robot.sensors.push_back(sensor(head + "/t1-Sensor:t1", "touch_head"));
  robot.sensors.push_back(sensor("/t2-Sensor:t2", "touch_back_rear"));
  robot.sensors.push_back(sensor("/t3-Sensor:t3", "touch_back_middle"));
  robot.sensors.push_back(sensor("/t4-Sensor:t4", "touch_back_front"));
  robot.sensors.push_back(sensor(head + "/c4/s5-Sensor:s5", "touch_chin"));
  robot.sensors.push_back(sensor("/b1-Sensor:b1", "wireless_switch"));
  robot.sensors.push_back(sensor(head + "/p1-Sensor:p1", "distance_near"));
  robot.sensors.push_back(sensor(head + "/p2-Sensor:p2", "distance_far"));
  robot.sensors.push_back(sensor("/p1-Sensor:p1", "distance_chest"));
  addAccelerations(robot);

  const char* const ofHead[] = {"head_colour", "head_white", "mode_red", "mode_green", "mode_blue", "wireless"};
  for (int i = 0; i < 6; ++i) {
    const std::string id = "l" + std::to_string(i + 1);
    robot.lamps.push_back(lamp(head + "/" + id + "-LED2:" + id, ofHead[i], led2));
  }
  for (int i = 0; i < 14; ++i) {
    const std::string id = std::string("l") + static_cast<char>('a' + i);
    robot.lamps.push_back(lamp(head + "/" + id + "-LED3:" + id, "face_" + std::to_string(i + 1), led3));
  }
  const char* const ofBack[] = {"back_front_colour", "back_front_white", "back_middle_colour",
                                "back_middle_white", "back_rear_colour", "back_rear_white"};
  for (int i = 0; i < 6; ++i) {
    const std::string id = std::string("l") + static_cast<char>('u' + i);
    robot.lamps.push_back(lamp("/" + id + "-LED3:" + id, ofBack[i], led3));
  }

  // From the mouth to the neck, then up each leg from its paw. The manuals do not tell the order; two teams whose
  // programs index the vector do, and agree: Tekkotsu's ERS7Info ("CPC IDs") and rUNSWift 2005 (sensors.h).
  addToVector(robot, {head + "/c4-Joint2:14", head + "/c4/s5-Sensor:s5", head + "-Joint2:13", head + "/t1-Sensor:t1",
                      head + "/p1-Sensor:p1", head + "/p2-Sensor:p2", "/r1/c1/c2-Joint2:12", "/r1/c1-Joint2:11"});
  for (const Leg& leg : legs) {
    const std::string at = std::string("/r") + leg.root, id = leg.root;
    addToVector(robot, {at + "/c1/c2/c3/c4-Sensor:" + id + "4", at + "/c1/c2/c3-Joint2:" + id + "3",
                        at + "/c1/c2-Joint2:" + id + "2", at + "/c1-Joint2:" + id + "1"});
  }
  addToVector(robot, {"/r6/c1-Joint2:61", "/r6/c2-Joint2:62", "/a1-Sensor:a1", "/a2-Sensor:a2", "/a3-Sensor:a3",
                      "/p1-Sensor:p1", "/b1-Sensor:b1", "/t2-Sensor:t2", "/t3-Sensor:t3", "/t4-Sensor:t4"});
  return robot;
}

/// What the ERS-210 and the ERS-220 have in common: neck, legs, acceleration.
RobotDesign beginOf200(const std::string& name, bool mouth) {
  RobotDesign robot{name, {}, {}, {}, devices(head), {}, 176, 144};
  robot.joints = {joint("/r1/c1-Joint2:j1", "NECK_TILT", -82, 43),
                  joint("/r1/c1/c2-Joint2:j2", "HEAD_PAN", -89.6, 89.6),
                  joint(head + "-Joint2:j3", "HEAD_ROLL", -29, 29)};
  if (mouth) robot.joints.push_back(joint(head + "/c4-Joint2:j4", "MOUTH", -47, -3));
  for (const Leg& leg : legs) {
    const std::string at = std::string("/r") + leg.root, of = std::string(leg.name) + "_J";
    robot.joints.push_back(joint(at + "/c1-Joint2:j1", of + "1", -117, 117));
    robot.joints.push_back(joint(at + "/c1/c2-Joint2:j2", of + "2", -11, 89));
    robot.joints.push_back(joint(at + "/c1/c2/c3-Joint2:j3", of + "3", -27, 147));
    robot.sensors.push_back(sensor(at + "/c1/c2/c3/c4-Sensor:s4", std::string("paw_") + leg.name));
  }
  return robot;
}

void addLegsToVector(RobotDesign& robot) {
  for (const Leg& leg : legs) {
    const std::string at = std::string("/r") + leg.root;
    addToVector(robot, {at + "/c1-Joint2:j1", at + "/c1/c2-Joint2:j2", at + "/c1/c2/c3-Joint2:j3",
                        at + "/c1/c2/c3/c4-Sensor:s4"});
  }
}

RobotDesign ers210() {
  RobotDesign robot = beginOf200("ERS-210", true);
  robot.joints.push_back(joint("/r6/c1-Joint2:j1", "TAIL_PAN", -22, 22));
  robot.joints.push_back(joint("/r6/c2-Joint2:j2", "TAIL_TILT", -22, 22));
  robot.joints.push_back(ear(head + "/e1-Joint3:j5", "L_EAR_BASE", joint3));
  robot.joints.push_back(ear(head + "/e2-Joint3:j6", "R_EAR_BASE", joint3));

  robot.sensors.push_back(sensor(head + "/f1-Sensor:f1", "touch_head_back"));
  robot.sensors.push_back(sensor(head + "/f2-Sensor:f2", "touch_head_front"));
  robot.sensors.push_back(sensor(head + "/p1-Sensor:p1", "distance"));
  robot.sensors.push_back(sensor(head + "/c4/s5-Sensor:s5", "touch_chin"));
  robot.sensors.push_back(sensor("/r6/t1-Sensor:t1", "temperature"));
  robot.sensors.push_back(sensor("/r6/s1-Sensor:s1", "touch_back"));
  addAccelerations(robot);

  const char* const ofHead[] = {"eye_left_lower",
                                "eye_left_middle",
                                "eye_left_upper",
                                "eye_right_lower",
                                "eye_right_middle",
                                "eye_right_upper",
                                "mode"};
  for (int i = 0; i < 7; ++i) {
    const std::string id = "l" + std::to_string(i + 1);
    robot.lamps.push_back(lamp(head + "/" + id + "-LED2:" + id, ofHead[i], led2));
  }
  robot.lamps.push_back(lamp("/r6/l1-LED2:l1", "tail_blue", led2));
  robot.lamps.push_back(lamp("/r6/l2-LED2:l2", "tail_orange", led2));

  addToVector(robot,
              {"/r1/c1-Joint2:j1", "/r1/c1/c2-Joint2:j2", head + "-Joint2:j3", head + "/f1-Sensor:f1",
               head + "/f2-Sensor:f2", head + "/p1-Sensor:p1", head + "/c4-Joint2:j4", head + "/c4/s5-Sensor:s5"});
  addLegsToVector(robot);
  addToVector(robot, {"/r6/c1-Joint2:j1", "/r6/c2-Joint2:j2", "/r6/t1-Sensor:t1", "/r6/s1-Sensor:s1", "/a1-Sensor:a1",
                      "/a2-Sensor:a2", "/a3-Sensor:a3"});
  return robot;
}

RobotDesign ers220() {
  RobotDesign robot = beginOf200("ERS-220", false);
  robot.sensors.push_back(sensor(head + "/p1-Sensor:p1", "distance"));
  robot.sensors.push_back(sensor(head + "/f1-Sensor:f1", "head_lever_1"));
  robot.sensors.push_back(sensor(head + "/f2-Sensor:f2", "head_lever_2"));
  robot.sensors.push_back(sensor(head + "/c4/s5-Sensor:s5", "touch_face"));
  robot.sensors.push_back(sensor("/r6/t1-Sensor:t1", "temperature"));
  robot.sensors.push_back(sensor("/r6/s1-Sensor:s1", "touch_back"));
  robot.sensors.push_back(sensor("/r6/s2-Sensor:s2", "touch_tail_left"));
  robot.sensors.push_back(sensor("/r6/s3-Sensor:s3", "touch_tail_centre"));
  robot.sensors.push_back(sensor("/r6/s4-Sensor:s4", "touch_tail_right"));
  addAccelerations(robot);

  const char* const ofHead[] = {"face_left_front",   "face_left_centre", "face_left_back", "face_right_front",
                                "face_right_centre", "face_right_back",  "mode",           "head_front_b",
                                "head_front_a",      "head_front_c",     "head_light"};
  const char* const ids[] = {"l1", "l2", "l3", "l4", "l5", "l6", "l7", "l8", "l9", "la", "lb"};
  for (int i = 0; i < 11; ++i) robot.lamps.push_back(lamp(head + "/" + ids[i] + "-LED2:" + ids[i], ofHead[i], led2));
  const char* const ofTail[] = {"back_1", "back_2",      "back_3",     "back_4",   "back_5",
                                "back_6", "tail_centre", "tail_right", "tail_left"};
  for (int i = 0; i < 9; ++i)
    robot.lamps.push_back(lamp(std::string("/r6/") + ids[i] + "-LED2:" + ids[i], ofTail[i], led2));

  addToVector(robot, {"/r1/c1-Joint2:j1", "/r1/c1/c2-Joint2:j2", head + "-Joint2:j3", head + "/p1-Sensor:p1",
                      head + "/f1-Sensor:f1", head + "/f2-Sensor:f2", head + "/c4/s5-Sensor:s5"});
  addLegsToVector(robot);
  addToVector(robot, {"/r6/t1-Sensor:t1", "/r6/s1-Sensor:s1", "/r6/s2-Sensor:s2", "/r6/s3-Sensor:s3",
                      "/r6/s4-Sensor:s4", "/a1-Sensor:a1", "/a2-Sensor:a2", "/a3-Sensor:a3"});
  return robot;
}

const std::array<RobotDesign, 3>& designs() {
  static const std::array<RobotDesign, 3> all = {ers7(), ers210(), ers220()};
  return all;
}

}  // namespace

const RobotDesign& robotDesign(const std::string& name) {
  for (const RobotDesign& design : designs())
    if (design.name == name) return design;
  throw InputError("robot design", "\"" + name + "\"", "ERS-7, ERS-210 or ERS-220");
}

std::vector<std::string> robotsWith(const std::string& locator) {
  std::vector<std::string> names;
  for (const RobotDesign& design : designs())
    for (const auto* list : {&design.joints, &design.sensors, &design.lamps, &design.others})
      if (std::any_of(list->begin(), list->end(), [&](const Primitive& each) { return each.locator == locator; }))
        names.push_back(design.name);
  return names;
}

}  // namespace btr::openr
