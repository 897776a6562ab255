#include "app/live/btr_live_camera.h"

#include <nlohmann/json.hpp>

#include "app/live/btr_live_lines.h"
#include "core/spec/error.h"

namespace btr::cli {

void addCameraOptions(CLI::App& live, LiveCameraOptions& options, Shell& shell) {
  CLI::Option* robot = live.add_option("--camera", options.robot, "the robot whose camera looks");
  live.add_option("--camera-file", options.camera, "its camera (*.json); else that of the robot's model")
      ->check(CLI::ExistingFile)
      ->needs(robot);
  const auto writes = [&](CLI::Option* option) { option->needs(robot); };
  writes(shell.writesFolder(&live, live.add_option("--frames", options.frames, "writes each frame into this folder")));
  writes(shell.writesFile(&live, live.add_option("--video", options.video, "writes a video (*.mp4, *.avi, *.mkv)")));
  writes(shell.writesFile(&live, live.add_option("--truth", options.truth, "writes what was really there (*.csv)")));
}

LiveCamera::LiveCamera(const LiveCameraOptions& options, const Session& session) {
  std::vector<std::string> words{"watch", "--robot", options.robot};
  const auto add = [&](const char* option, const std::string& value) {
    if (value.empty()) return;
    words.emplace_back(option);
    words.push_back(value);
  };
  add("--camera", options.camera);
  add("--frames", options.frames);
  add("--video", options.video);
  add("--truth", options.truth);
  process_ = std::make_unique<CameraProcess>(std::move(words), false);
  tell(session);
}

void LiveCamera::tell(const Session& session) {
  if (std::vector<std::string> channels = session.channels(); channels != channels_) {
    channels_ = std::move(channels);
    send(gameLine(session).dump());
  }
  send(rowLine(session, true, 0).dump());
}

void LiveCamera::send(const std::string& line) {
  if (!process_->send(line)) finish();  // says why
}

void LiveCamera::finish() { process_->finish(); }

}  // namespace btr::cli
