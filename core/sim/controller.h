#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/sim/readings.h"
#include "core/sim/scene.h"
#include "core/sim/senses.h"

namespace btr {

/// One frame of a robot's camera.
struct CameraPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;        ///< height × width × 3, the upper left pixel first
  std::vector<std::uint8_t> classes{};  ///< height × width: 0 none, else 1 + index into the camera's colour classes;
                                        ///< empty of a camera without
};

/// What a robot senses as a control period begins, beside its drives. Lives until the command() of that period is over.
struct MotionSenses {
  std::uint64_t seed = 0;                   ///< of the trial or game
  long period = 0;                          ///< control periods since it began
  std::span<const std::string> channels{};  ///< "ROBOT.infrared.near_m" …, of the senses that the robot has
  std::span<const double> values{};         ///< by channel
  const CameraPicture* picture = nullptr;   ///< a frame that came to its end in the period before; valid for the call
};

/// One motion of one trial, made by a Controller from a parameter vector.
class Motion {
 public:
  virtual ~Motion() = default;
  /// In games before each command(); in trials if the controller has senses().
  virtual void sense(const MotionSenses& /*now*/) {}
  /// Fills the command of each joint of the robot it drives for the control period that begins at `time` [s]. What it
  /// throws makes the trial a failure with that text.
  virtual void command(double time, const RobotReadings& readings, std::span<JointInput> inputs) = 0;
  /// Time at which the motion itself has ended [s].
  virtual double duration() const = 0;
  /// What a fitness or a person should know of the motion itself, e.g. how many of its points no leg could reach.
  virtual Values remarks() const { return {}; }
  /// The robot's lamps by name, brightness 0 … 1, after a command(); those that are not named are dark.
  virtual Values lamps() const { return {}; }
  /// Where something reached into a game the motion is made anew, at the same time: what it has to know of before.
  virtual std::vector<double> memory() const { return {}; }
  virtual void remember(std::span<const double> /*memory*/) {}
};

/// A family of motions: what evolves (its genotype) and what the task is (its settings). Stateless and shared.
class Controller {
 public:
  virtual ~Controller() = default;
  /// The evolved parameters, in the order of the parameter vector.
  virtual std::vector<Parameter> genotype() const = 0;
  /// What the user fixes for an experiment: the task, timings.
  virtual std::vector<Parameter> settings() const = 0;
  /// Names of further settings that are paths of files or folders: "stick". Where there are any, what evolves may
  /// depend on them, and with() gives the controller that is used.
  virtual std::vector<std::string> paths() const { return {}; }
  /// The controller for these paths, each absolute, by name. Throws InputError for what is not there or wrong in it.
  virtual std::shared_ptr<const Controller> with(const std::map<std::string, std::string>& /*paths*/) const {
    return nullptr;
  }
  /// What the robot must sense for it, in trials and in games; a game may give the same senses other numbers.
  virtual std::vector<SenseSpec> senses() const { return {}; }
  /// It needs the pictures of the robot's camera. Trials have none.
  virtual bool looks() const { return false; }
  /// Puts robot and ball to their starting places for this task. The scene's first robot is driven.
  virtual void arrange(Scene& scene, const Values& settings) const = 0;
  /// Makes the motion. `scene` is arranged. Never fails: a vector within the genotype's bounds always gives a motion.
  virtual std::unique_ptr<Motion> begin(const Scene& scene, const Values& settings,
                                        std::span<const double> parameters) const = 0;
};

}  // namespace btr
