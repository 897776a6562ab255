#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/sim/contact/contact_force.h"
#include "core/sim/effect.h"
#include "core/sim/readings.h"
#include "core/sim/scene.h"
#include "core/sim/trace.h"
#include "core/sim/world/world_memory.h"

namespace btr {

/// Where an obstacle's frame (its middle) is and how it moves; of one that never moves only the pose counts.
struct ObstacleState {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero(), spin_rad_s = Eigen::Vector3d::Zero();
};

/// A spring that pulls a point of a body towards a place, as a hand would: F = k·(target − point) − d·velocity, at most
/// `most_n`, with d critical for the body's mass m; k at most m/(4h²) and d at most m/(4h), which a step h bears.
struct Pull {
  enum class What { link, ball, obstacle };
  What what = What::ball;
  std::size_t object = 0, link = 0;                   ///< robot and its link, ball or obstacle
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();  ///< in the frame of the link, ball or obstacle
  Eigen::Vector3d target_m = Eigen::Vector3d::Zero();
  double stiffness_n_m = 100, most_n = 20;
};

/// Two objects, one inside the other, by name; a robot or ball in the floor has no second one.
struct Overlap {
  std::string first, second;
  double depth_m = 0;
  std::string text() const;  ///< a sentence for people, without a full stop
};

/// One ODE world. ODE keeps process-wide state (its random numbers), so only one World may exist in a process at a time
/// (checked), and it belongs to one thread. A robot whose base is fixed and that can touch nothing moves beside ODE, in
/// joint coordinates (JointSpace). Frames: x forward, y left, z up.
class World {
 public:
  /// Builds all bodies at their starting poses. The same scene and seed give the same bits.
  World(const Scene& scene, std::uint64_t seed);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  double time() const;
  /// Before the first step: the time at which it begins. What depends on time goes on in a window as in the trial.
  void startAt(double time_s);
  /// Puts joints of a robot at positions and rates (by joint of the model) and its root frame at a pose with a
  /// velocity.
  void setRobot(std::size_t robot, const Eigen::Isometry3d& base, const Eigen::Vector3d& velocity,
                const Eigen::Vector3d& spin, std::span<const double> positions, std::span<const double> rates);
  /// The same without forgetting: what effects, elastic gears and integrators remember of the steps before stays.
  /// `positions` are what the sensors shall say: a joint stays as far from its sensor's reading as it is.
  void moveRobot(std::size_t robot, const Eigen::Isometry3d& base, const Eigen::Vector3d& velocity,
                 const Eigen::Vector3d& spin, std::span<const double> positions, std::span<const double> rates);
  /// Takes it that the robot's joints have rested where they are, each servo holding the weight that its joint carries:
  /// teeth lie on the flank that they push, elastic gears are wound up. (setRobot leaves gaps in their middle and gears
  /// slack.)
  void rest(std::size_t robot);
  void setBall(std::size_t ball, const BallState& state);
  void setObstacle(std::size_t obstacle, const ObstacleState& state);

  /// From now on these pull, and no others.
  void setPulls(std::vector<Pull> pulls);
  /// The mean force of one of them over the last step [N], world axes.
  Eigen::Vector3d pullForce_n(std::size_t pull) const;

  /// See WorldMemory. Belongs between two calls of advance().
  enum class Detail { forFiles, everything };  ///< everything: attitudes, too
  WorldMemory memory(Detail detail = Detail::forFiles) const;
  /// Takes over what is remembered of the objects with the same names (and, of robots, with as many bodies and joints);
  /// others stay as they are. Only a world that was just built goes on with the bits that another one has, which got
  /// the same. Throws std::logic_error where a robot of the same name is another one.
  void remember(const WorldMemory& memory);

  /// Advances by `duration` with inputs held: inputs[robot][joint of the model]. A whole number of the scene's steps is
  /// taken in exactly these; any other duration (recordings are sampled when they are) in equal, slightly smaller
  /// steps.
  void advance(const std::vector<std::vector<JointInput>>& inputs, double duration);

  RobotReadings robot(std::size_t index) const;
  /// The same into readings whose room is used again: of the same robot, nothing is allocated.
  void read(std::size_t index, RobotReadings& readings) const;
  /// Where its joints are, by joint of the model [rad, m]: not what its sensors say.
  std::vector<double> jointPositions(std::size_t robot) const;
  BallState ball(std::size_t index) const;
  Eigen::Isometry3d ballPose(std::size_t index) const;
  const ObstacleState& obstacle(std::size_t index) const;
  /// Poses of all links of a robot in the world.
  std::vector<Eigen::Isometry3d> linkPoses(std::size_t robot) const;
  /// How far a ray sees, at most `farthest_m`: obstacles, balls, the floor and all robots but one. `direction` is a
  /// unit vector; a ray that begins within something sees nothing of the world: 0.
  double rayDistance_m(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double farthest_m,
                       std::size_t robotLeftOut) const;
  /// What is at least so deep inside something else that the next steps would throw them apart. Walls may stand in one
  /// another and in the floor.
  std::vector<Overlap> overlaps(double least_m) const;
  /// True if no robot can reach a ball in the next `horizon_s`: the balls roll away under nothing but friction and
  /// their uniform deceleration, and for every part of a robot that would need more than its present speed and another
  /// 0.5 m/s, towards the ball, all the time. False wherever more than that is to be weighed (obstacles, hands, forces
  /// on balls, fixed robots, several balls).
  bool ballsOutrun(double horizon_s) const;
  /// From now on no robot is simulated: all stay where they are and touch nothing. The balls go on with the bits that
  /// they would have had as long as no robot came near.
  void stopRobots();
  /// True while any link of any robot touches the ball.
  bool ballTouched(std::size_t index) const;
  /// Kinetic plus gravitational energy of everything [J]; gravitational zero at the world's origin.
  double energy() const;

  /// From now on the robot's root frame is its accelerometer, if its model has none.
  void measureAcceleration(std::size_t robot);
  /// From now on the forces of contacts are kept, or no longer (the steps cost a little more; no bit changes).
  void measureForces(bool on = true);
  /// Of the last step; empty unless they are measured.
  const std::vector<ContactForce>& contactForces() const;
  /// Sum of all forces of the floor on robots and balls in the last step [N]; zero unless they are measured.
  Eigen::Vector3d floorForce_n() const;

  /// Empty while the state is finite, slower than 50 m/s and 500 rad/s, and within 100 m; else what went wrong.
  std::string fault() const;

  /// Column names of a Trace row, and one row of them.
  std::vector<std::string> channels() const;
  void sample(std::vector<double>& row) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr
