// The lens against OpenCV's own projection.
#include "core/camera/stages/lens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "core/camera/stages/brown.h"
#include "core/spec/random.h"
#include "tests/camera/pictures.h"
#include "tests/refusal.h"

namespace btr::test {
namespace {

const BrownTerms barrel{-0.25, 0.08, -0.01, 0.002, -0.003};
const cv::Vec<double, 5> barrelInOpenCv(-0.25, 0.08, 0.002, -0.003, -0.01);  // k1 k2 p1 p2 k3

TEST(CameraLens, BendsAsOpenCvProjects) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const double x = random.uniform(-0.6, 0.6), y = random.uniform(-0.6, 0.6);
    std::vector<cv::Point2d> projected;
    cv::projectPoints(std::vector<cv::Point3d>{{x, y, 1}}, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), cv::Matx33d::eye(),
                      barrelInOpenCv, projected);
    const auto ours = distorted(barrel, x, y);
    EXPECT_NEAR(ours[0], projected[0].x, 1e-12);
    EXPECT_NEAR(ours[1], projected[0].y, 1e-12);
  }
}

TEST(CameraLens, StraightensWhatItBent) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const double x = random.uniform(-0.6, 0.6), y = random.uniform(-0.6, 0.6);
    const auto seen = distorted(barrel, x, y);
    const auto back = undistorted(barrel, seen, seen);
    ASSERT_TRUE(back);
    EXPECT_NEAR((*back)[0], x, 1e-9);
    EXPECT_NEAR((*back)[1], y, 1e-9);
    std::vector<cv::Point2d> theirs;
    cv::undistortPoints(std::vector<cv::Point2d>{{seen[0], seen[1]}}, theirs, cv::Matx33d::eye(), barrelInOpenCv,
                        cv::noArray(), cv::noArray(), cv::TermCriteria(cv::TermCriteria::COUNT, 200, 0));
    EXPECT_NEAR((*back)[0], theirs[0].x, 1e-6);
    EXPECT_NEAR((*back)[1], theirs[0].y, 1e-6);
  }
}

CameraSpec barrelCamera() {
  return with(plainCamera(128, 96), CameraStage::lens,
              {{"k1", -0.25}, {"k2", 0.08}, {"k3", -0.01}, {"p1", 0.002}, {"p2", -0.003}});
}

// The colours tell where a pixel looked: red is the ideal x, green the ideal y, both of which grow linearly, so that
// between pixels nothing is lost.
TEST(CameraLens, EachPixelShowsWhatOpenCvSaysItLooksAt) {
  const CameraSpec spec = barrelCamera();
  const CameraPipeline camera(spec);
  const Pinhole wide = camera.pinhole();
  EXPECT_GT(wide.width, spec.width);
  EXPECT_GT(wide.height, spec.height);
  const PinholePicture ramp = drawn(wide, [&](int x, int y, float* rgb) {
    rgb[0] = static_cast<float>(x) / 255;
    rgb[1] = static_cast<float>(y) / 255;
    rgb[2] = 0;
  });
  const CameraFrame frame = processOne(camera, ramp);
  std::vector<cv::Point2d> pixels, ideal;
  for (int y = 0; y < spec.height; ++y)
    for (int x = 0; x < spec.width; ++x) pixels.emplace_back(x, y);
  const cv::Matx33d sensor(spec.focal_px, 0, spec.centreX_px, 0, spec.focal_px, spec.centreY_px, 0, 0, 1);
  const cv::Matx33d rendered(wide.focal_px, 0, wide.centreX_px, 0, wide.focal_px, wide.centreY_px, 0, 0, 1);
  cv::undistortPoints(pixels, ideal, sensor, barrelInOpenCv, cv::noArray(), rendered,
                      cv::TermCriteria(cv::TermCriteria::COUNT, 100, 0));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const int x = static_cast<int>(pixels[i].x), y = static_cast<int>(pixels[i].y);
    EXPECT_NEAR(pixelOf(frame, x, y, 0), ideal[i].x, 0.51);  // half of a byte
    EXPECT_NEAR(pixelOf(frame, x, y, 1), ideal[i].y, 0.51);
  }
}

TEST(CameraLens, TruthGoesThroughTheSameLens) {
  const CameraSpec spec = barrelCamera();
  const CameraPipeline camera(spec);
  const Pinhole wide = camera.pinhole();
  // A wall 2 m away, and a square object 1 m away at an ideal place.
  PinholePicture picture = flat(wide, 0, 0, 0);
  const int left = 100, top = 60, side = 21;
  for (int y = 0; y < wide.height; ++y)
    for (int x = 0; x < wide.width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y * wide.width + x);
      const bool object = x >= left && x < left + side && y >= top && y < top + side;
      picture.depth_m[i] = object ? 1.0f : 2.0f;
      picture.object[i] = object ? 3 : 0;
      if (object) picture.rgb[3 * i] = 1;
    }
  const CameraFrame frame = processOne(camera, picture);
  ASSERT_EQ(frame.truth.seen.size(), 1u);
  const SeenObject& seen = frame.truth.seen[0];
  EXPECT_EQ(seen.object, 3);
  int pixels = 0;
  for (std::size_t i = 0; i < frame.truth.object.size(); ++i) {
    const bool object = frame.truth.object[i] == 3;
    pixels += object;
    EXPECT_EQ(frame.truth.depth_m[i], object ? 1.0f : 2.0f);
    if (object) {
      EXPECT_GE(frame.rgb[3 * i], 64);
    }  // at least half in both directions
  }
  EXPECT_EQ(seen.pixels, pixels);
  // The middle of the object, through OpenCV's lens.
  const double middleX = left + (side - 1) / 2.0, middleY = top + (side - 1) / 2.0;
  const auto there =
      distorted(barrel, (middleX - wide.centreX_px) / wide.focal_px, (middleY - wide.centreY_px) / wide.focal_px);
  EXPECT_NEAR(seen.centreX_px, spec.centreX_px + spec.focal_px * there[0], 0.5);
  EXPECT_NEAR(seen.centreY_px, spec.centreY_px + spec.focal_px * there[1], 0.5);
  EXPECT_NEAR((seen.left + seen.right) / 2.0, seen.centreX_px, 0.75);
  EXPECT_NEAR((seen.top + seen.bottom) / 2.0, seen.centreY_px, 0.75);
  const double slant =
      std::hypot(1.0, (middleX - wide.centreX_px) / wide.focal_px, (middleY - wide.centreY_px) / wide.focal_px);
  EXPECT_NEAR(seen.distance_m, slant, 0.01);
}

TEST(CameraLens, ALensThatFoldsIsRefused) {
  // r(1 − r²) is at most 0.385 (at r = 0.577); the corner of this sensor lies at 0.614.
  const CameraSpec folding = with(plainCamera(), CameraStage::lens, {{"k1", -1}});
  EXPECT_THAT(refusal([&] { CameraPipeline{folding}; }),
              ::testing::HasSubstr("test /stages/lens: a picture that folds"));
}

}  // namespace
}  // namespace btr::test
