// btr-camera eye: what a robot's camera sees, for its own program: each row on standard input is answered at once.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/camera/camera_commands.h"
#include "core/spec/error.h"
#include "ui/live/drawn/live_lines.h"
#include "ui/live/eyes/live_eye.h"

namespace btr::cli {
namespace {

/// Rows of Y, Cr, Cb as Sony's cameras give them: Cr = R − Y and Cb = B − Y, each from −1 to 1.
std::vector<std::uint8_t> planesOf(const CameraFrame& frame) {
  const auto width = static_cast<std::size_t>(frame.width), height = static_cast<std::size_t>(frame.height);
  std::vector<std::uint8_t> planes(3 * width * height);
  const auto signedByte = [](double value) {
    constexpr double half = 127.5;
    return static_cast<std::uint8_t>(std::lround(half + half * value));
  };
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      constexpr double full = 255, ofRed = 0.299, ofGreen = 0.587, ofBlue = 0.114;  // ITU-R BT.601
      const std::uint8_t* rgb = &frame.rgb[3 * (y * width + x)];
      const double red = rgb[0] / full, green = rgb[1] / full, blue = rgb[2] / full;
      const double luma = ofRed * red + ofGreen * green + ofBlue * blue;
      std::uint8_t* row = &planes[3 * y * width];
      row[x] = static_cast<std::uint8_t>(std::lround(full * luma));
      row[width + x] = signedByte(red - luma);
      row[2 * width + x] = signedByte(blue - luma);
    }
  return planes;
}

class Eye {
 public:
  Eye(std::string robot, bool asRgb) : robot_(std::move(robot)), asRgb_(asRgb) {}

  void take(const nlohmann::json& line) {
    if (line.contains("game")) return begin(line);
    if (line.contains("camera")) return set(line.at("camera"));
    if (!line.contains("row")) return;
    if (!eye_) throw InputError("standard input", "a row before a game", "a game first");
    eye_->add(ui::liveRowFrom(line));
    std::vector<std::uint8_t> planes, classes;
    while (const auto frame = eye_->next()) {
      planes = asRgb_ ? frame->picture.rgb : planesOf(frame->picture);
      if (asRgb_) classes = frame->picture.classes;
    }
    answer(planes, classes);
  }

 private:
  void begin(const nlohmann::json& line) {
    const ui::ToldGame told = ui::toldGameFrom(line);
    const ModelSet models = loadModels(told.game.scene);
    if (!camera_) camera_ = cameraOfRobot(told.game, models, robot_);
    eye_ = std::make_unique<ui::LiveEye>(told.game, models, told.channels, robot_, *camera_);
  }

  /// Numbers of the camera's stages: {"light_balance_k": …, "exposure_s": …, "gain_db": …}.
  void set(const nlohmann::json& numbers) {
    const auto to = [&](const char* key, CameraStage stage, const char* parameter) {
      if (numbers.contains(key)) (*camera_)[stage].values[parameter] = numbers.at(key).get<double>();
    };
    to("balance_k", CameraStage::colour, "balance_k");
    to("exposure_s", CameraStage::shutter, "exposure_s");
    to("gain_db", CameraStage::noise, "gain_db");
    eye_->setCamera(*camera_);
  }

  /// Width and height, 0 where there is no frame, each 4 bytes, the lowest first; of red, green and blue then a byte
  /// that says whether classes follow; then the planes, and the classes.
  void answer(const std::vector<std::uint8_t>& planes, const std::vector<std::uint8_t>& classes) const {
    std::vector<std::uint8_t> head(asRgb_ ? 9 : 8);
    constexpr int byte = 8;
    if (!planes.empty())
      for (int i = 0; i < 4; ++i) {
        head[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(camera_->width >> (byte * i));
        head[static_cast<std::size_t>(4 + i)] = static_cast<std::uint8_t>(camera_->height >> (byte * i));
      }
    if (asRgb_) head.back() = classes.empty() ? 0 : 1;
    std::fwrite(head.data(), 1, head.size(), stdout);
    std::fwrite(planes.data(), 1, planes.size(), stdout);
    std::fwrite(classes.data(), 1, classes.size(), stdout);
    std::fflush(stdout);
  }

  std::string robot_;
  bool asRgb_;
  std::optional<CameraSpec> camera_;
  std::unique_ptr<ui::LiveEye> eye_;
};

}  // namespace

void addEyeCommand(CLI::App& app, Shell&) {
  auto robot = std::make_shared<std::string>();
  CLI::App* eye = app.add_subcommand("eye", "frames for a robot's own program, as bytes on standard output");
  eye->group("");  // btr starts it
  eye->add_option("--robot", *robot, "whose camera")->required();
  auto asRgb = std::make_shared<bool>(false);
  eye->add_flag(
      "--rgb", *asRgb,
      "red, green and blue of each pixel instead of Sony's planes, and its colour class if the camera has classes");
  eye->callback([robot, asRgb] {
    Eye work(*robot, *asRgb);
    std::string line;
    for (long number = 1; std::getline(std::cin, line); ++number) try {
        work.take(nlohmann::json::parse(line));
      } catch (const nlohmann::json::exception& error) {
        throw InputError("standard input, line " + std::to_string(number), error.what(), "what btr tells");
      }
  });
}

}  // namespace btr::cli
