#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/spec/parameter.h"

namespace btr {

/// What happens to a picture between the world and the bytes, in this order.
enum class CameraStage { lens, vignetting, shutter, colour, noise, gamma, ycbcr, classes, jpeg };
inline constexpr std::size_t cameraStageCount = 9;

/// All of them, along the light's way.
std::span<const CameraStage> cameraStages();
/// As in files and on the command line: "lens", "ycbcr".
std::string nameOf(CameraStage stage);
/// Nothing if there is no stage of that name.
std::optional<CameraStage> cameraStageNamed(const std::string& name);
/// One short sentence without a full stop.
std::string meaningOf(CameraStage stage);
/// Its numbers, with unit, meaning, bounds, default.
std::span<const Parameter> parametersOf(CameraStage stage);

/// Whether a stage works, and its numbers by name; one that is absent has its default.
struct StageSettings {
  bool on = false;
  Values values;
};

/// Where on the robot the camera is: the optical frame (x forward, y left, z up) in the frame of a link.
struct CameraMount {
  std::string link;
  std::array<double, 3> position_m{0, 0, 0};
  std::array<double, 4> orientation_wxyz{1, 0, 0, 0};
};

/// A box in the colours that the robot sees, bounds included: Y, Cb, Cr, each from 0 to 255.
struct ColourBox {
  std::array<int, 3> least{0, 0, 0}, most{255, 255, 255};
};

/// A named colour: all that lies in one of its boxes.
struct ColourClass {
  std::string name;
  std::vector<ColourBox> boxes;
};

inline constexpr std::size_t mostColourClasses = 8, mostColourBoxes = 32;

/// A robot's camera ("format": "uchilsim-camera-1").
struct CameraSpec {
  std::string name = "camera";
  int width = 208, height = 160;                 ///< of the sensor, in pixels
  double focal_px = 191.9;                       ///< pixels are square
  double centreX_px = 103.5, centreY_px = 79.5;  ///< the optical axis; (0, 0) is the middle of the upper left pixel
  double frameRate_hz = 30;
  CameraMount mount;
  std::uint64_t seed = 1;  ///< of the noise
  std::array<StageSettings, cameraStageCount> stages;
  std::vector<ColourClass> classes;  ///< at most 8; where boxes overlap the first has the pixel
  std::vector<std::string> notes;    ///< where the numbers come from, for people

  StageSettings& operator[](CameraStage stage) { return stages[static_cast<std::size_t>(stage)]; }
  const StageSettings& operator[](CameraStage stage) const { return stages[static_cast<std::size_t>(stage)]; }
  /// The number of a stage, or its default.
  double number(CameraStage stage, const std::string& parameter) const;
};

/// Throws InputError.
CameraSpec cameraFromJson(const std::string& text, const std::string& place);
CameraSpec loadCamera(const std::string& path);
/// Ends in a line break; reads back as the same spec.
std::string toJsonText(const CameraSpec& spec);
/// Throws InputError if a number is out of its bounds or numbers do not go together; `place` begins the message.
void check(const CameraSpec& spec, const std::string& place);

}  // namespace btr
