#pragma once
#include "core/sim/contact/contact_builder.h"
#include "core/sim/contact/solid_contacts.h"
#include "core/sim/drive_law.h"
#include "core/sim/elastic_gear.h"
#include "core/sim/engine/articulation.h"
#include "core/sim/engine/coupled_inertia.h"
#include "core/sim/engine/joint_space.h"
#include "core/sim/engine/ode_session.h"
#include "core/sim/world.h"

namespace btr {

/// One joint's drive while the world runs.
struct JointDrive {
  JointEffects effects;
  double command = 0;                                       ///< that was given
  bool fresh = true;                                        ///< no command has been given yet
  double volts = std::numeric_limits<double>::quiet_NaN();  ///< that a recording gave in the last step
  bool enabled = true;                                      ///< as in the last step
  double integral = 0;                                      ///< ∫(command − q)dt of the servo
  double rate = 0;                                          ///< at the end of the last step
  double rateBefore = 0;                                    ///< of the joint before the last step
  DriveRow row;                                             ///< the drive's part of the last step
  double torque = 0;                                        ///< of the drive in the last step
  double measured = 0;                                      ///< position through the sensor's effects
  bool dryRow = false;                                      ///< the extra row for dry friction is on
  bool passiveRow = false;
  double load = 0;        ///< moment of the carried weight, where effects ask
  double motorAhead = 0;  ///< rotor behind an elastic gear: its angle relative to the joint, and its rate
  double motorRate = 0;
  DriveRow coupling;        ///< of a joint in ODE that follows another one: what made it do so in the last step
  double couplingLoad = 0;  ///< of that, what the leader's inertia does not stand for [N·m or N]
  GearRow gear;             ///< of the last step
};

/// What hangs at a body, itself included.
struct Carried {
  double mass_kg = 0;
  Eigen::Vector3d moment_kg_m = Eigen::Vector3d::Zero();  ///< mass times place
  int by = -1;                                            ///< body that carries it
};

struct WorldRobot {
  const SceneRobot* scene = nullptr;
  std::unique_ptr<Articulation> body;
  std::unique_ptr<JointSpace> alone;  ///< moves it, where ODE does not
  std::vector<JointRows> rows;        ///< of this step, by moving joint; for `alone`
  std::vector<JointDrive> drives;     ///< by moving joint
  std::vector<Carried> carried;       ///< by body, scratch of weighLoads()
  CoupledInertia coupled;             ///< of this step, where a joint follows another one in ODE
  std::vector<char> contact;          ///< by link
  /// By body, colliders as they meet other solids; the last ones are the fixed base's. Empty where there are none.
  std::vector<std::vector<SolidGeom>> solids;
  std::vector<char> placed;  ///< those of a body stand where it is now
  /// A sphere that holds all bodies now, see touchSolids().
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  double reach_m = 0;
  double kick = 1;          ///< share of the step\'s forces: ½ at the first step of a fixed rig, see step()
  bool first = true;        ///< no step since its state was set
  bool touches = false;     ///< anything, in the last step
  bool hasEffects = false;  ///< at any joint
  bool couples = false;     ///< a joint follows another one
  double allDrives = 0;     ///< sum of |torque| of all drives in the last step
  int accelerometerLink = -1;
  bool hasAccelerometer = false;                                    ///< of its model: it has columns in a trace
  Eigen::Isometry3d accelerometer = Eigen::Isometry3d::Identity();  ///< in its link's frame
  Eigen::Vector3d accelerometerVelocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d specificForce_m_s2 = Eigen::Vector3d::Zero();
};

struct WorldBall {
  const BallSpec* spec = nullptr;
  dBodyID id = nullptr;
  dJointID rolling = nullptr;  ///< bounded moment against rolling
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  BallState state;
  bool touched = false;  ///< by a robot or another ball
  std::vector<const SceneEffect*> effects;
};

struct WorldObstacle {
  const ObstacleSpec* spec = nullptr;
  dBodyID id = nullptr;  ///< none: it never moves
  std::unique_ptr<SolidGeom> solid;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< of mass, in its frame
  Eigen::Vector3d half_m = Eigen::Vector3d::Zero();    ///< of a box in the collider's frame that holds it
  ObstacleState state;
  bool touched = false;  ///< in the last step, by anything
};

struct World::Impl {
  Impl(const Scene& givenScene, std::uint64_t seed);

