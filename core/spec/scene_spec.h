#pragma once
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/spec/parameter.h"

namespace btr {

/// How a joint is driven, as the contract's scene says. Every number is optional: what is absent comes from the model.
struct ServoSpec {
  std::string drive = "servo";  ///< "servo", "dc_motor", "torque", "force", "motion", "none" (a free joint)
  /// p, i, d, max_torque_nm (max_force_n on slide joints), firmware_gain_v_per_rad, voltage_v,
  /// torque_constant_nm_per_a, resistance_ohm, max_duty, rotor_inertia_kg_m2, … : the names in servoNumbers().
  Values numbers;
  bool operator==(const ServoSpec&) const = default;
};

/// One robot of a scene.
struct RobotSpec {
  std::string name;
  std::string model;                          ///< path, relative to the scene file
  std::string base = "free";                  ///< "free" or "fixed"
  std::array<double, 3> position_m{0, 0, 0};  ///< of the root link's frame, world frame (x forward, y left, z up)
  std::array<double, 4> orientation_wxyz{1, 0, 0, 0};
  std::array<double, 3> velocity_m_s{0, 0, 0};  ///< of the root link's frame at the start, world frame; a free base's
  std::array<double, 3> spin_rad_s{0, 0, 0};    ///< about world axes
  std::string collision = "primitives";         ///< "primitives", "mesh" (the simplified meshes) or "none"
  bool mergeFixed = true;                       ///< fixed parts become one body
  std::map<std::string, ServoSpec> servos;      ///< by joint name
  Values jointStart;                            ///< starting positions by joint name [rad or m], default 0
  Values jointRate;                             ///< velocities at the start by joint name [rad/s or m/s], default 0
  std::map<std::string, Values> links;          ///< by link name: mass_kg
  std::map<std::string, Values> joints;         ///< by joint name: coulomb_friction_nm, viscous_friction_nm_s_rad, …
  bool operator==(const RobotSpec&) const = default;
  /// It is in motion at the start.
  bool moves() const;
};

struct BallSpec {
  std::string name;
  double radius_m = 0.0425;
  double mass_kg = 0.055;
  double inertiaFactor = 2.0 / 3.0;     ///< I = factor·m·r²; 2/3 a thin shell, 2/5 a solid ball
  double rollingDeceleration_m_s2 = 0;  ///< of a ball that rolls freely on the floor, 0 none
  double restitution = 0.0;             ///< against robots and floor
  std::array<double, 3> position_m{0, 0, 0.0425};
  std::array<double, 3> velocity_m_s{0, 0, 0};
  std::array<double, 3> spin_rad_s{0, 0, 0};
  /// Rolling deceleration that depends on the direction, xx, xy, yy of a symmetric matrix A added to that above:
  /// v' = −A²·v/|A·v|. Only effects set it.
  std::array<double, 3> directedRolling_m_s2{0, 0, 0};
  bool operator==(const BallSpec&) const = default;
};

/// A solid on the field that belongs to no robot: a wall, a goal post, a box to be pushed.
struct ObstacleSpec {
  /// "box"; "cylinder", upright; "sphere"; "ramp": a wedge that rises along its x from nothing to size_m[2].
  std::string name, shape = "box";
  std::array<double, 3> size_m{0.1, 0.1, 0.1};  ///< box, ramp: edges along x, y, z; cylinder: [2] is its height
  double radius_m = 0.05;                       ///< cylinder, sphere
  double mass_kg = 0;                           ///< uniformly spread; 0: it never moves
  double friction = 0.6;                        ///< against robots, balls and each other; on the floor the smaller one
  double restitution = 0;
  std::array<double, 3> position_m{0, 0, 0};  ///< of its middle (ramp: of the box around it), world frame
  std::array<double, 4> orientation_wxyz{1, 0, 0, 0};
  std::array<double, 3> velocity_m_s{0, 0, 0};
  std::array<double, 3> spin_rad_s{0, 0, 0};
  std::string colour = "#8c8c96";  ///< as it is drawn, #rrggbb
  bool operator==(const ObstacleSpec&) const = default;
};

/// A carpet or a hard floor at z = 0. `slip` is force-dependent slip: sliding speed per tangential force [m/(s·N)],
/// along the floor's x (slip1) and y (slip2). Stiffness and damping are those of the contact normal.
struct FloorSpec {
  double friction = 0.8;
  double restitution = 0;
  double slip1_m_s_n = 0;
  double slip2_m_s_n = 0;
  double stiffness_n_m = 2e4;
  double damping_n_s_m = 100;
  double slipXY_m_s_n = 0;  ///< slip is the matrix (slip1, slipXY; slipXY, slip2); only effects set it
  double bounce = 0;        ///< raises every restitution e on this floor to e + (1 − e)·bounce; only effects set it
  double bounceLoss_s_m = 0;  ///< lowers it with the speed v of the hit to e/(1 + bounceLoss·v); only effects set it
  bool operator==(const FloorSpec&) const = default;
};

/// A number that the user does not trust, by its path in the scene, with the range a fit may search.
struct CalibratePath {
  std::string path;
  double minimum = 0;
  double maximum = 0;
  bool operator==(const CalibratePath&) const = default;
};

/// How friction acts where two surfaces slide on each other
/// without force-dependent slip.
enum class SlidingFriction {
  box,  ///< up to μ·N along the sliding and as much across it, as in ODE: a push aside below μ·N turns no sliding
        ///< body, and both together are up to √2·μ·N. Scenes that do not say otherwise.
  isotropic  ///< Coulomb's: μ·N against the sliding alone, whose direction is free
};
/// The simulated world before anything happens ("format": "uchilsim-scene-1").
struct SceneSpec {
  std::array<double, 3> gravity_m_s2{0, 0, -9.81};
  double step_s = 0.001;  ///< 1e-5 … 0.02, divides control_period_s
  double controlPeriod_s = 0.008;
  std::optional<FloorSpec> floor;
  std::vector<RobotSpec> robots;
  std::vector<BallSpec> balls;
  std::vector<ObstacleSpec> obstacles;
  bool robotsCollide = false;  ///< with each other; with obstacles and balls they always do
  SlidingFriction slidingFriction = SlidingFriction::box;
  std::vector<CalibratePath> calibrate;
  std::string directory;  ///< of the scene file; relative model paths start here
  bool operator==(const SceneSpec&) const = default;
};

/// `place` begins error messages, `directory` is where relative paths start. Unknown keys, wrong types, values out of
/// range and duplicate names throw InputError.
SceneSpec sceneFromJson(const std::string& text, const std::string& place, const std::string& directory);
SceneSpec loadScene(const std::string& path);
std::string toJsonText(const SceneSpec& scene);

/// One of its objects as it stands in a scene file. `place` begins error messages.
RobotSpec robotFromJson(const std::string& text, const std::string& place);
BallSpec ballFromJson(const std::string& text, const std::string& place);
ObstacleSpec obstacleFromJson(const std::string& text, const std::string& place);
std::string toJsonText(const RobotSpec& robot);
std::string toJsonText(const BallSpec& ball);
std::string toJsonText(const ObstacleSpec& obstacle);

/// The numbers that a servo entry may carry, with units and bounds.
const std::vector<Parameter>& servoNumbers();
/// The numbers that a link or joint entry may carry.
const std::vector<Parameter>& linkNumbers();
const std::vector<Parameter>& jointNumbers();

}  // namespace btr
