// Pictures, videos and truth, written and read back.
#include "core/camera/picture_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/camera/truth_file.h"
#include "core/camera/video_file.h"
#include "core/spec/csv.h"
#include "core/spec/json_reader.h"
#include "core/spec/random.h"
#include "core/spec/system/process.h"
#include "tests/camera/pictures.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr::test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class CameraFiles : public ::testing::Test {
 protected:
  std::string file(const char* name) const { return (folder_ / name).string(); }

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

RgbPicture colourful(int width, int height, int shift = 0) {
  RgbPicture picture{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (const int value : {x * 3 + shift, y * 5, x + y})
        picture.rgb.push_back(static_cast<std::uint8_t>(value % 256));
  return picture;
}

TEST_F(CameraFiles, PngIsReadBackWithTheSameBits) {
  const RgbPicture picture = colourful(31, 17);
  writePicture(file("a.PNG"), picture);
  const RgbPicture back = readPicture(file("a.PNG"));
  EXPECT_EQ(back.width, 31);
  EXPECT_EQ(back.height, 17);
  EXPECT_EQ(back.rgb, picture.rgb);
}

TEST_F(CameraFiles, JpegIsReadBackNearly) {
  const RgbPicture even{32, 16, std::vector<std::uint8_t>(3 * 32 * 16, 90)};
  writePicture(file("a.jpg"), even, 95);
  for (const std::uint8_t value : readPicture(file("a.jpg")).rgb) EXPECT_NEAR(value, 90, 2);
}

TEST_F(CameraFiles, NothingIsLeftBesideAPicture) {
  writePicture(file("a.png"), colourful(8, 8));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(CameraFiles, WhatIsNoPictureIsRefused) {
  EXPECT_THAT(refusal([&] { readPicture(file("none.png")); }), HasSubstr("none.png"));
  writeFile(file("text.png"), "no picture");
  EXPECT_THAT(refusal([&] { readPicture(file("text.png")); }), HasSubstr("text.png: is no picture; a PNG or JPEG"));
  writeFile(file("empty.png"), "");
  EXPECT_THAT(refusal([&] { readPicture(file("empty.png")); }), HasSubstr("is empty"));
  EXPECT_THAT(refusal([&] { writePicture(file("a.bmp"), colourful(8, 8)); }), HasSubstr(".png, .jpg or .jpeg"));
  EXPECT_THAT(refusal([&] { writePicture(file("no/a.png"), colourful(8, 8)); }), HasSubstr("no/a.png"));
  EXPECT_THAT(refusal([&] { writePicture(file("a.jpg"), colourful(8, 8), 0); }), HasSubstr("1 to 100"));
}

TEST_F(CameraFiles, VideoHasAllItsFrames) {
  for (const char* name : {"a.mp4", "a.avi", "a.mkv"}) {
    VideoWriter video(file(name), 208, 160, 30);
    EXPECT_THAT(video.codec(), ::testing::AnyOf("H.264", "MPEG-4"));
    for (int i = 0; i < 45; ++i) video.add(colourful(208, 160, 2 * i));
    EXPECT_EQ(video.frames(), 45);
    EXPECT_FALSE(fs::exists(file(name)));
    video.finish();
    const VideoFacts facts = readVideoFacts(file(name));
    EXPECT_EQ(facts.frames, 45) << name;
    EXPECT_EQ(facts.width, 208);
    EXPECT_EQ(facts.height, 160);
    EXPECT_NEAR(facts.frameRate_hz, 30, 0.01);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 3);
}

TEST_F(CameraFiles, AVideoThatIsNotFinishedLeavesNothing) {
  {
    VideoWriter video(file("a.mp4"), 64, 48, 30);
    video.add(colourful(64, 48));
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(CameraFiles, AVideoThatCannotBeIsRefused) {
  const auto open = [&](const char* name, int width = 64) {
    return refusal([&] { VideoWriter(file(name), width, 48, 30); });
  };
  EXPECT_THAT(open("a.wmv"), HasSubstr("the ending \".wmv\" is not allowed; .mp4, .avi or .mkv"));
  EXPECT_THAT(open("no/a.mp4"), HasSubstr("there is no folder"));
  EXPECT_THAT(open("a.mp4", 63), HasSubstr("an even number"));
  EXPECT_THAT(refusal([&] { VideoWriter(file("a.mp4"), 64, 48, 30).finish(); }), HasSubstr("without a frame"));
  writeFile(file("text.mp4"), "no video");
  EXPECT_THAT(refusal([&] { readVideoFacts(file("text.mp4")); }), HasSubstr("is no video"));
}

// A limit of the size of files is to the writer what a full disk is.
TEST_F(CameraFiles, AVideoThatTheDiskDoesNotTakeIsRefused) {
  beginProgram();  // without it the system ends a program that goes beyond the limit
  Random random(1);
  RgbPicture snow{208, 160, std::vector<std::uint8_t>(3 * 208 * 160)};
  VideoWriter video(file("a.mp4"), 208, 160, 30);
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{20'000, before.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  for (int i = 0; i < 60; ++i) {
    for (std::uint8_t& byte : snow.rgb) byte = static_cast<std::uint8_t>(random.below(256));
    video.add(snow);
  }
  const std::string said = refusal([&] { video.finish(); });
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_THAT(said, HasSubstr("of 60 frames could be written"));
  EXPECT_FALSE(fs::exists(file("a.mp4")));
}

TEST_F(CameraFiles, TruthIsATableWithAColumnForEachNumber) {
  TruthTable table({"ball", "red1"}, {"red1.neck.position_rad"});
  PictureTruth truth;
  truth.seen.push_back({2, 12, 3, 4, 8, 9, 5.5, 6.25, 1.5});
  table.add(7, 0.25, truth, {-0.5});
  table.add(8, 0.28125, {}, {0.5});
  table.write(file("truth.csv"));
  std::istringstream text(readFile(file("truth.csv")));
  CsvReader reader(text, "truth.csv");
  std::vector<std::string> header, row;
  ASSERT_TRUE(reader.next(header));
  EXPECT_EQ(header.size(), 3u + 2 * 8);
  EXPECT_EQ(header[2], "red1.neck.position_rad");
  EXPECT_EQ(header[3], "ball.pixels");
  EXPECT_EQ(header[11], "red1.pixels");
  ASSERT_TRUE(reader.next(row));
  EXPECT_EQ(row, (std::vector<std::string>{"7", "0.25", "-0.5", "0", "", "", "", "", "", "", "", "12", "3", "4", "8",
                                           "9", "5.5", "6.25", "1.5"}));
  ASSERT_TRUE(reader.next(row));
  ASSERT_EQ(row.size(), 19u);
  EXPECT_EQ(row[3], "0");
  EXPECT_EQ(row[11], "0");
  EXPECT_FALSE(reader.next(row));
}

}  // namespace
}  // namespace btr::test
