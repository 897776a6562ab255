// btr-camera fit-colour: gains, rim, gamma and noise from photographs and renderings of the same scenes.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/camera/camera_commands.h"
#include "core/camera/camera_pipeline.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"

namespace btr::cli {
namespace {

namespace fs = std::filesystem;

struct FitColourArguments {
  std::string photos, renderings, camera, out;
  TwinOptions options;
};

/// The rendering of the photograph's name, whatever their endings.
std::string renderingOf(const std::string& photo, const std::vector<std::string>& renderings) {
  for (const std::string& path : renderings)
    if (fs::path(path).stem() == fs::path(photo).stem()) return path;
  throw InputError(photo + ": has no rendering of the same name");
}

PinholePicture renderedScene(const std::string& path, Pinhole pinhole) {
  const RgbPicture coded = readPicture(path);
  PinholePicture scene;
  pinhole.width = coded.width;
  pinhole.height = coded.height;
  scene.pinhole = pinhole;
  for (const std::uint8_t byte : coded.rgb) scene.rgb.push_back(linearFromSrgb(static_cast<float>(byte) / 255));
  return scene;
}

void fitColourCommand(const FitColourArguments& a, const Shell& shell) {
  const CameraSpec spec = loadCamera(a.camera);
  const Pinhole pinhole = CameraPipeline(spec).pinhole();
  const std::vector<std::string> renderings = picturesIn(a.renderings);
  std::vector<ColourView> views;
  for (const std::string& path : picturesIn(a.photos))
    views.push_back(
        {fs::path(path).filename().string(), readPicture(path), renderedScene(renderingOf(path, renderings), pinhole)});
  const CameraTwin twin = fitColour(spec, views, a.options);
  writeFile(a.out, toJsonText(twin.spec));
  printTwin(twin, "/255", shell, {{"camera", a.out}});
}

}  // namespace

void addFitColourCommand(CLI::App& app, Shell& shell) {
  auto a = std::make_shared<FitColourArguments>();
  CLI::App* fit = app.add_subcommand("fit-colour", "colour stages from photographs and renderings of the same scenes");
  fit->add_option("--photos", a->photos, "folder of photographs")->required();
  fit->add_option("--renderings", a->renderings,
                  "folder of what a camera without errors sees, by the same names (sRGB, as wide as the lens looks)")
      ->required();
  fit->add_option("--camera", a->camera, "the camera with its lens")->required();
  fit->add_option("--held-out", a->options.heldOutShare, "share of the photographs that no fit sees")
      ->transform(decimalNumber(0.01, 0.9))
      ->capture_default_str();
  fit->add_option("--seed", a->options.seed, "which those are")->transform(seedNumber())->capture_default_str();
  shell.writesFile(fit, fit->add_option("--out", a->out, "writes the camera as it was found")->required());
  fit->callback([a, &shell] { fitColourCommand(*a, shell); });
}

}  // namespace btr::cli
