// Colour stages of a concealed camera of our own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iostream>

#include "core/camera/twin.h"
#include "core/spec/random.h"
#include "tests/camera/pictures.h"
#include "tests/refusal.h"

namespace btr::test {
namespace {

CameraSpec thoughtCamera() {
  CameraSpec spec = loadCamera(SOURCE_DIR "/resources/cameras/ers7.json");
  spec[CameraStage::shutter].on = spec[CameraStage::classes].on = spec[CameraStage::jpeg].on = false;
  for (const CameraStage stage : {CameraStage::vignetting, CameraStage::colour, CameraStage::noise, CameraStage::gamma})
    spec[stage] = {};
  return spec;
}

CameraSpec concealedColours(Random& random) {
  CameraSpec spec = thoughtCamera();
  spec[CameraStage::vignetting] = {true, {{"r2", random.uniform(-0.3, -0.1)}, {"r4", random.uniform(-0.15, -0.05)}}};
  spec[CameraStage::colour] = {true,
                               {{"red_gain", random.uniform(0.7, 1.2)},
                                {"green_gain", random.uniform(0.8, 1.1)},
                                {"blue_gain", random.uniform(0.7, 1.2)},
                                {"red_r2", random.uniform(-0.2, -0.05)},
                                {"blue_r2", random.uniform(0.1, 0.3)}}};
  spec[CameraStage::noise] = {true,
                              {{"read", random.uniform(0.003, 0.008)},
                               {"shot", random.uniform(0.0003, 0.001)},
                               {"pattern_offset", 0},
                               {"pattern_gain", 0}}};
  spec[CameraStage::gamma] = {true, {{"gamma", random.uniform(1.8, 2.6)}}};
  spec.seed = random.next();
  return spec;
}

/// Patches of many colours and brightnesses.
PinholePicture patches(const Pinhole& pinhole, Random& random) {
  constexpr int side = 20;  // pixels
  const int columns = pinhole.width / side + 1, rows = pinhole.height / side + 1;
  std::vector<float> colours;
  for (int i = 0; i < 3 * columns * rows; ++i) colours.push_back(static_cast<float>(random.uniform(0.05, 0.9)));
  return drawn(pinhole, [&](int x, int y, float* rgb) {
    for (int c = 0; c < 3; ++c) rgb[c] = colours[static_cast<std::size_t>(3 * (y / side * columns + x / side) + c)];
  });
}

std::vector<ColourView> photographedPatches(const CameraSpec& hidden, int count, Random& random) {
  const CameraPipeline camera(hidden);
  std::vector<ColourView> views;
  for (int i = 0; i < count; ++i) {
    PinholePicture scene = patches(camera.pinhole(), random);
    CameraFrame frame = processOne(camera, scene, static_cast<std::uint64_t>(i));
    views.push_back({"photo" + std::to_string(i), {frame.width, frame.height, std::move(frame.rgb)}, std::move(scene)});
  }
  return views;
}

double hiddenNumber(const CameraSpec& spec, const std::string& name) {
  const std::size_t slash = name.find('/');
  return spec.number(*cameraStageNamed(name.substr(0, slash)), name.substr(slash + 1));
}

class ConcealedColours : public ::testing::TestWithParam<int> {};

TEST_P(ConcealedColours, AreFoundWithinTheStatedUncertainty) {
  Random random = Random::forPurpose(static_cast<std::uint64_t>(GetParam()), "concealed colours");
  const CameraSpec hidden = concealedColours(random);
  const CameraTwin twin = fitColour(thoughtCamera(), photographedPatches(hidden, 6, random));
  for (const TwinNumber& number : twin.numbers) {
    const double truth = hiddenNumber(hidden, number.name);
    std::cout << number.name << " " << truth << " found " << number.after << " ± " << number.deviation
              << (number.identified ? "\n" : " not told\n");
    EXPECT_NEAR(number.after, truth, 4 * number.deviation) << number.name;
  }
  std::cout << "held out " << twin.heldOutBefore << " before, " << twin.heldOutAfter << " after; noise " << twin.noise
            << "\n";
  EXPECT_LT(twin.heldOutAfter, 1.1 * twin.noise);
  EXPECT_GT(twin.heldOutBefore, 3 * twin.heldOutAfter);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ConcealedColours, ::testing::Values(1, 2, 3));

TEST(ColourTwin, RefusesWhatDoesNotFit) {
  Random random(5);
  const CameraSpec hidden = concealedColours(random);
  std::vector<ColourView> views = photographedPatches(hidden, 2, random);
  const auto said = [&] { return refusal([&] { fitColour(thoughtCamera(), views); }); };
  const RgbPicture photo = views[1].photo;
  views[1].photo.width = 100;
  EXPECT_THAT(said(), ::testing::HasSubstr("photo1: 100x160 pixels is not allowed; the sensor's 208x160"));
  views[1].photo = photo;
  views[1].scene.pinhole.width -= 1;
  EXPECT_THAT(said(), ::testing::HasSubstr("photo1: a rendering of"));
  views.pop_back();
  EXPECT_THAT(said(), ::testing::HasSubstr("at least 2"));
}

TEST(ColourTwin, RefusesPhotographsThatAreBlack) {
  Random random(6);
  std::vector<ColourView> views = photographedPatches(concealedColours(random), 2, random);
  for (ColourView& view : views) std::fill(view.photo.rgb.begin(), view.photo.rgb.end(), std::uint8_t{0});
  EXPECT_THAT(refusal([&] { fitColour(thoughtCamera(), views); }), ::testing::HasSubstr("0 usable pixels"));
}

}  // namespace
}  // namespace btr::test
