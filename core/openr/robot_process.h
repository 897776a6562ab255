#pragma once
#include <sys/types.h>

#include <optional>
#include <string>

#include "core/openr/robot_link.h"

namespace btr::openr {

/// The OPEN-R program of one robot, running in a process of its own. Nothing that it does harms this one. Not for
/// several threads at once.
class RobotProcess {
 public:
  struct Options {
    std::string stick;             ///< folder that is /MS to the program
    std::string design = "ERS-7";  ///< or "ERS-210", "ERS-220"
    int methodLimit_s = 10;        ///< of the processor's time that a method may use without coming back
    std::string program;           ///< empty: openr_robot beside this program
  };

  static constexpr double patience_s = 60;

  /// Starts it. Throws InputError if the stick has no OBJECT.CFG, or the process cannot be started.
  explicit RobotProcess(const Options& options);
  ~RobotProcess();  ///< ends it at once
  RobotProcess(const RobotProcess&) = delete;
  RobotProcess& operator=(const RobotProcess&) = delete;

  /// One frame of 8 ms: what the robot senses, and what the program orders. If the process dies, or has not taken the
  /// frame and answered all of it within `deadline_s` of real time, the answer says so in `ended`; so do all answers
  /// after an end, with nothing else.
  OrderFrame exchange(const SensorFrame& frame, double deadline_s = patience_s);

  const std::optional<Ended>& ended() const { return ended_; }
  void kill();

 private:
  OrderFrame endWith(Ended::Why why, const std::string& what);
  std::string howItEnded();

  int link_ = -1;
  pid_t process_ = -1;
  std::optional<Ended> ended_;
};

}  // namespace btr::openr
