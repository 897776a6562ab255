// btr-camera apply: a picture of what each stage does.
#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/camera/camera_commands.h"
#include "core/camera/camera_pipeline.h"
#include "core/camera/picture_file.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr::cli {
namespace {

namespace fs = std::filesystem;

struct ApplyArguments {
  std::string picture, camera, out;
  std::vector<std::string> only, without;
  std::uint64_t frame = 0;
};

CameraStage stageCalled(const std::string& name) {
  if (const auto stage = cameraStageNamed(name)) return *stage;
  std::string names;
  for (const CameraStage stage : cameraStages()) names += (names.empty() ? "" : ", ") + nameOf(stage);
  throw InputError("stage", "\"" + name + "\"", "one of " + names);
}

/// The camera with those stages that are asked for.
CameraSpec chosenCamera(const ApplyArguments& a) {
  CameraSpec spec = loadCamera(a.camera);
  if (!a.only.empty()) {
    for (const CameraStage stage : cameraStages()) spec[stage].on = false;
    for (const std::string& name : a.only) spec[stageCalled(name)].on = true;
  }
  for (const std::string& name : a.without) spec[stageCalled(name)].on = false;
  check(spec, a.camera);
  return spec;
}

/// What a camera without errors would see if the picture filled the view: linear light, enlarged or reduced.
PinholePicture seenThrough(const RgbPicture& photo, const Pinhole& pinhole) {
  PinholePicture picture;
  picture.pinhole = pinhole;
  picture.rgb.reserve(3 * static_cast<std::size_t>(pinhole.width) * static_cast<std::size_t>(pinhole.height));
  std::array<float, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linearFromSrgb(static_cast<float>(i) / 255);
  // Each pixel is the mean of those of the picture that it covers, at least one.
  const double stepX = static_cast<double>(photo.width) / pinhole.width;
  const double stepY = static_cast<double>(photo.height) / pinhole.height;
  for (int y = 0; y < pinhole.height; ++y)
    for (int x = 0; x < pinhole.width; ++x) {
      const int left = static_cast<int>(x * stepX), top = static_cast<int>(y * stepY);
      const int right = std::max(left + 1, static_cast<int>((x + 1) * stepX));
      const int bottom = std::max(top + 1, static_cast<int>((y + 1) * stepY));
      std::array<float, 3> sum{};
      for (int row = top; row < bottom; ++row)
        for (int column = left; column < right; ++column)
          for (std::size_t c = 0; c < 3; ++c)
            sum[c] += linear[photo.rgb[3 * static_cast<std::size_t>(row * photo.width + column) + c]];
      const auto count = static_cast<float>((right - left) * (bottom - top));
      for (const float value : sum) picture.rgb.push_back(value / count);
    }
  return picture;
}

class AppliedFiles {
 public:
  AppliedFiles(std::string folder, int width, int height)
      : folder_(std::move(folder)), width_(width), height_(height) {}

  void picture(const std::string& name, std::span<const std::uint8_t> rgb) {
    writePicture(path(name), {width_, height_, {rgb.begin(), rgb.end()}});
  }
  void bytes(const std::string& name, const std::vector<std::uint8_t>& content) {
    writeFile(path(name), {content.begin(), content.end()});
  }
  const std::vector<std::string>& written() const { return written_; }

 private:
  std::string path(const std::string& name) {
    written_.push_back(name);
    return (fs::path(folder_) / name).string();
  }

  std::string folder_;
  int width_, height_;
  std::vector<std::string> written_;
};

void applyCamera(const ApplyArguments& a, const Shell& shell) {
  const CameraPipeline camera(chosenCamera(a));
  const PinholePicture still = seenThrough(readPicture(a.picture), camera.pinhole());
  const std::vector<PinholePicture> moments(camera.moments_s().size(), still);
  AppliedFiles files(a.out, camera.spec().width, camera.spec().height);
  const CameraFrame frame = camera.process(moments, a.frame, [&](CameraStage stage, std::span<const std::uint8_t> rgb) {
    files.picture(std::to_string(static_cast<int>(stage) + 1) + "-" + nameOf(stage) + ".png", rgb);
  });
  files.picture("picture.png", shownRgb(frame));
  if (!frame.ycbcr.empty()) files.bytes("picture.yuyv", frame.ycbcr);
  if (!frame.classes.empty()) files.bytes("classes.bytes", frame.classes);
  if (!frame.jpeg.empty()) files.bytes("picture.jpg", frame.jpeg);
  if (shell.json) {
    const Pinhole p = camera.pinhole();
    printJson({{"files", files.written()},
               {"width_px", frame.width},
               {"height_px", frame.height},
               {"pinhole", {{"width_px", p.width}, {"height_px", p.height}, {"focal_px", p.focal_px}}}});
    return;
  }
  for (const std::string& name : files.written()) std::cout << (fs::path(a.out) / name).string() << '\n';
}

}  // namespace

void addApplyCommand(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<ApplyArguments>();
  CLI::App* apply = app.add_subcommand("apply", "a picture of what each stage of a camera does to a picture");
  apply->add_option("PICTURE", a->picture, "what a camera without errors would see (PNG, JPEG; sRGB)")->required();
  apply->add_option("--camera", a->camera, "the camera's file")->required();
  CLI::Option* only = apply->add_option("--only", a->only, "only these stages work");
  apply->add_option("--without", a->without, "these stages do not work")->excludes(only);
  apply->add_option("--frame", a->frame, "the frame's number, which chooses the noise")
      ->transform(seedNumber())
      ->capture_default_str();
  CLI::Option* out = apply->add_option("--out", a->out, "folder for the pictures")->required();
  shell.writesFolder(apply, out, {"picture.png"});
  apply->callback([a, &shell] { applyCamera(*a, shell); });
}

}  // namespace btr::cli
