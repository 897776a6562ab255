#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/sim/controller.h"

namespace btr {

class Session;

/// What a robot's camera sees of a running world. Whoever renders stands behind it: nothing here knows how.
class CameraEye {
 public:
  virtual ~CameraEye() = default;
  /// Before look(), which does without: this period is wanted, so that the cameras of several robots draw at the same
  /// time. Nothing of the world changes until look(), which says what fails.
  virtual void ask(const Session& /*session*/) {}
  /// Once a control period, and as the camera begins to look. The frame that came to its end in it, if one did. Throws
  /// InputError where there is no such camera, or no more.
  virtual std::optional<CameraPicture> look(const Session& session) = 0;
};

/// Empty where there are no cameras.
using CameraMaker = std::function<std::unique_ptr<CameraEye>(const std::string& robot)>;

}  // namespace btr
