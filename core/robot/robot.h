#pragma once
// The one header of a robot's controller that senses and acts. It is written once and built twice: as a plugin, which
// moves the robot within the simulator's process, and as a program of its own, which does over the open interface. Both
// get the same numbers and give the same bits.
//
// SI units; angles in rad. A robot's frame: x forward, y left, z up. "By joint" is in the order of Robot::model.joints,
// where a fixed joint has a place that nobody reads.
#include <array>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/plugin/plugin.h"

namespace uchilsim {

using btr::InputError;
using btr::Parameter;
using btr::Random;
using btr::SenseSpec;
using btr::Values;
using Picture = btr::CameraPicture;

/// The robot that is moved. Belongs to the caller: copy what is needed later.
struct Robot {
  const std::string& name;        ///< in its scene
  const btr::RobotModel& model;   ///< links, joints, their limits and places; as a program has it, without its meshes
  std::span<const double> start;  ///< by joint, where it begins [rad, m]
  double period_s = 0;            ///< a control period: act() is asked once in each
  /// Place of the joint of that name. Throws InputError if there is none that moves.
  std::size_t joint(const std::string& joint) const;
};

/// What the robot knows as a control period begins. Only the senses that it has are there: those that its behaviour
/// asks for, and those that its game gives it.
struct Senses {
  double time_s = 0;  ///< since the behaviour began
  double period_s = 0;
  std::span<const double> position;  ///< by joint [rad, m]; what the sense "joints" says where the robot has it
  std::span<const double> velocity;  ///< by joint [rad/s, m/s]
  std::span<const double> effort;    ///< by joint, of its drive [N·m, N]
  std::optional<Eigen::Vector3d> acceleration_m_s2;  ///< specific force in the accelerometer's axes: at rest z is +9.81
  struct Infrared {
    std::optional<double> near_m, far_m, chest_m, head_m;
  } infrared;  ///< distances of what it looks at
  std::optional<std::array<bool, 4>>
      paws;  ///< on the ground or on something: left and right front, left and right rear
  struct Touch {
    bool head = false, chin = false, back = false;
  };
  std::optional<Touch> touch;        ///< where a hand is
  const Picture* picture = nullptr;  ///< the frame that the camera has just finished, if it has; valid for the call

  std::uint64_t seed = 0;  ///< of the game or trial
  long period = 0;         ///< control periods since that began
  /// Random numbers of this period: a function of seed and period, whatever was drawn before.
  Random random() const { return Random::forPurpose(seed, "behaviour", static_cast<std::uint64_t>(period)); }
};

/// What joints and lamps are told. It keeps what was said: act() changes what shall be different.
struct Orders {
  std::vector<double> targets;  ///< by joint [rad, m; of a joint driven by torque N·m, N]
  struct Gains {
    double p = 1, i = 1, d = 1;  ///< times those of the robot's servo
  };
  std::vector<Gains> gains;             ///< by joint
  std::vector<char> enabled;            ///< by joint; 0: limp
  std::map<std::string, double> lamps;  ///< by name, brightness 0 … 1; dark where it is not named
};

/// How a robot behaves. One object moves one robot once; a fresh one says what it needs.
class Behaviour {
 public:
  virtual ~Behaviour() = default;
  /// What may evolve or be set while it runs, in the order in which start() gets it.
  virtual std::vector<Parameter> parameters() const { return {}; }
  /// What a user fixes for an experiment or a game: the task, timings.
  virtual std::vector<Parameter> settings() const { return {}; }
  /// What it must sense: {{"infrared_near"}, {"touch"}}; see manual/formats/game.md for the names.
  virtual std::vector<SenseSpec> senses() const { return {}; }
  /// It looks through the robot's camera. There are no pictures in trials.
  virtual bool looks() const { return false; }
  /// The posture in which it begins, by joint; the robot stands on its feet in it. Empty: a four-legged robot in a
  /// stance, another one as its scene says. Throws InputError for a robot that it cannot move.
  virtual std::vector<double> posture(const btr::RobotModel& /*model*/) const { return {}; }
  /// Of a trial: where its task puts other things, the ball say. The robot stands over the origin and looks along x.
  virtual void setTask(btr::Scene& /*scene*/, const Values& /*settings*/) const {}

  /// Comes once, before anything else. `settings` may leave some out, which have their defaults; `parameters` has all.
  virtual void start(const Robot& robot, const Values& settings, std::span<const double> parameters) = 0;
  /// What is ordered for the period that begins. What it throws ends the trial or the game with that text.
  virtual void act(const Senses& senses, Orders& orders) = 0;
  /// Time at which it is over, its last orders hold then [s]. Trials need an end.
  virtual double duration_s() const { return std::numeric_limits<double>::infinity(); }
  /// What a fitness or a person should know of it afterwards.
  virtual Values remarks() const { return {}; }
  /// Where something reaches into a game (an object comes, a parameter changes) a new object goes on at the same time.
  /// A behaviour that has to know of before writes it down here and gets it after start().
  virtual std::vector<double> memory() const { return {}; }
  virtual void remember(std::span<const double> /*memory*/) {}
};

using MakeBehaviour = std::function<std::unique_ptr<Behaviour>()>;

/// A behaviour as plugins have it.
class BehaviourController : public btr::Controller {
 public:
  BehaviourController(std::string name, MakeBehaviour make) : name_(std::move(name)), make_(std::move(make)) {}
  std::vector<Parameter> genotype() const override { return make_()->parameters(); }
  std::vector<Parameter> settings() const override { return make_()->settings(); }
  std::vector<SenseSpec> senses() const override { return make_()->senses(); }
  bool looks() const override { return make_()->looks(); }
  void arrange(btr::Scene& scene, const Values& settings) const override;
  std::unique_ptr<btr::Motion> begin(const btr::Scene& scene, const Values& settings,
                                     std::span<const double> parameters) const override;
  const std::string& name() const { return name_; }
  /// See Behaviour::posture().
  std::vector<double> posture(const btr::RobotModel& model) const { return make_()->posture(model); }

 private:
  std::string name_;
  MakeBehaviour make_;
};

/// The behaviour as a program: connects to a server, moves a robot of one of its worlds, and says what to exit with.
/// `--help` says how.
int runProgram(int argc, char** argv, const BehaviourController& controller);

}  // namespace uchilsim

/// UCHILSIM_ROBOT_CONTROLLER(Stroll, "stroll") at the end of a file makes the behaviour known: as a plugin or, where
/// UCHILSIM_PROGRAM is defined, as a program (uchilsim_add_controller makes both). After the name may follow who made
/// it: .version = "1.2", .author = "J. Doe", .licence = "MIT".
#define UCHILSIM_BEHAVIOUR_(Class, plainName)                                                           \
  namespace {                                                                                           \
  struct BehaviourOfThisFile final : uchilsim::BehaviourController {                                    \
    BehaviourOfThisFile() : BehaviourController(plainName, [] { return std::make_unique<Class>(); }) {} \
  };                                                                                                    \
  }
#ifdef UCHILSIM_PROGRAM
#define UCHILSIM_ROBOT_CONTROLLER(Class, plainName, ...) \
  UCHILSIM_BEHAVIOUR_(Class, plainName)                  \
  int main(int argc, char** argv) { return uchilsim::runProgram(argc, argv, BehaviourOfThisFile()); }
#else
#define UCHILSIM_ROBOT_CONTROLLER(Class, plainName, ...) \
  UCHILSIM_BEHAVIOUR_(Class, plainName)                  \
  BTR_CONTROLLER(BehaviourOfThisFile, plainName __VA_OPT__(, ) __VA_ARGS__)
#endif
