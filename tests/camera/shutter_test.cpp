// Rolling shutter and motion blur of an edge that moves sideways at constant speed.
#include <gtest/gtest.h>

#include "core/camera/stages/shutter.h"
#include "tests/camera/pictures.h"

namespace btr::test {
namespace {

constexpr double edgeSpeed_px_s = 600, edgeAtZero_px = 40;

/// White to the left of the edge; the pixel that it lies in is partly white.
PinholePicture edgeAt(const Pinhole& pinhole, double t_s) {
  const double edge = edgeAtZero_px + edgeSpeed_px_s * t_s;
  return drawn(pinhole, [&](int x, int, float* rgb) {
    rgb[0] = rgb[1] = rgb[2] = static_cast<float>(std::min(std::max(edge - x + 0.5, 0.0), 1.0));
  });
}

CameraFrame movingEdge(const CameraSpec& spec) {
  const CameraPipeline camera(spec);
  std::vector<PinholePicture> moments;
  for (const double t : camera.moments_s()) moments.push_back(edgeAt(camera.pinhole(), t));
  return camera.process(moments, 0);
}

/// Where the edge lies in a row: all the white there is.
double whiteOfRow(const CameraFrame& frame, int y) {
  double white = 0;
  for (int x = 0; x < frame.width; ++x) white += pixelOf(frame, x, y, 0) / 255.0;
  return white - 0.5;
}

CameraSpec rollingCamera(double exposure_s, double readout_s, int moments) {
  return with(plainCamera(96, 64), CameraStage::shutter,
              {{"exposure_s", exposure_s},
               {"full_light_s", exposure_s},
               {"readout_s", readout_s},
               {"moments", static_cast<double>(moments)}});
}

TEST(CameraShutter, LeansByTheSpeedTimesTheReadOut) {
  const double readout_s = 0.03;
  const CameraFrame frame = movingEdge(rollingCamera(0.002, readout_s, 64));
  EXPECT_NEAR(whiteOfRow(frame, 63) - whiteOfRow(frame, 0), edgeSpeed_px_s * readout_s, 0.1);
  // In the middle of the picture it is where it is at the frame's time.
  EXPECT_NEAR((whiteOfRow(frame, 31) + whiteOfRow(frame, 32)) / 2, edgeAtZero_px, 0.1);
}

TEST(CameraShutter, BlursByTheSpeedTimesTheExposure) {
  const double exposure_s = 0.02;
  const CameraFrame frame = movingEdge(rollingCamera(exposure_s, 0, 64));
  // A ramp of that width: its slope is 1 over it, and the white on it grows in proportion.
  const double width_px = edgeSpeed_px_s * exposure_s;
  for (int x = 0; x < frame.width; ++x) {
    const double expected = std::min(std::max(0.5 - (x - edgeAtZero_px) / width_px, 0.0), 1.0);
    const bool onRamp = expected > 0.06 && expected < 0.94;  // its ends are rounded by a pixel
    if (onRamp) {
      EXPECT_NEAR(pixelOf(frame, x, 20, 0) / 255.0, expected, 0.015) << x;
    }
  }
  EXPECT_NEAR(whiteOfRow(frame, 20), edgeAtZero_px, 0.1);
}

TEST(CameraShutter, MomentsCoverAllRowsAndSharesAddUpToTheExposure) {
  const CameraSpec spec = rollingCamera(0.01, 0.03, 5);
  const Shutter shutter(spec);
  ASSERT_EQ(shutter.moments_s().size(), 5u);
  EXPECT_DOUBLE_EQ(shutter.moments_s()[2], 0);
  EXPECT_DOUBLE_EQ(shutter.moments_s()[4], 0.016);  // the middle of the last of five parts of 40 ms
  for (int y = 0; y < spec.height; ++y) {
    double sum = 0;
    for (const MomentShare& share : shutter.sharesOfRow(y)) sum += share.weight;
    EXPECT_NEAR(sum, 1, 1e-6);
  }
  // The first row is exposed from −20 to −10 ms: the first part (8 ms) and 2 ms of the second.
  const auto first = shutter.sharesOfRow(0);
  ASSERT_EQ(first.size(), 2u);
  EXPECT_NEAR(first[0].weight, 0.8, 1e-6);
  EXPECT_NEAR(first[1].weight, 0.2, 1e-6);
}

TEST(CameraShutter, HalfTheExposureIsHalfTheLight) {
  CameraSpec spec = rollingCamera(0.005, 0.03, 3);
  spec[CameraStage::shutter].values["full_light_s"] = 0.01;
  const CameraPipeline camera(spec);
  const std::vector<PinholePicture> moments(3, flat(camera.pinhole(), 0.8f, 0.4f, 0.2f));
  const CameraFrame frame = camera.process(moments, 0);
  EXPECT_EQ(pixelOf(frame, 10, 10, 0), 102);
  EXPECT_EQ(pixelOf(frame, 10, 10, 1), 51);
  EXPECT_EQ(pixelOf(frame, 10, 10, 2), 26);  // 25.5
}

TEST(CameraShutter, WithoutItOneMomentIsWanted) {
  EXPECT_EQ(CameraPipeline(plainCamera()).moments_s(), std::vector<double>{0});
}

}  // namespace
}  // namespace btr::test
