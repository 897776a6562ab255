#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace btr::openr {

/// What a program can open on a robot: a joint, a sensor, a lamp, the camera, the microphone or the speaker.
struct Primitive {
  enum class Kind : std::uint8_t { joint, ear, sensor, lamp, camera, microphone, speaker };
  Kind kind = Kind::sensor;
  std::string locator;  ///< "PRM:/r1/c1-Joint2:11"
  std::string
      name;  ///< what it is to us: the joint's name in the robot's model, a sensor's ("acceleration_x"), a lamp's
  int openrType = 0;               ///< OPrimitiveType: oprimitiveJOINT2 11 …
  std::int32_t low = 0, high = 0;  ///< joints: range [µrad]
};

/// A robot of Sony's as programs know it. Joints with ears, sensors and lamps stand in the order of their kind's places
/// in robot_link.h.
struct RobotDesign {
  std::string name;  ///< "ERS-7", "ERS-210", "ERS-220"
  std::vector<Primitive> joints, sensors, lamps, others;
  /// Locators of the joints and sensors that a sensor vector tells of, in its order.
  std::vector<std::string> sensorVector;
  std::uint16_t imageWidth = 0, imageHeight = 0;  ///< of layer H
};

/// Throws InputError for another name.
const RobotDesign& robotDesign(const std::string& name);
/// The names of the robots that have a primitive at `locator`.
std::vector<std::string> robotsWith(const std::string& locator);

}  // namespace btr::openr
