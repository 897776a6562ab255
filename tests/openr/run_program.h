#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/openr/builder/stick_builder.h"
#include "core/openr/robot_process.h"
#include "core/openr/trivial_robot.h"

namespace btr::openr {

/// Builds folders onto the stick `out`, which is emptied first.
StickBuild buildOnto(const std::string& out, const std::vector<std::string>& folders);
/// The tests' own program, a folder in tests/openr/programs.
std::string programFolder(const std::string& program);
/// A stick with one of the tests' own programs (a folder in tests/openr/programs): a new copy of what is built once.
std::string stickOf(const std::string& program);
/// A folder of this test's own, empty.
std::string emptyFolder(const std::string& name);
void writeText(const std::string& path, const std::string& text);

/// What happened while a stick ran on a robot without physics.
struct StickRun {
  std::vector<std::string> lines;  ///< "Object: text"
  std::vector<OrderFrame> orders;  ///< one a frame
  Ended ended;
  std::string all() const;
  /// Targets of a joint in order, one for each frame that has one.
  std::vector<std::int32_t> targets(const RobotDesign& design, const std::string& joint) const;
};

/// Runs `frames` frames, the last with a shutdown; `before` is called with each frame's number from 1 on.
StickRun runStick(const std::string& stick, int frames, const std::function<void(int, TrivialRobot&)>& before = {},
                  const std::string& design = "ERS-7", int methodLimit_s = 10);

}  // namespace btr::openr
