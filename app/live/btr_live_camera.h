#pragma once
#include <memory>
#include <string>
#include <vector>

#include "app/btr_commands.h"
#include "app/live/btr_camera_process.h"
#include "core/live/session.h"

namespace btr::cli {

/// What btr live makes of a robot's camera; empty texts: not that.
struct LiveCameraOptions {
  std::string robot;   ///< whose; "" no camera
  std::string camera;  ///< file; "" that of the robot's model
  std::string frames, video, truth;
};

void addCameraOptions(CLI::App& live, LiveCameraOptions& options, Shell& shell);

/// The robot's camera in a process of its own (btr-camera watch): it draws while the world goes on.
class LiveCamera {
 public:
  /// Starts it and tells the game and its first row. Throws InputError if it cannot be started.
  LiveCamera(const LiveCameraOptions& options, const Session& session);

  /// The world as it is now; objects that came or went first. Throws InputError if the camera ended.
  void tell(const Session& session);
  /// Waits until its files are written. Throws InputError if they are not.
  void finish();

 private:
  void send(const std::string& line);

  std::unique_ptr<CameraProcess> process_;
  std::vector<std::string> channels_;
};

}  // namespace btr::cli
