#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/camera/camera_spec.h"
#include "core/camera/pinhole.h"

namespace btr {

/// An object as far as it is seen in one frame.
struct SeenObject {
  std::uint16_t object = 0;                      ///< as in PinholePicture
  int pixels = 0;                                ///< how many show it
  int left = 0, top = 0, right = 0, bottom = 0;  ///< its box, last column and row included
  double centreX_px = 0, centreY_px = 0;         ///< the mean of those pixels
  double distance_m = 0;                         ///< mean distance of what is seen of it from the camera
};

/// What is really there, pixel by pixel of the sensor, through the same lens, at the middle moment.
struct PictureTruth {
  std::vector<float> depth_m;  ///< along the optical axis; infinity where nothing is
  std::vector<std::uint16_t> object;
  std::vector<SeenObject> seen;  ///< in the order of their numbers; what no pixel shows is not there
};

/// What the camera gives for one frame; rows from the upper left.
struct CameraFrame {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;      ///< 3 a pixel, after the last stage. Without gamma it is linear light: shownRgb()
  bool linear = false;                ///< the gamma stage is off
  std::vector<std::uint8_t> ycbcr;    ///< Y Cb Y Cr for two pixels; empty if the stage is off
  std::vector<std::uint8_t> classes;  ///< 0 none, else 1 + index into CameraSpec::classes; empty if the stage is off
  std::vector<std::uint8_t> jpeg;     ///< a JPEG file; empty if the stage is off
  PictureTruth truth;
};

/// As a display (sRGB) or a PNG file expects it: `rgb` itself, or linear light coded.
std::vector<std::uint8_t> shownRgb(const CameraFrame& frame);

/// 3 a pixel, coded for a display by sRGB's curve (IEC 61966-2-1) ↔ linear light.
float linearFromSrgb(float coded);
float srgbFromLinear(float linear);

/// From what a camera without errors sees to what the robot's camera gives. What lens, shutter and noise need is
/// computed once, here. process() may be called from several threads.
class CameraPipeline {
 public:
  /// Throws InputError if a number is out of its bounds or the lens folds the picture over.
  explicit CameraPipeline(CameraSpec spec);
  ~CameraPipeline();
  CameraPipeline(CameraPipeline&&) noexcept;
  CameraPipeline& operator=(CameraPipeline&&) noexcept;

  const CameraSpec& spec() const;
  /// What to render: wider than the sensor where the lens looks further.
  Pinhole pinhole() const;
  /// When, in seconds from the frame's nominal time, which is the middle of the exposure of the middle row. In order.
  std::vector<double> moments_s() const;

  /// Which rows of each moment's picture process() reads: those that the shutter exposed then, of the middle one all,
  /// for the truth.
  std::vector<PictureRows> rows() const;

  /// One picture for each of moments_s(), of the size of pinhole(); breaking that is a fault of the program.
  /// The same for the same (seed, frameNumber), whatever was processed before.
  CameraFrame process(std::span<const PinholePicture> moments, std::uint64_t frameNumber) const;

  /// The picture after a stage that is on: 3 a pixel, coded for showing.
  using StageWatcher = std::function<void(CameraStage, std::span<const std::uint8_t> rgb)>;
  CameraFrame process(std::span<const PinholePicture> moments, std::uint64_t frameNumber,
                      const StageWatcher& watcher) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace btr
