// The stages together: what is off does nothing, and the same frame has the same bits.
#include "core/camera/camera_pipeline.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/camera/pictures.h"

namespace btr::test {
namespace {

CameraSpec everything() {
  CameraSpec spec = loadCamera(SOURCE_DIR "/resources/cameras/ers7.json");
  for (const CameraStage stage : cameraStages()) spec[stage].on = true;
  return spec;
}

std::vector<PinholePicture> momentsOf(const CameraPipeline& camera) {
  return std::vector<PinholePicture>(camera.moments_s().size(), varied(camera.pinhole()));
}

void expectSame(const CameraFrame& a, const CameraFrame& b) {
  EXPECT_EQ(a.rgb, b.rgb);
  EXPECT_EQ(a.ycbcr, b.ycbcr);
  EXPECT_EQ(a.classes, b.classes);
  EXPECT_EQ(a.jpeg, b.jpeg);
}

TEST(CameraPipelineTogether, WithAllStagesOffGivesThePictureInBytes) {
  const CameraPipeline camera(plainCamera());
  const Pinhole same = camera.pinhole();
  EXPECT_EQ(same.width, 64);
  EXPECT_EQ(same.height, 48);
  EXPECT_EQ(same.centreX_px, 31.5);
  const PinholePicture picture = varied(same);
  const CameraFrame frame = processOne(camera, picture);
  EXPECT_TRUE(frame.linear);
  EXPECT_TRUE(frame.ycbcr.empty());
  EXPECT_TRUE(frame.classes.empty());
  EXPECT_TRUE(frame.jpeg.empty());
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) ASSERT_EQ(frame.rgb[i], std::lround(255 * picture.rgb[i]));
}

// A renderer may leave out the other rows.
TEST(CameraPipelineTogether, OnlyTheRowsThatItNamesAreRead) {
  for (const double readout_s : {0.0, 0.03})
    for (const double moments : {1.0, 2.0, 3.0, 9.0}) {
      CameraSpec spec = everything();
      spec[CameraStage::shutter].values["readout_s"] = readout_s;
      spec[CameraStage::shutter].values["moments"] = moments;
      const CameraPipeline camera(spec);
      std::vector<PinholePicture> pictures = momentsOf(camera);
      const CameraFrame expected = camera.process(pictures, 3);
      const std::vector<PictureRows> rows = camera.rows();
      ASSERT_EQ(rows.size(), pictures.size());
      const auto stride = static_cast<std::ptrdiff_t>(3 * camera.pinhole().width);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        ASSERT_GE(rows[i].first, 0);
        ASSERT_LT(rows[i].last, camera.pinhole().height);
        auto& rgb = pictures[i].rgb;
        std::fill(rgb.begin(), rgb.begin() + rows[i].first * stride, 1e6f);
        std::fill(rgb.begin() + (rows[i].last + 1) * stride, rgb.end(), 1e6f);
      }
      expectSame(camera.process(pictures, 3), expected);
      EXPECT_EQ(rows[rows.size() / 2].last - rows[rows.size() / 2].first + 1, camera.pinhole().height);
      // With a slow read-out the first moment lights the upper rows, the last the lower ones.
      if (readout_s > 0 && moments > 2) {
        EXPECT_LT(rows.front().last, camera.pinhole().height * 2 / 3);
        EXPECT_GT(rows.back().first, camera.pinhole().height / 3);
      }
    }
}

// Numbers of a stage that is off, however strange, change nothing.
TEST(CameraPipelineTogether, AStageThatIsOffChangesNothing) {
  const CameraPipeline plain(plainCamera());
  const CameraFrame expected = processOne(plain, varied(plain.pinhole()));
  for (const CameraStage stage : cameraStages()) {
    CameraSpec spec = plainCamera();
    for (const Parameter& p : parametersOf(stage)) spec[stage].values[p.name] = p.maximum;
    const CameraPipeline camera(spec);
    expectSame(processOne(camera, varied(camera.pinhole())), expected);
  }
}

TEST(CameraPipelineTogether, ALensWithoutTermsChangesNothingThatIsSeen) {
  const CameraPipeline plain(plainCamera()), lens(with(plainCamera(), CameraStage::lens));
  const auto ramp = [](int x, int y, float* rgb) { rgb[0] = static_cast<float>(x + y) / 255; };
  // The wider picture begins some pixels before the sensor does.
  const int left = static_cast<int>(std::lround(lens.pinhole().centreX_px - plain.pinhole().centreX_px));
  const int top = static_cast<int>(std::lround(lens.pinhole().centreY_px - plain.pinhole().centreY_px));
  const CameraFrame a = processOne(plain, drawn(plain.pinhole(), ramp));
  const CameraFrame b =
      processOne(lens, drawn(lens.pinhole(), [&](int x, int y, float* rgb) { ramp(x - left, y - top, rgb); }));
  EXPECT_EQ(a.rgb, b.rgb);
}

