// btr-camera watch: what a robot's camera sees of a running world that is told on standard input.
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/camera/camera_commands.h"
#include "core/camera/picture_file.h"
#include "core/camera/truth_file.h"
#include "core/camera/video_file.h"
#include "core/sim/scene.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "ui/common/resources.h"
#include "ui/live/drawn/live_lines.h"
#include "ui/live/eyes/live_eye.h"

namespace btr::cli {

CameraSpec cameraOfRobot(const Game& game, const ModelSet& models, const std::string& name) {
  for (const RobotSpec& robot : game.scene.robots) {
    if (robot.name != name) continue;
    const std::string known =
        ui::cameraOf(models.at(robot.model)->name + " " + std::filesystem::path(robot.model).stem().string());
    if (known.empty())
      throw InputError("camera", "the model \"" + models.at(robot.model)->name + "\" has none of its own",
                       "a camera file, by --camera or as ROBOT=FILE");
    return loadCamera((ui::resourceDirectory() + "/cameras/").toStdString() + known + ".json");
  }
  return {};  // LiveEye says which robots there are
}

namespace {

struct WatchArguments {
  std::string robot, camera, frames, video, truth;
};

/// Frames as they come, into files.
class Watch {
 public:
  explicit Watch(const WatchArguments& arguments) : arguments_(arguments) {
    if (!arguments.camera.empty()) camera_ = loadCamera(arguments.camera);
  }

  void take(const nlohmann::json& line) {
    if (line.contains("game")) return begin(line);
    if (!line.contains("row")) return;
    if (!eye_) throw InputError("standard input", "a row before a game", "what btr live --steered tells");
    eye_->add(ui::liveRowFrom(line));
    while (auto frame = eye_->next()) write(*frame);
  }

  nlohmann::json finish() {
    if (video_) video_->finish();
    if (truth_ && !arguments_.truth.empty()) truth_->write(arguments_.truth);
    nlohmann::json result{{"frames", frames_}};
    if (video_) result["codec"] = video_->codec();
    return result;
  }

 private:
  /// Objects that come or go would change the columns of the truth.
  void begin(const nlohmann::json& line) {
    const ui::ToldGame told = ui::toldGameFrom(line);
    const ModelSet models = loadModels(told.game.scene);
    if (!camera_) camera_ = cameraOfRobot(told.game, models, arguments_.robot);
    auto eye = std::make_unique<ui::LiveEye>(told.game, models, told.channels, arguments_.robot, *camera_);
    if (!video_ && !arguments_.video.empty())
      video_ = std::make_unique<VideoWriter>(arguments_.video, camera_->width, camera_->height, camera_->frameRate_hz);
    if (eye_ && eye->objects() != eye_->objects() && !arguments_.truth.empty())
      throw InputError(arguments_.truth, "objects came or went",
                       "a session with the same objects from its start to its end, or none of --truth and --frames");
    if (!truth_) truth_ = std::make_unique<TruthTable>(eye->objects(), eye->jointColumns());
    eye_ = std::move(eye);
  }

  void write(const ui::EyeFrame& frame) {
    const RgbPicture picture{frame.picture.width, frame.picture.height, shownRgb(frame.picture)};
    if (video_) video_->add(picture);
    if (!arguments_.frames.empty()) writeFrame(frame, picture);
    truth_->add(frame.number, frame.time_s, frame.picture.truth, frame.joints);
    ++frames_;
  }

  /// As the camera gives it: a JPEG file where it makes one, else PNG.
  void writeFrame(const ui::EyeFrame& frame, const RgbPicture& picture) const {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%06llu", static_cast<unsigned long long>(frame.number));
    const std::string path = (std::filesystem::path(arguments_.frames) / name).string();
    if (frame.picture.jpeg.empty()) return writePicture(path + ".png", picture);
    writeFile(path + ".jpg", std::string(frame.picture.jpeg.begin(), frame.picture.jpeg.end()));
  }

  const WatchArguments& arguments_;
  std::optional<CameraSpec> camera_;
  std::unique_ptr<ui::LiveEye> eye_;
  std::unique_ptr<TruthTable> truth_;
  std::unique_ptr<VideoWriter> video_;
  long frames_ = 0;
};

}  // namespace

void addWatchCommand(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<WatchArguments>();
  CLI::App* watch = app.add_subcommand("watch", "frames of a running world that btr live tells on standard input");
  watch->add_option("--robot", a->robot, "whose camera")->required();
  watch->add_option("--camera", a->camera, "camera (*.json); else that of the robot's model")->check(CLI::ExistingFile);
  shell.writesFolder(watch, watch->add_option("--frames", a->frames, "writes each frame into this folder"));
  shell.writesFile(watch, watch->add_option("--video", a->video, "writes a video (*.mp4, *.avi, *.mkv)"));
  shell.writesFile(watch, watch->add_option("--truth", a->truth, "writes what was really there (*.csv)"));
  watch->callback([a, &shell] {
    Watch work(*a);
    std::string line;
    long number = 0;
    while (std::getline(std::cin, line)) {
      ++number;
      try {
        work.take(nlohmann::json::parse(line));
      } catch (const nlohmann::json::exception& error) {
        throw InputError("standard input, line " + std::to_string(number), error.what(),
                         "what btr live --steered tells");
      }
    }
    const nlohmann::json result = work.finish();
    if (shell.json)
      printJson(result);
    else
      std::cout << result["frames"] << " frames\n";
  });
}

}  // namespace btr::cli
