#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/camera/camera_spec.h"
#include "core/camera/picture_file.h"
#include "core/camera/pinhole.h"

// The numbers of a camera from its photographs, and how well they foretell photographs that no fit saw.
namespace btr {

/// A chessboard by its inner corners.
struct BoardPattern {
  int columns = 9, rows = 6;
  double square_m = 0.025;
};

/// Where the points of a photograph are: from their frame to that of the picture (x right, y down, z into the scene).
struct ViewPose {
  std::array<double, 3> rotation_rad{0, 0, 0};  ///< axis times angle
  std::array<double, 3> translation_m{0, 0, 0};
};

/// Known points, and where one photograph shows them.
struct PointView {
  std::string name;
  std::vector<std::array<double, 3>> points_m;
  std::vector<std::array<double, 2>> seen_px;
  std::optional<ViewPose> pose;  ///< if it was measured; else it is fitted
};

/// The corners of the board, to parts of a pixel; nothing if it is not seen as a whole.
std::optional<PointView> boardView(const RgbPicture& photo, const BoardPattern& board, const std::string& name);

struct TwinOptions {
  double heldOutShare = 0.25;  ///< of the photographs, at least one
  std::uint64_t seed = 1;      ///< which
};

/// One number of the camera.
struct TwinNumber {
  std::string name, unit;
  double before = 0, after = 0;
  double deviation = 0;    ///< standard deviation, of `after` or of what was fitted before it was given up
  bool identified = true;  ///< false: the photographs do not tell it; `after` is 0, or what it was
};

/// Root mean square errors in one photograph: in pixels (lens), or in 255ths of white (colour).
struct TwinPhoto {
  std::string name;
  bool heldOut = false;
  double before = 0, after = 0;
};

/// What a fit found.
struct CameraTwin {
  CameraSpec spec;  ///< as given, with the fitted numbers
  std::vector<TwinNumber> numbers;
  std::vector<TwinPhoto> photos;
  double heldOutBefore = 0, heldOutAfter = 0;  ///< root mean square over the held-out photographs
  double fittedAfter = 0;                      ///< over the others
  double noise = 0;  ///< colour only: what the fitted noise alone would leave, in 255ths of white
};

/// Focal length, centre and Brown's terms. Radial terms are left at 0 from the highest down, and the two tangential
/// ones together, while they are less than twice their standard deviation; focal length and centre stay as they were
/// where their deviation is more than 5 % of the focal length or of the picture's width. The pose of a held-out board
/// is fitted to every other corner, and the error is that of the corners between. Throws InputError: fewer than four
/// photographs (two with poses), poses of only some, points outside a photograph of the sensor's size.
CameraTwin fitLens(const CameraSpec& spec, std::span<const PointView> views, const TwinOptions& options = {});

/// A photograph, and what CameraPipeline::pinhole() of the same camera renders of the same scene from the same place.
struct ColourView {
  std::string name;
  RgbPicture photo;
  PinholePicture scene;
};

/// Gains of the three channels, vignetting, casts of red and blue (green's is the vignetting), gamma, read and shot
/// noise; the fixed pattern counts as read noise. Lens, light, filter and exposure are taken as the spec has them.
/// Pixels next to edges of the scene and near black or white are left out. Terms are dropped as by fitLens(); gamma
/// stays as it was where its deviation is more than 0.2. Throws InputError: fewer than two photographs, sizes that do
/// not fit, too few usable pixels.
CameraTwin fitColour(const CameraSpec& spec, std::span<const ColourView> views, const TwinOptions& options = {});

}  // namespace btr
