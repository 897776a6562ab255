#pragma once
// Programs that tests play themselves, at the place of a process with OPEN-R objects.
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/live/session.h"
#include "core/openr/live_programs.h"
#include "tests/plugin/built_plugins.h"

namespace btr::test {

/// Two ERS-7 with sticks on a floor; their motors are on if `power`. Red has the senses of its model.
inline std::string sticksText(bool power, const std::string& period = "0.008") {
  const std::string stick =
      R"({"openr": {"stick": "red", "motor_power": )" + std::string(power ? "true" : "false") + "}}";
  const std::string other = R"({"openr": {"stick": "blue", "motor_power": true}})";
  return R"({"format": "uchilsim-game-1", "seed": 3,
  "scene": {"format": "uchilsim-scene-1", "step_s": 0.001, "control_period_s": )" +
         period + R"(, "floor": {"friction": 1}, "robots_collide": true,
    "robots": [{"name": "red1", "model": ")" SOURCE_DIR R"(/resources/robots/ers7.wrl", "position_m": [-0.5, 0, 0]},
               {"name": "blue1", "model": ")" SOURCE_DIR R"(/resources/robots/ers7.wrl", "position_m": [0.6, 0.1, 0]}]},
  "robots": {"red1": {"senses": "ers7", "controller": )" +
         stick + R"(}, "blue1": {"controller": )" + other + "}}}";
}

/// A program by what it answers: the frame's number begins at 1.
using Answer = std::function<openr::OrderFrame(const openr::SensorFrame&)>;

class PlayedProgram final : public openr::RunningProgram {
 public:
  explicit PlayedProgram(Answer answer) : answer_(std::move(answer)) {}
  openr::OrderFrame exchange(const openr::SensorFrame& frame) override { return answer_(frame); }

 private:
  Answer answer_;
};

/// By the last part of the stick's folder; one without an answer cannot be started.
inline openr::LivePrograms::Starter playing(std::map<std::string, Answer> answers) {
  return [answers = std::move(answers)](const std::string& folder,
                                        const openr::RobotDesign&) -> std::unique_ptr<openr::RunningProgram> {
    return std::make_unique<PlayedProgram>(answers.at(folder.substr(folder.rfind('/') + 1)));
  };
}

inline std::size_t placeOf(const std::string& joint) {
  const auto& joints = openr::robotDesign("ERS-7").joints;
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (joints[i].name == joint) return i;
  return joints.size();
}

/// An order for one joint.
inline openr::OrderFrame orderOf(const std::string& joint, openr::JointOrder order) {
  openr::OrderFrame frame;
  frame.joints.resize(openr::robotDesign("ERS-7").joints.size());
  frame.joints[placeOf(joint)] = order;
  return frame;
}

/// All joints that have gains are enabled.
inline openr::OrderFrame enableAll() {
  openr::OrderFrame frame;
  for (const openr::Primitive& joint : openr::robotDesign("ERS-7").joints) {
    frame.joints.emplace_back();
    if (joint.kind == openr::Primitive::Kind::joint) frame.joints.back().gainEnabled = true;
  }
  return frame;
}

}  // namespace btr::test