TEST(CameraPipelineTogether, TheSameFrameHasTheSameBitsInAnyOrder) {
  const CameraPipeline one(everything()), other(everything());
  const auto moments = momentsOf(one);
  const CameraFrame third = one.process(moments, 3);
  const CameraFrame fourth = one.process(moments, 4);
  expectSame(other.process(moments, 4), fourth);
  expectSame(other.process(moments, 3), third);
  EXPECT_NE(third.rgb, fourth.rgb);
  CameraSpec reseeded = everything();
  reseeded.seed = 99;
  EXPECT_NE(CameraPipeline(reseeded).process(moments, 3).rgb, third.rgb);
}

TEST(CameraPipelineTogether, AWatcherSeesEachStageThatIsOnOnceInOrder) {
  for (const bool all : {true, false}) {
    CameraSpec spec = everything();
    if (!all) spec[CameraStage::lens].on = spec[CameraStage::gamma].on = spec[CameraStage::jpeg].on = false;
    const CameraPipeline camera(spec);
    std::vector<CameraStage> watched, expected;
    for (const CameraStage stage : cameraStages())
      if (spec[stage].on) expected.push_back(stage);
    const auto moments = momentsOf(camera);
    const CameraFrame frame = camera.process(moments, 5, [&](CameraStage stage, std::span<const std::uint8_t> rgb) {
      watched.push_back(stage);
      EXPECT_EQ(rgb.size(), 3u * 208 * 160);
    });
    EXPECT_EQ(watched, expected);
    expectSame(frame, camera.process(moments, 5));
  }
}

TEST(CameraPipelineTogether, TruthCountsBoxesAndCentres) {
  const CameraPipeline camera(plainCamera());
  PinholePicture picture = flat(camera.pinhole(), 0, 0, 0);
  const auto put = [&](int x, int y, std::uint16_t object, float depth) {
    picture.object[static_cast<std::size_t>(y * 64 + x)] = object;
    picture.depth_m[static_cast<std::size_t>(y * 64 + x)] = depth;
  };
  put(10, 5, 2, 1);
  put(12, 5, 2, 1);
  put(11, 8, 2, 1);
  put(63, 47, 7, 3);
  const PictureTruth truth = processOne(camera, picture).truth;
  ASSERT_EQ(truth.seen.size(), 2u);
  EXPECT_EQ(truth.seen[0].object, 2);
  EXPECT_EQ(truth.seen[0].pixels, 3);
  EXPECT_EQ(truth.seen[0].left, 10);
  EXPECT_EQ(truth.seen[0].right, 12);
  EXPECT_EQ(truth.seen[0].top, 5);
  EXPECT_EQ(truth.seen[0].bottom, 8);
  EXPECT_DOUBLE_EQ(truth.seen[0].centreX_px, 11);
  EXPECT_DOUBLE_EQ(truth.seen[0].centreY_px, 6);
  EXPECT_EQ(truth.seen[1].object, 7);
  EXPECT_NEAR(truth.seen[1].distance_m, 3 * std::hypot(1, 31.5 / 64, 23.5 / 64), 1e-5);
}

TEST(CameraPipelineTogether, PicturesOfAnotherSizeAreAFault) {
  const CameraPipeline camera(plainCamera());
  EXPECT_THROW(processOne(camera, varied({32, 32, 10, 0, 0})), std::logic_error);
  EXPECT_THROW(camera.process({}, 0), std::logic_error);
}

// IEC 61966-2-1: 0.5 in light is 188 of 255, and the two curves undo each other.
TEST(CameraPipelineTogether, LinearLightIsCodedForShowing) {
  EXPECT_NEAR(255 * srgbFromLinear(0.5f), 187.52, 0.01);
  for (int i = 0; i <= 255; ++i)
    EXPECT_NEAR(srgbFromLinear(linearFromSrgb(static_cast<float>(i) / 255)) * 255, i, 1e-3);
  const CameraPipeline camera(plainCamera());
  EXPECT_EQ(shownRgb(processOne(camera, flat(camera.pinhole(), 0.5f, 0.5f, 0.5f)))[0], 188);
  const CameraPipeline coded(with(plainCamera(), CameraStage::gamma));
  const CameraFrame frame = processOne(coded, varied(coded.pinhole()));
  EXPECT_EQ(shownRgb(frame), frame.rgb);
}

}  // namespace
}  // namespace btr::test
