#include "core/camera/camera_spec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/camera/camera_pipeline.h"
#include "tests/camera/pictures.h"
#include "tests/refusal.h"

namespace btr::test {
namespace {

using ::testing::HasSubstr;

std::string cameraText(const std::string& more) {
  return R"({"format": "uchilsim-camera-1", "name": "a", "width_px": 64, "height_px": 48, "focal_px": 60)" + more + "}";
}

CameraSpec readCamera(const std::string& more) { return cameraFromJson(cameraText(more), "a.json"); }

std::string refusedCamera(const std::string& more) {
  return refusal([&] { readCamera(more); });
}

TEST(CameraSpecFile, ShippedCamerasAreReadAndWrittenAgain) {
  for (const char* name : {"ers7", "ers7-416x320", "ers210"}) {
    const CameraSpec spec = loadCamera(std::string(SOURCE_DIR "/resources/cameras/") + name + ".json");
    const std::string text = toJsonText(spec);
    EXPECT_EQ(toJsonText(cameraFromJson(text, name)), text);
    EXPECT_EQ(spec.mount.link, "HEAD");
    EXPECT_EQ(spec.classes.size(), 8u);
    EXPECT_FALSE(spec.notes.empty());
    EXPECT_NO_THROW(CameraPipeline{spec});
  }
}

// 56.9° × 45.2° and 57.6° × 47.8° (aibo's manual): half the picture over the focal length is the tangent of half of it.
TEST(CameraSpecFile, ShippedCamerasSeeTheAngleOfTheManual) {
  const auto angles = [](const char* name) {
    const CameraSpec s = loadCamera(std::string(SOURCE_DIR "/resources/cameras/") + name + ".json");
    const auto degrees = [&](int pixels) { return 2 * std::atan(pixels / 2.0 / s.focal_px) * 180 / M_PI; };
    return std::pair{degrees(s.width), degrees(s.height)};
  };
  for (const char* name : {"ers7", "ers7-416x320"}) {
    EXPECT_NEAR(angles(name).first, 56.9, 0.1);
    EXPECT_NEAR(angles(name).second, 45.2, 0.1);
  }
  EXPECT_NEAR(angles("ers210").first, 57.6, 0.5);  // its pixels are not quite square
  EXPECT_NEAR(angles("ers210").second, 47.8, 0.5);
}

TEST(CameraSpecFile, WhatIsLeftOutHasItsDefault) {
  const CameraSpec spec = readCamera(R"(, "stages": {"gamma": {}, "jpeg": {"on": false, "quality": 30}})");
  EXPECT_DOUBLE_EQ(spec.centreX_px, 31.5);
  EXPECT_DOUBLE_EQ(spec.centreY_px, 23.5);
  EXPECT_TRUE(spec[CameraStage::gamma].on);
  EXPECT_DOUBLE_EQ(spec.number(CameraStage::gamma, "gamma"), 2.2);
  EXPECT_FALSE(spec[CameraStage::jpeg].on);
  EXPECT_DOUBLE_EQ(spec.number(CameraStage::jpeg, "quality"), 30);
  EXPECT_FALSE(spec[CameraStage::lens].on);
}

TEST(CameraSpecFile, WrongFilesAreRefusedWithPlaceValueAndWhatIsAllowed) {
  EXPECT_THAT(refusedCamera(R"(, "stages": {"lens": {"k1": 3}})"),
              HasSubstr("a.json /stages/lens/k1: 3 is not allowed; -2 to 2"));
  EXPECT_THAT(refusedCamera(R"(, "stages": {"lens": {"k4": 0}})"), HasSubstr("k4"));
  EXPECT_THAT(refusedCamera(R"(, "stages": {"fog": {}})"), HasSubstr("fog"));
  EXPECT_THAT(refusedCamera(R"(, "stages": {"ycbcr": {"range": "half"}})"), HasSubstr("one of full, studio"));
  EXPECT_THAT(refusedCamera(R"(, "stages": {"shutter": {"moments": 2.5}})"), HasSubstr("whole numbers 1 to 64"));
  EXPECT_THAT(refusedCamera(R"(, "stages": {"classes": {}})"), HasSubstr("at least one of /classes"));
  EXPECT_THAT(refusedCamera(R"(, "classes": [{"name": "a", "boxes": [{"y": [9, 3]}]}])"),
              HasSubstr("the least before the most"));
  EXPECT_THAT(refusedCamera(R"(, "classes": [{"name": "a", "boxes": [{"cb": [0, 256]}]}])"),
              HasSubstr("whole numbers 0 to 255"));
  EXPECT_THAT(refusedCamera(R"(, "mount": {"link": "HEAD", "orientation_wxyz": [1, 1, 0, 0]})"),
              HasSubstr("unit quaternion"));
  EXPECT_THAT(refusal([] { cameraFromJson(R"({"format": "uchilsim-camera-2"})", "b.json"); }),
              HasSubstr("b.json /format"));
  CameraSpec odd = plainCamera(63, 48);
  odd[CameraStage::ycbcr].on = true;
  EXPECT_THAT(refusal([&] { CameraPipeline{odd}; }), HasSubstr("test /width_px: 63 is not allowed; an even number"));
}

TEST(CameraSpecFile, NineClassesAreRefused) {
  std::string classes = R"(, "classes": [)";
  for (int i = 0; i < 9; ++i) classes += std::string(i ? "," : "") + R"({"name": "c", "boxes": [{}]})";
  EXPECT_THAT(refusedCamera(classes + "]"), HasSubstr("a.json /classes: 9 classes is not allowed; at most 8"));
}

TEST(CameraSpecFile, EveryStageIsFoundByItsName) {
  for (const CameraStage stage : cameraStages()) {
    EXPECT_EQ(cameraStageNamed(nameOf(stage)), stage);
    EXPECT_FALSE(meaningOf(stage).empty());
    for (const Parameter& p : parametersOf(stage)) {
      EXPECT_LE(p.minimum, p.byDefault) << p.name;
      EXPECT_GE(p.maximum, p.byDefault) << p.name;
    }
  }
  EXPECT_FALSE(cameraStageNamed("fog"));
}

}  // namespace
}  // namespace btr::test
