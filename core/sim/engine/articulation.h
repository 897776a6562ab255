#pragma once
#include <ode/ode.h>

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "core/sim/contact/collision.h"
#include "core/sim/scene.h"
#include "core/sim/world/world_memory.h"

namespace btr {

/// A joint's stop is a spring and a critical damper for the inertia it holds, this fast:
inline constexpr double stopFrequency_rad_s = 300;

/// A rigid body of a robot: the links that fixed joints hold together. Its frame has the first link's axes and the
/// centre of mass as origin. Body −1 of a joint is the world (a robot whose base is fixed).
struct RobotBody {
  dBodyID id = nullptr;
  int firstLink = 0;
  int carrier = -1;  ///< the body at which it hangs; it comes before this one
  double mass_kg = 0;
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< of mass, in the first link's frame
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero(),
                  spin_rad_s = Eigen::Vector3d::Zero();  ///< of the centre of mass; world axes
  std::vector<Collider> colliders;
  double reach_m = 0;  ///< radius about the centre of mass that holds all colliders

  /// Inertia of a hip's turning part about its first axis, which only this body carries; see Articulation.
  double ringInertia_kg_m2 = 0;
  int ringJoint = -1;                                   ///< index of the hip's first joint
  Eigen::Vector3d ringAxis = Eigen::Vector3d::UnitX();  ///< first axis in this body's frame now
};

/// One degree of freedom of a robot. q = atan2(w·x, u·x) with x attached to one body and u, w to the other.
struct RobotJoint {
  int modelJoint = 0;
  bool slides = false;
  int child = 0, parent = -1;  ///< bodies that the drive acts between
  dJointID id = nullptr;       ///< hinge, slider, or the universal joint that two degrees of freedom share
  int group = 0;               ///< 0 or dParamGroup2: which of the joint's two axes
  dJointID extra = nullptr;    ///< rows for dry friction and for passive terms beside a saturated servo
  std::optional<ExtraRowsMemory> extraMade{};  ///< how, once there are any
  Eigen::Vector3d axisInParent = Eigen::Vector3d::UnitZ(), axisInChild = Eigen::Vector3d::UnitZ();
  bool axisFollowsChild = false;  ///< second axis of a universal joint
  Eigen::Vector3d anchorInParent = Eigen::Vector3d::Zero(), anchorInChild = Eigen::Vector3d::Zero();
  Eigen::Vector3d u, w, x;  ///< u, w in the parent's frame and x in the child's; axisFollowsChild: the reverse
  double lowStop = -1e9, highStop = 1e9, heldInertia = 0;
  int leader = -1;  ///< joint that it follows: position = multiplier·leader's + offset, rate = multiplier·leader's
  double multiplier = 1, offset = 0;
  double position = 0, rate = 0;
  double solvedRate = 0;  ///< rate about the axis at the beginning of the last step: the one that ODE's rows made
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< in the world, now
};

/// The bodies and joints of one robot in ODE. A chain of two rotary joints whose axes cross at a right angle becomes
/// one universal joint where the part between them (the hip's rotor) is round about the first axis and has its centre
/// of mass on it. That part then needs no body: its mass and its inertia across the axis do not notice the first joint
/// and go to the parent; its inertia about the first axis turns with the child (the child's spin about the first axis
/// IS the part's), and is added to the child's tensor along that axis. Kinetic energy is exactly that of three bodies.
class Articulation {
 public:
  /// Creates bodies and joints in the world at the robot's start.
  Articulation(dWorldID world, const SceneRobot& robot);

  std::vector<RobotBody> bodies;
  std::vector<RobotJoint> joints;       ///< the moving ones
  std::vector<Collider> baseColliders;  ///< of a fixed base, in its root link's frame
  std::vector<int> jointOfModel;        ///< by joint of the model: index in `joints` or −1 (fixed)

  bool fixedBase() const { return !robot_.freeBase; }
  /// False if JointSpace moves the robot: its bodies are in ODE then only to be read and placed.
  bool movesInOde() const { return movesInOde_; }
  /// `positions` and `rates` by joint of the model; those of joints that follow another one are computed instead.
  void set(const Eigen::Isometry3d& base, const Eigen::Vector3d& velocity, const Eigen::Vector3d& spin,
           std::span<const double> positions, std::span<const double> rates);
  /// Puts each body where it was, joints that may have turned round included. `ringAxes` by body.
  void remember(const std::vector<BodyMemory>& memory, const std::vector<Eigen::Vector3d>& ringAxes);
  /// Reads poses, velocities, joint positions and rates from ODE.
  void refresh();
  void addTorque(const RobotJoint& joint, double torque);
  /// Moves all bodies by the same way.
  void shift(const Eigen::Vector3d& way);
  /// Turns the ring inertias with their joints.
  void updateRings();
  /// Moments that come with them, since such a part spins with the child but its axis turns with the parent (s =
  /// axis·spin of the child, I its inertia about the axis): −I·s·(Ω×axis) on the parent of spin Ω; on the child what
  /// undoes ODE's own gyroscopic moment of the part, and −I·((Ω×axis)·spin)·axis.
  void addRingTorques();
  /// Makes the joint's extra rows: axis 0 dry friction, axis 1 passive terms.
  void makeExtraRows(RobotJoint& joint);
  /// The same as they were made in another world.
  void remakeExtraRows(RobotJoint& joint, const ExtraRowsMemory& memory);

  Eigen::Isometry3d base() const;
  std::vector<Eigen::Isometry3d> linkPoses() const;
  Eigen::Isometry3d linkPose(int link) const;
  Eigen::Vector3d pointVelocity(int link, const Eigen::Vector3d& world) const;
  const Eigen::Isometry3d& poseOf(int body) const { return body < 0 ? basePose_ : bodies[body].pose; }
  Eigen::Matrix3d rotationOf(int body) const { return poseOf(body).linear(); }
  dBodyID idOf(int body) const { return body < 0 ? nullptr : bodies[body].id; }
  int bodyOfLink(int link) const { return bodyOfLink_[link]; }

 private:
  struct LinkState {
    Eigen::Isometry3d pose;
    Eigen::Vector3d velocity, spin;
  };
  void groupLinks();
  void findUniversals();
  void makeBodies();
  void makeColliders();
  void makeJoints();
  void placeBodies(const std::vector<LinkState>& links);
  std::vector<LinkState> kinematics(const Eigen::Isometry3d& base, const Eigen::Vector3d& velocity,
                                    const Eigen::Vector3d& spin, std::span<const double> positions,
                                    std::span<const double> rates) const;
  Inertial groupInertial(int group) const;
  void makeUniversal(int first, int second, const std::vector<LinkState>& zero);
  void makeSingle(int modelJoint, const std::vector<LinkState>& zero);
  void finishJoint(RobotJoint& joint, const std::vector<LinkState>& zero);
  void coupleJoints();
  void aimJoints(const Eigen::Isometry3d& base);
  double inertiaHeldBy(const RobotJoint& joint, const std::vector<LinkState>& zero) const;

  dWorldID world_;
  const SceneRobot& robot_;
  bool movesInOde_;
  Eigen::Isometry3d basePose_ = Eigen::Isometry3d::Identity();  ///< of a fixed base's root link
  std::vector<int> groupOfLink_;                                ///< first link of the rigid group
  std::vector<Eigen::Isometry3d> linkInGroup_;
  std::vector<int> bodyOfLink_;  ///< −1 the fixed base; a swallowed part: its parent's
  std::vector<int> universal_;   ///< by joint of the model: the second joint of its pair, or −1
  std::vector<char> second_;     ///< by joint of the model: it is the second of a pair
};

}  // namespace btr
