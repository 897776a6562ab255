// YCbCr, classes and JPEG.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/camera/picture_file.h"
#include "core/camera/stages/bytes.h"
#include "core/camera/stages/classes.h"
#include "tests/camera/pictures.h"

namespace btr::test {
namespace {

using ::testing::ElementsAre;

struct KnownColour {
  std::array<float, 3> rgb;
  std::array<int, 3> studio, full;
};

// The studio values of 100 % colour bars in BT.601 (in all tables of it, e.g. ITU-R BT.801); full range by JFIF 1.02.
const std::vector<KnownColour> knownColours{
    {{0, 0, 0}, {16, 128, 128}, {0, 128, 128}},  {{1, 1, 1}, {235, 128, 128}, {255, 128, 128}},
    {{1, 0, 0}, {81, 90, 240}, {76, 85, 255}},   {{0, 1, 0}, {145, 54, 34}, {150, 44, 21}},
    {{0, 0, 1}, {41, 240, 110}, {29, 255, 107}}, {{1, 1, 0}, {210, 16, 146}, {226, 0, 149}},
    {{0, 1, 1}, {170, 166, 16}, {179, 171, 0}},  {{1, 0, 1}, {106, 202, 222}, {105, 212, 235}},
};

TEST(CameraYcbcr, HasTheKnownValuesOfPrimaries) {
  for (const bool studio : {false, true}) {
    const YcbcrCode code(studio);
    for (const KnownColour& known : knownColours) {
      const auto coded = code.coded(known.rgb[0], known.rgb[1], known.rgb[2]);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(toByte(coded[c]), (studio ? known.studio : known.full)[c])
            << studio << known.rgb[0] << known.rgb[1] << known.rgb[2];
    }
  }
}

TEST(CameraYcbcr, AgreesWithOpenCv) {
  const CameraSpec spec = with(plainCamera(), CameraStage::ycbcr);
  const YcbcrCode code(false);
  const CameraPipeline plain(plainCamera());
  const CameraFrame frame = processOne(plain, varied(plain.pinhole()));
  const cv::Mat rgb(frame.height, frame.width, CV_8UC3, const_cast<std::uint8_t*>(frame.rgb.data()));
  cv::Mat theirs;
  cv::cvtColor(rgb, theirs, cv::COLOR_RGB2YCrCb);
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const auto ours = code.coded(pixelOf(frame, x, y, 0) / 255.0f, pixelOf(frame, x, y, 1) / 255.0f,
                                   pixelOf(frame, x, y, 2) / 255.0f);
      const auto their = theirs.at<cv::Vec3b>(y, x);
      EXPECT_NEAR(toByte(ours[0]), their[0], 1);
      EXPECT_NEAR(toByte(ours[1]), their[2], 1);
      EXPECT_NEAR(toByte(ours[2]), their[1], 1);
    }
}

TEST(CameraYcbcr, PairsShareTheirColourAndKeepTheirLight) {
  const CameraPipeline camera(with(plainCamera(8, 8), CameraStage::ycbcr));
  const PinholePicture picture = drawn(camera.pinhole(), [](int x, int, float* rgb) { rgb[x % 2 == 0 ? 0 : 2] = 1; });
  const CameraFrame frame = processOne(camera, picture);
  ASSERT_EQ(frame.ycbcr.size(), 2u * 8 * 8);
  // Red and blue: Y 76 and 29, Cb (84.97 + 255.5)/2, Cr (255.5 + 107.26)/2.
  EXPECT_EQ(frame.ycbcr[0], 76);
  EXPECT_EQ(frame.ycbcr[1], 170);
  EXPECT_EQ(frame.ycbcr[2], 29);
  EXPECT_EQ(frame.ycbcr[3], 181);
  // Shown, their luma is kept where no channel leaves its range.
  const CameraFrame grey = processOne(camera, flat(camera.pinhole(), 0.25f, 0.5f, 0.5f));
  const double luma = 0.299 * pixelOf(grey, 0, 0, 0) + 0.587 * pixelOf(grey, 0, 0, 1) + 0.114 * pixelOf(grey, 0, 0, 2);
  EXPECT_NEAR(luma, grey.ycbcr[0], 1);
  EXPECT_NEAR(pixelOf(grey, 1, 3, 0), 64, 2);
  EXPECT_NEAR(pixelOf(grey, 1, 3, 1), 128, 2);
}

CameraSpec classCamera() {
  CameraSpec spec = with(plainCamera(), CameraStage::classes);
  spec.classes = {{"orange", {{{60, 40, 180}, {200, 90, 240}}}},
                  {"grey", {{{0, 120, 120}, {99, 136, 136}}, {{101, 120, 120}, {255, 136, 136}}}},
                  {"all", {{{0, 0, 0}, {255, 255, 255}}}}};
  return spec;
}

TEST(CameraClasses, BoundsBelongToTheirBoxAndTheFirstBoxWins) {
  const ColourTable table(classCamera());
  EXPECT_EQ(table.classOf(60, 40, 180), 1);
  EXPECT_EQ(table.classOf(200, 90, 240), 1);
  EXPECT_EQ(table.classOf(59, 40, 180), 3);
  EXPECT_EQ(table.classOf(60, 91, 180), 3);
  EXPECT_EQ(table.classOf(99, 128, 128), 2);
  EXPECT_EQ(table.classOf(100, 128, 128), 3);
  EXPECT_EQ(table.classOf(101, 136, 120), 2);
}

// Every 5th value of each channel against the definition.
TEST(CameraClasses, IsWhatTheBoxesSay) {
  const CameraSpec spec = classCamera();
  const ColourTable table(spec);
  for (int y = 0; y < 256; y += 5)
    for (int cb = 0; cb < 256; cb += 5)
      for (int cr = 0; cr < 256; cr += 5) {
        int expected = 0;
        for (std::size_t i = spec.classes.size(); i-- > 0;)
          for (const ColourBox& box : spec.classes[i].boxes)
            if (y >= box.least[0] && y <= box.most[0] && cb >= box.least[1] && cb <= box.most[1] &&
                cr >= box.least[2] && cr <= box.most[2])
              expected = static_cast<int>(i) + 1;
        ASSERT_EQ(
            table.classOf(static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(cb), static_cast<std::uint8_t>(cr)),
            expected);
      }
}

TEST(CameraClasses, GoThroughThePipelineWithAndWithoutYcbcr) {
  for (const bool ycbcr : {false, true}) {
    CameraSpec spec = classCamera();
    spec[CameraStage::ycbcr].on = ycbcr;
    const CameraPipeline camera(spec);
    // (230, 120, 20): Y 141, Cb 60, Cr 191.
    const CameraFrame frame = processOne(camera, flat(camera.pinhole(), 230 / 255.0f, 120 / 255.0f, 20 / 255.0f));
    EXPECT_EQ(frame.classes, std::vector<std::uint8_t>(64 * 48, 1));
    const RgbPicture shown = classPicture(frame.width, frame.height, frame.classes);
    EXPECT_EQ(shown.rgb.size(), 3u * 64 * 48);
  }
}

TEST(CameraJpeg, IsAFileThatDecodesToWhatIsShown) {
  const CameraPipeline camera(with(plainCamera(), CameraStage::jpeg, {{"quality", 90}}));
  const CameraFrame frame = processOne(camera, flat(camera.pinhole(), 0.2f, 0.6f, 0.4f));
  ASSERT_GT(frame.jpeg.size(), 100u);
  EXPECT_EQ(frame.jpeg[0], 0xFF);
  EXPECT_EQ(frame.jpeg[1], 0xD8);
  const cv::Mat decoded = cv::imdecode(frame.jpeg, cv::IMREAD_COLOR);
  ASSERT_EQ(decoded.cols, 64);
  ASSERT_EQ(decoded.rows, 48);
  const auto bgr = decoded.at<cv::Vec3b>(20, 20);
  EXPECT_EQ(pixelOf(frame, 20, 20, 0), bgr[2]);
  EXPECT_EQ(pixelOf(frame, 20, 20, 2), bgr[0]);
  EXPECT_NEAR(bgr[2], 51, 3);
  EXPECT_NEAR(bgr[1], 153, 3);
  EXPECT_NEAR(bgr[0], 102, 3);
}

TEST(CameraJpeg, LowerQualityIsSmaller) {
  const auto size = [](double quality) {
    const CameraPipeline camera(with(plainCamera(), CameraStage::jpeg, {{"quality", quality}}));
    return processOne(camera, varied(camera.pinhole())).jpeg.size();
  };
  EXPECT_LT(size(20), size(60));
  EXPECT_LT(size(60), size(95));
}

}  // namespace
}  // namespace btr::test
