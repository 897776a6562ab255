#pragma once
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/sim/readings.h"
#include "core/sim/scene.h"

namespace btr {

/// One motion of one trial, made by a Controller from a parameter vector.
class Motion {
 public:
  virtual ~Motion() = default;
  /// Fills the command of each joint of the robot it drives for the control period that begins at `time` [s]. What it
  /// throws makes the trial a failure with that text.
  virtual void command(double time, const RobotReadings& readings, std::span<JointInput> inputs) = 0;
  /// Time at which the motion itself has ended [s].
  virtual double duration() const = 0;
  /// What a fitness or a person should know of the motion itself, e.g. how many of its points no leg could reach.
  virtual Values remarks() const { return {}; }
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
  /// Puts robot and ball to their starting places for this task. The scene's first robot is driven.
  virtual void arrange(Scene& scene, const Values& settings) const = 0;
  /// Makes the motion. `scene` is arranged. Never fails: a vector within the genotype's bounds always gives a motion.
  virtual std::unique_ptr<Motion> begin(const Scene& scene, const Values& settings,
                                        std::span<const double> parameters) const = 0;
};

}  // namespace btr