  Scene scene;  ///< a copy: a world outlives what it was made from
  OdeSession session;
  ContactBuilder contacts{session};
  std::vector<WorldRobot> robots;
  std::vector<WorldBall> balls;
  std::vector<WorldObstacle> obstacles;
  std::vector<Pull> pulls;
  std::vector<Eigen::Vector3d> pullForces_n;
  std::vector<ContactPoint> points;  ///< scratch
  ContactSurface robotFloor;         ///< of this step, the floor under robots
  double start_s = 0;                ///< time at which `steps` was zero
  long steps = 0;
  double until = 0;  ///< end of the present advance [s]
  std::string fault;
  bool inOde = true;           ///< something moves in ODE
  bool robotsStopped = false;  ///< see World::stopRobots()

  /// In the order in which they were made in the world that remembers them.
  void remakeExtraRows(const WorldMemory& memory);

  double time() const { return start_s + static_cast<double>(steps) * scene.step_s; }
  JointState stateOf(const WorldRobot& robot, std::size_t joint, double now) const;
  /// As the drive's law sees the joint that is in this state: the rotor's position and rate where its sensor sits
  /// there.
  JointState loopStateOf(const WorldRobot& robot, std::size_t joint, JointState state) const;

  void advance(const std::vector<std::vector<JointInput>>& inputs, double duration);
  void step(const std::vector<std::vector<JointInput>>& inputs, double now, double h);
  void driveRobots(const std::vector<std::vector<JointInput>>& inputs, double now, double h);
  bool takeRobots(double h);
  void placeRobots();
  bool nearBall(const std::vector<std::vector<JointInput>>& inputs, double h) const;
  bool strains(std::size_t robot, const std::vector<JointInput>& inputs) const;

  // world_joints.cpp
  void driveJoint(WorldRobot& robot, std::size_t joint, const JointInput& input, double now, double h);
  void weighLoads(WorldRobot& robot) const;
  void weighOwnLoads(WorldRobot& robot) const;
  void setRows(WorldRobot& robot, std::size_t joint, const JointRows& rows);
  DriveRow followLeader(WorldRobot& robot, std::size_t joint, double h);
  void loadLeaders(WorldRobot& robot, double h) const;
  void leadOthers(DriveRow& passive, const WorldRobot& robot, std::size_t joint, double h) const;
  void addStop(DriveRow& passive, const RobotJoint& joint, double h) const;
  // world_contacts.cpp
  void makeContacts(double h);
  void touchFloor(WorldRobot& robot, RobotBody& body, double h);
  void touchBalls(WorldRobot& robot, const RobotBody* body, double h);
  void touchOthers(std::size_t ball, double h);
  void driveBall(WorldBall& ball, double now, double h);
  void brakeRolling(WorldBall& ball, double h);
  void readBall(WorldBall& ball, double now);
  void bounce(WorldBall& ball, const BallState& before, double h);
  void placeBall(WorldBall& ball, const BallState& state);
  // world_solids.cpp
  void makeObstacles();
  void makeSolids();
  void touchSolids(double h);
  void touchObstacle(std::size_t obstacle, double h);
  void touchRobots(WorldObstacle& obstacle);
  const std::vector<SolidGeom>& solidsOf(WorldRobot& robot, std::size_t body) const;
  void meet(WorldRobot& robot, WorldRobot& other);
  void placeObstacle(WorldObstacle& obstacle, const ObstacleState& state);
  void readObstacle(WorldObstacle& obstacle);
  void settleObstacles(double h);
  // world_stop.cpp
  bool outruns(const WorldBall& ball, const RobotBody& body, double horizon_s) const;
  // world_hands.cpp
  void pullAll(double h);
  // world_sense.cpp
  void sense(WorldRobot& robot, double dt);
  void checkFault();
};

}  // namespace btr
