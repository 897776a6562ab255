#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/plugin/reality.h"

namespace btr {

/// A program that plays or drives the robot. It gets one JSON request a line on standard input,
///   {"parameters": […], "repeat": 0, "record": "FILE", "robot": "hung_up"}
/// and gives one answer a line on standard output, {"fitness": 0.5, "void": false, "note": ""} or {"error": "why"},
/// until its input ends.
class RobotProgram final : public RealRobot {
 public:
  struct Options {
    std::string name;                    ///< in messages, "the stand-in reality"
    double timeout_s = 0;                ///< for one answer; 0: as long as it takes
    std::function<bool()> stopped = {};  ///< looked at while it is waited for
  };
  /// `words`: path and arguments. Throws InputError if it cannot be started.
  RobotProgram(const std::vector<std::string>& words, Options options);
  /// Ends its input; kills it if it has not ended after five seconds.
  ~RobotProgram() override;
  RobotProgram(const RobotProgram&) = delete;
  RobotProgram& operator=(const RobotProgram&) = delete;

  /// Nothing if stopped. Throws InputError if it died, did not answer in time or answered nonsense.
  std::optional<RealAnswer> measure(const RealTask& task) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr
