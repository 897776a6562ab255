#pragma once
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/live/session.h"
#include "core/openr/robot_units.h"
#include "core/sim/senses.h"

namespace btr::openr {

/// A robot's OPEN-R program while it runs.
class RunningProgram {
 public:
  virtual ~RunningProgram() = default;
  /// What it orders for the frame that begins now. After an answer with `ended` it is not asked again.
  virtual OrderFrame exchange(const SensorFrame& frame) = 0;
};

/// The cameras of robots whose game asks for them.
class RobotCameras {
 public:
  virtual ~RobotCameras() = default;
  /// Tells a robot's camera that the period is over, so that the cameras of several robots draw at the same time.
  /// look(), which needs it not, takes what comes of it.
  virtual void ask(const std::string& /*robot*/) {}
  /// What a robot's camera has finished by the end of the last period, if it has. Asked once each period.
  virtual std::optional<CameraImage> look(const std::string& robot) = 0;
  /// From now on with these numbers: see cameraNumbers().
  virtual void set(const std::string& robot, const Values& numbers) = 0;
};

/// Programs that move robots of a session: before each of its periods every one of them gets what its robot senses, and
/// what it orders becomes an OrdersAct. The same game and acts give the same orders. Session and what starts programs
/// outlive it.
class LivePrograms {
 public:
  /// Starts the program of a stick (full path) on a robot of that design. Throws InputError if it cannot be started.
  using Starter = std::function<std::unique_ptr<RunningProgram>(const std::string& folder, const RobotDesign& design)>;

  /// Starts the programs of the robots that have a stick. A program that cannot be started has ended with the reason.
  /// Without cameras there are no images. `dog` sees whether programs answer.
  LivePrograms(Session& session, Starter start, RobotCameras* cameras = nullptr, Watchdog* dog = nullptr);
  ~LivePrograms();

  /// To be called before each period, after all other acts.
  void step();
  /// To be told of each act that the session took: robots come and go, a stick is put in anew.
  void acted(const Act& act);
  /// On the robot's console; its program reads it in the next period. Throws InputError if none runs there.
  void type(const std::string& robot, const std::string& text);
  /// Switches the robots off: Stop and Destroy in their objects. Lines of that can still be taken.
  void end();

  struct Line {
    std::string robot, object, text;
  };
  /// What was said since the last call.
  std::vector<Line> takeLines();
  /// By robot with a stick: nothing while its program runs, else why no longer.
  const std::map<std::string, std::optional<Ended>>& ended() const { return ended_; }
  /// Counts up when a program starts or ends.
  long changes() const { return changes_; }

 private:
  struct Robot {
    std::unique_ptr<RunningProgram> program;
    std::optional<RobotUnits> units;
    std::uint32_t frames = 0;
    std::string typed;
    std::size_t index = 0;                      ///< in the scene
    std::map<std::string, std::size_t> senses;  ///< columns of the row that it senses, by what they are
    std::optional<Senses> own;  ///< where the game gives it none: those of its design, with a row of their own
  };

  void start(const std::string& name);
  void look(const std::string& name, Robot& robot) const;
  void sense(Robot& robot, const std::string& name, std::vector<double>& row) const;
  bool looks(const std::string& name) const;
  SensorFrame frameOf(const std::string& name, Robot& robot, const std::vector<double>& sessions) const;
  void take(const std::string& name, Robot& robot, const OrderFrame& orders);
  void stop(const std::string& name);

  Session& session_;
  Starter start_;
  RobotCameras* cameras_;
  Watchdog* dog_;
  std::map<std::string, Robot> robots_;  ///< whose program runs
  std::map<std::string, std::optional<Ended>> ended_;
  std::vector<Line> lines_;
  long changes_ = 0;
  bool stale_ = false;  ///< the session's columns may be others now
};

}  // namespace btr::openr
