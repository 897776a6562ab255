#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "core/gap/recordings/recording.h"
#include "core/sim/scene.h"

namespace btr {

/// Which columns of a recording drive a scene, and which can be compared with it.
struct Binding {
  struct Input {
    enum class What { command, enabled, supply, duty, volts, motion };
    What what = What::command;
    std::size_t robot = 0, joint = 0;
    std::size_t column = 0;
    bool isMeasuredTorque = false;  ///< a sensor told what drives the joint, with its noise; a command is exact
  };
  struct Measured {
    enum class What { position, rate, torque, basePosition, baseOrientation, ballPosition };
    What what = What::position;
    std::size_t object = 0;  ///< robot or ball
    std::size_t part = 0;    ///< joint, axis 0 … 2, or w, x, y, z as 0 … 3
    std::size_t column = 0;
  };
  std::vector<Input> inputs;
  /// A joint's input of that kind, nullptr where the recording has none.
  const Input* input(Input::What what, std::size_t robot, std::size_t joint) const;
  std::vector<Measured> measured;
  std::vector<Measured> startOnly;  ///< give the start but are not compared (Recording::notCompared)
  std::vector<std::string> notes;   ///< columns that the simulator has no counterpart of, joints without a command
};

/// Finds robot, joint or ball of every channel. Throws InputError for a channel that the scene does not have, and for a
/// command in the wrong unit (a slide joint's in rad).
Binding bind(const Scene& scene, const Recording& recording);

}  // namespace btr
