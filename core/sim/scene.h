#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/model/robot_model.h"
#include "core/sim/effect.h"
#include "core/spec/scene_spec.h"
#include "core/spec/simulator_spec.h"

namespace btr {

/// How one joint is driven, all numbers known. SI units.
struct Drive {
  /// torque also means force on a slide joint. motion: the joint is where its command says at the end of each
  /// World::advance, whatever torque that takes; the drive's torque says how much.
  enum class Kind { servo, dcMotor, torque, motion, none };
  Kind kind = Kind::servo;
  double p = 0, i = 0, d = 0;  ///< servo: torque = p·(command − q) + i·∫ − d·q̇, clamped to ±maxTorque
  double maxTorque = 1e9;
  double noLoadSpeed_rad_s =
      0;  ///< servo: rate (m/s on a slide joint) at which its torque ends, see drive_law.h; 0: none
  double firmwareGain_v_rad = 0;  ///< DC motor: volts per rad of error at supply_v, that is gain/supply_v in duty;
                                  ///< the duty is clamped to ±maxDuty and applied to the supply of the moment
  double supply_v = 0, torqueConstant_nm_a = 0, resistance_ohm = 1, maxDuty = 1;
  double offBraking = 0;          ///< DC motor, switched off: share of its own voltage's braking, 0 open … 1 shorted
  double rotorInertia_kg_m2 = 0;  ///< at the joint, behind the gear
  double coulombFriction = 0;     ///< N·m or N
  double viscousFriction = 0;     ///< N·m·s/rad or N·s/m
  double gearCompliance = 0;      ///< of a spring between rotor and joint [rad/(N·m) or m/N], 0 rigid; effects set it
  double gearDamping = 0;         ///< beside that spring [N·m·s/rad or N·s/m]
  double gearPlay = 0;            ///< width of a gap between rotor and joint [rad or m]; effects set it
  double gearDrag = 0;            ///< of the rotor while it crosses that gap [N·m·s/rad or N·s/m]
  bool loopAtMotor = false;       ///< behind such a gear: its law follows the rotor, not the joint
  bool recordedAtMotor = false;   ///< behind such a gear: what is measured is the rotor

  /// The rotor moves on its own.
  bool hasGear() const { return gearCompliance > 0 || gearPlay > 0; }
};

struct SceneRobot {
  std::string name;
  RobotModel model;  ///< masses already scaled
  bool freeBase = true;
  Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  Eigen::Vector3d startVelocity_m_s = Eigen::Vector3d::Zero();  ///< of the root frame's origin, world axes; free base
  Eigen::Vector3d startSpin_rad_s = Eigen::Vector3d::Zero();    ///< world axes
  std::vector<double> jointStart;                               ///< by joint of the model
  std::vector<double> jointStartRate;                           ///< by joint of the model, rad/s or m/s
  std::vector<Drive> drives;                                    ///< by joint of the model; fixed joints: Kind::none
  std::string collision = "primitives";
  bool mergeFixed = true;
};

struct SceneEffect {
  std::shared_ptr<const Effect> effect;
  std::string name, at;
  std::vector<double> values;  ///< in the order of effect->parameters()
};

/// The world before anything happens, every number resolved: what one trial starts from. A value; copying it is cheap
/// beside a trial.
struct Scene {
  Eigen::Vector3d gravity_m_s2{0, 0, -9.81};
  double step_s = 0.001;
  double controlPeriod_s = 0.008;
  int nearSubsteps = 1;  ///< each step is divided by this while a robot is within reach of a ball
  std::optional<FloorSpec> floor;
  std::vector<SceneRobot> robots;
  std::vector<BallSpec> balls;
  std::vector<ObstacleSpec> obstacles;
  bool robotsCollide = false;  ///< with each other
  SlidingFriction slidingFriction = SlidingFriction::box;
  std::vector<SceneEffect> effects;
};

/// Robot models by the path that the scene names, loaded once and shared, with the hulls of the meshes that collide.
using ModelSet = std::map<std::string, std::shared_ptr<const RobotModel>>;
/// Those of `known`, of a scene in the same folder, are not read again.
ModelSet loadModels(const SceneSpec& spec, const ModelSet& known = {});

/// Gives the effect plugin of that name or throws InputError; the plugin host's effect() fits.
using EffectFactory = std::function<std::shared_ptr<const Effect>(const std::string&)>;

/// Scene file + models + simulator version → the numbers. Applies mass groups, servo scaling, paths and effects in this
/// order. Throws InputError for a path or place that the scene does not have.
Scene makeScene(const SceneSpec& spec, const ModelSet& models, const SimulatorSpec& simulator,
                const EffectFactory& effects);

}  // namespace btr
