#pragma once
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace btr {

/// Mass properties of a link. The inertia is about the centre of mass, in the axes of the link's frame [kg·m²].
struct Inertial {
  double mass_kg = 0;
  Eigen::Vector3d centreOfMass_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();
};

/// Triangles, in metres.
struct Surface {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<Eigen::Vector3f> normals;       ///< one a vertex, or empty
};

struct Hull;

/// One piece of a link's body, drawn and/or collided. Cheap to copy: surfaces are shared.
struct Shape {
  enum class Kind { box, sphere, cylinder, capsule, mesh };
  Kind kind = Kind::box;
  Eigen::Isometry3d pose =
      Eigen::Isometry3d::Identity();  ///< in the link's frame; cylinder and capsule lie along their own y axis (VRML)
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< box: edges; sphere: x = radius; cylinder, capsule: x = radius,
                                                     ///< y = height, the capsule's without its two half spheres
  std::shared_ptr<const Surface> surface;            ///< of a mesh, in the shape's frame; null for all others
  std::shared_ptr<const Hull> hull;                  ///< of a colliding mesh, once loadModels() has made it
  std::array<float, 4> colour{0.8f, 0.8f, 0.8f, 1.f};  ///< red, green, blue, opacity, 0…1
  bool collides = true;                                ///< see RobotModel::meshesReplacePrimitives
  bool drawn = true;
  std::string part;  ///< word for switching variants: "", "red", "blue" (jackets)
};

struct Link {
  std::string name;
  Inertial inertial;
  std::vector<Shape> shapes;
  /// Which of the simulator's mass parameters scales it: "head", "neck", "body", "leg:LF" … or "". All links with the
  /// same text are scaled together so that their sum is the parameter.
  std::string massGroup;
  int line = 0;  ///< in the file, for messages
};

/// Numbers of a joint's servo and transmission that the file gave, or that chooseServosByLoad() chose. Names and units
/// as in the VRML extension.
struct ServoData {
  std::optional<double> p_nm_rad, i_nm_rad_s, d_nm_s_rad, maxTorque_nm, noLoadSpeed_rad_s;
  std::optional<double> coulombFriction_nm, viscousFriction_nm_s_rad, backlash_rad, commandDelay_s;
  std::optional<double> gearRatio, rotorInertia_kg_m2;  ///< rotor inertia before the gear
};

/// A joint that another one drives through a gear or a linkage: position = multiplier · the leader's + offset.
struct Mimic {
  int leader = 0;         ///< index of a moving joint that follows none
  double multiplier = 1;  ///< rad/rad, m/m, rad/m or m/rad
  double offset = 0;      ///< rad or m
};

struct Joint {
  enum class Type { rotate, slide, fixed };
  std::string name;
  int id = -1;  ///< jointId, −1 none
  Type type = Type::rotate;
  int parentLink = 0;  ///< index; always smaller than the child's
  Eigen::Isometry3d origin =
      Eigen::Isometry3d::Identity();  ///< the joint's frame (= the child link's at position 0) in the parent link's
  Eigen::Vector3d axis =
      Eigen::Vector3d::UnitZ();      ///< unit, in the joint's frame; positions follow the right-hand rule
  double lower = -1e9, upper = 1e9;  ///< rad or m
  double speedLimit = 0;             ///< rad/s or m/s, 0 none given
  ServoData servo;
  std::optional<Mimic> mimic;  ///< it has no drive of its own then
  std::string primitive;       ///< the OPEN-R name, if any
  int line = 0;
};

/// The largest torque [N·m] or force [N] of a servo whose file gives none and whose load it can hold: that of the
/// ERS-7's legs, 10 N on a slide joint. For others see chooseServosByLoad().
inline double defaultServoLimit(Joint::Type type) { return type == Joint::Type::slide ? 10 : 0.85; }

struct Sensor {
  enum class Kind { accelerometer, gyro, force, pressure, vision, range };
  std::string name;
  Kind kind = Kind::accelerometer;
  int link = 0;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< in the link's frame
  int width = 0, height = 0;                               ///< vision [pixels]; it looks along its own -z, +y up
  double fieldOfView_rad = 0;                              ///< of the shorter side, as VRML's Viewpoint
};

/// What a reader had to leave out or to assume.
struct Warning {
  /// What the robot's motion loses by it: nothing, a shape that collides with nothing, a joint without limits or with
  /// other ones than the file's, a torque limit that was assumed, an inertia that no real body has.
  enum class Loss { none, collision, limits, effort, inertia };
  int line = 0;
  std::string text;
  Loss loss = Loss::none;
  std::string at{};  ///< the link or joint that loses it
};

/// A robot as a tree of rigid links, however it was written down. links[0] is the root; joints[i] moves links[i + 1],
/// so parents come before their children. A plain value: copy it, change its masses, hand it on.
struct RobotModel {
  std::string name;
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Sensor> sensors;
  std::vector<Warning> warnings;
  bool freeBase = true;  ///< what the file says of its root
  /// True where a link's colliding meshes are another form of its primitives, of which a scene takes one (VRML); false
  /// where all of its colliding shapes belong to it (URDF).
  bool meshesReplacePrimitives = true;

  int findLink(const std::string& name) const;   ///< index or −1
  int findJoint(const std::string& name) const;  ///< index or −1
};

}  // namespace btr
