// A concealed camera of our own, known poses, and the pictures of a chessboard that OpenCV's documentation comes with.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>

#include "tests/camera/board_pictures.h"
#include "tests/refusal.h"

namespace btr::test {
namespace {

constexpr BoardPattern twinBoard{9, 6, 0.03};

CameraSpec nominalCamera() {
  CameraSpec spec = loadCamera(SOURCE_DIR "/resources/cameras/ers7-416x320.json");
  for (const CameraStage stage : cameraStages()) spec[stage].on = false;
  return spec;
}

/// Focal length, centre and lens as nobody but the test knows them; noise, gamma and the robot's bytes as well.
CameraSpec concealedCamera(Random& random) {
  CameraSpec spec = nominalCamera();
  spec.focal_px *= random.uniform(0.9, 1.1);
  spec.centreX_px += random.uniform(-8, 8);
  spec.centreY_px += random.uniform(-8, 8);
  spec[CameraStage::lens] = {true,
                             {{"k1", random.uniform(-0.35, -0.15)},
                              {"k2", random.uniform(0.05, 0.15)},
                              {"p1", random.uniform(-0.004, 0.004)},
                              {"p2", random.uniform(-0.004, 0.004)}}};
  spec[CameraStage::noise] = {true, {{"read", 0.004}, {"shot", 0.0006}}};
  spec[CameraStage::gamma].on = true;
  spec[CameraStage::ycbcr].on = true;
  return spec;
}

double truthOfNumber(const CameraSpec& spec, const std::string& name) {
  if (name == "focal_px") return spec.focal_px;
  if (name == "centre_x_px") return spec.centreX_px;
  if (name == "centre_y_px") return spec.centreY_px;
  return spec.number(CameraStage::lens, name);
}

/// Root mean square distance of the corners as they were found from where they are, of one photograph.
double cornerNoise_px(const PointView& view, const std::vector<std::array<double, 2>>& corners) {
  // The board looks the same when both of its ends are exchanged.
  double least = 1e9;
  for (const bool turned : {false, true}) {
    double square = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto& there = corners[turned ? corners.size() - 1 - i : i];
      square += std::pow(view.seen_px[i][0] - there[0], 2) + std::pow(view.seen_px[i][1] - there[1], 2);
    }
    least = std::min(least, std::sqrt(square / static_cast<double>(corners.size())));
  }
  return least;
}

struct Photographs {
  std::vector<PointView> views;
  double cornerNoise_px = 0;
};

Photographs photographed(const CameraSpec& hidden, int count, Random& random) {
  const CameraPipeline camera(hidden);
  Photographs photos;
  double square = 0;
  for (int i = 0; i < count; ++i) {
    const Eigen::Isometry3d place = randomPlace(random, hidden, twinBoard, 12);
    const CameraFrame frame =
        processOne(camera, boardSeen(camera.pinhole(), twinBoard, place), static_cast<std::uint64_t>(i));
    auto view = boardView({frame.width, frame.height, frame.rgb}, twinBoard, "photo" + std::to_string(i));
    if (!view) continue;
    square += std::pow(cornerNoise_px(*view, trueCorners(hidden, twinBoard, place)), 2);
    photos.views.push_back(std::move(*view));
  }
  photos.cornerNoise_px = std::sqrt(square / static_cast<double>(photos.views.size()));
  return photos;
}

class ConcealedCamera : public ::testing::TestWithParam<int> {};

// The twin sees photographs only. Bounds: four standard deviations that the twin states itself; and the error on
// photographs that no fit saw is that of finding the corners, which the test knows and the twin does not. A pose (6
// numbers) from 27 corners (54 numbers) adds 6/54 to its square; that of 5 photographs with 27 corners each deviates by
// 1/√(2·270), of which three are allowed.
TEST_P(ConcealedCamera, IsFoundWithinTheStatedUncertainty) {
  Random random = Random::forPurpose(static_cast<std::uint64_t>(GetParam()), "concealed camera");
  const CameraSpec hidden = concealedCamera(random);
  const Photographs photos = photographed(hidden, 20, random);
  ASSERT_GE(photos.views.size(), 16u);
  const CameraTwin twin = fitLens(nominalCamera(), photos.views);
  for (const TwinNumber& number : twin.numbers) {
    const double truth = truthOfNumber(hidden, number.name);
    std::cout << number.name << " " << truth << " found " << number.after << " ± " << number.deviation
              << (number.identified ? "\n" : " not told\n");
    if (number.identified) {
      EXPECT_NEAR(number.after, truth, 4 * number.deviation) << number.name;
    }
    if (!number.identified) {
      EXPECT_NEAR(0, truth, 4 * number.deviation) << number.name;
    }
  }
  std::cout << "held out " << twin.heldOutBefore << " px before, " << twin.heldOutAfter << " after; corners "
            << photos.cornerNoise_px << "\n";
  EXPECT_LT(twin.heldOutAfter, std::sqrt(1 + 6.0 / 54) * (1 + 3 / std::sqrt(540.0)) * photos.cornerNoise_px);
  EXPECT_GT(twin.heldOutBefore, 5 * twin.heldOutAfter);
}

INSTANTIATE_TEST_SUITE_P(Seeds, ConcealedCamera, ::testing::Values(1, 2, 3));

/// Exact points of known poses with noise of 0.1 px.
std::vector<PointView> posedViews(const CameraSpec& hidden, int count, Random& random) {
  std::vector<PointView> views;
  for (int i = 0; i < count; ++i) {
    const Eigen::Isometry3d place = randomPlace(random, hidden, twinBoard, 5);
    PointView view;
    view.name = "view" + std::to_string(i);
    view.pose = poseOf(place);
    for (int j = 0; j < twinBoard.rows; ++j)
      for (int k = 0; k < twinBoard.columns; ++k)
        view.points_m.push_back({k * twinBoard.square_m, j * twinBoard.square_m, 0});
    view.seen_px = trueCorners(hidden, twinBoard, place);
    for (auto& seen : view.seen_px)
      for (double& value : seen) value += 0.1 * random.normal();
    views.push_back(view);
  }
  return views;
}

TEST(LensTwin, UsesPosesThatAreKnown) {
  Random random(11);
  const CameraSpec hidden = concealedCamera(random);
  const CameraTwin twin = fitLens(nominalCamera(), posedViews(hidden, 12, random));
  for (const TwinNumber& number : twin.numbers)
    EXPECT_NEAR(number.identified ? number.after : 0, truthOfNumber(hidden, number.name), 4 * number.deviation)
        << number.name;
  EXPECT_NEAR(twin.heldOutAfter, 0.1 * std::sqrt(2.0), 0.02);  // of both directions together
}

// 12 views × 54 points × 2 numbers with a deviation of 0.1 px.
TEST(LensTwin, StatesTheUncertaintyThatRepetitionsShow) {
  Random random(12);
  const CameraSpec hidden = concealedCamera(random);
  constexpr int repetitions = 60;
  double square = 0;
  for (int i = 0; i < repetitions; ++i) {
    const CameraTwin twin = fitLens(nominalCamera(), posedViews(hidden, 12, random));
    const TwinNumber& focal = twin.numbers[0];
    square += std::pow((focal.after - hidden.focal_px) / focal.deviation, 2) / repetitions;
  }
  // The mean square of a standard normal deviates by √(2/n); five of these.
  EXPECT_NEAR(square, 1, 5 * std::sqrt(2.0 / repetitions));
}

TEST(LensTwin, LeavesTermsAtZeroThatThePhotographsDoNotTell) {
  Random random(13);
  CameraSpec straight = nominalCamera();
  straight.focal_px = 400;
  const CameraTwin twin = fitLens(nominalCamera(), posedViews(straight, 12, random), {0.25, 3});
  for (const TwinNumber& number : twin.numbers) {
    if (number.name[0] != 'k' && number.name[0] != 'p') continue;
    // One in twenty is taken for something by chance.
    if (!number.identified) {
      EXPECT_EQ(number.after, 0) << number.name;
    }
    EXPECT_LE(std::abs(number.after), 4 * number.deviation) << number.name;
  }
  EXPECT_FALSE(twin.numbers[5].identified);  // k3
  EXPECT_NEAR(twin.spec.focal_px, 400, 4 * twin.numbers[0].deviation);
}

TEST(LensTwin, RefusesWhatIsTooLittle) {
  Random random(14);
  const CameraSpec hidden = nominalCamera();
  std::vector<PointView> views = posedViews(hidden, 5, random);
  const auto said = [&](const std::vector<PointView>& given) {
    return refusal([&] { fitLens(nominalCamera(), given); });
  };
  EXPECT_THAT(said({views[0]}), ::testing::HasSubstr("at least 2"));
  views[1].pose.reset();
  EXPECT_THAT(said(views), ::testing::HasSubstr("poses of all, or of none"));
  for (PointView& view : views) view.pose.reset();
  EXPECT_THAT(said({views.begin(), views.begin() + 3}), ::testing::HasSubstr("at least 4"));
  views[2].seen_px[7][0] = 5000;
  EXPECT_THAT(said(views), ::testing::HasSubstr("view2: a point at 5000"));
}

TEST(LensTwin, FindsNoBoardWhereThereIsNone) {
  EXPECT_FALSE(boardView({64, 48, std::vector<std::uint8_t>(3 * 64 * 48, 128)}, twinBoard, "grey"));
}

// 13 photographs of a board of 9 × 6 inner corners, 640 × 480. left_intrinsics.yml beside them has what OpenCV's own
// calibration program found from all 13 with square pixels: focal length 535.92 px, centre (342.28, 235.57), average
// reprojection error of the fitted photographs 0.393 px.
TEST(LensTwin, PublicBoardPictures) {
  const std::string folder = "/usr/share/doc/opencv-doc/examples/data/";
  if (!std::filesystem::exists(folder + "left01.jpg")) GTEST_SKIP() << "needs Debian's package opencv-doc";
  const BoardPattern board{9, 6, 0.025};
  std::vector<PointView> views;
  for (const char* number : {"01", "02", "03", "04", "05", "06", "07", "08", "09", "11", "12", "13", "14"}) {
    const std::string name = std::string("left") + number + ".jpg";
    auto view = boardView(readPicture(folder + name), board, name);
    ASSERT_TRUE(view) << name;
    views.push_back(std::move(*view));
  }
  CameraSpec thought;
  thought.name = "thought";
  thought.width = 640;
  thought.height = 480;
  thought.focal_px = 500;
  thought.centreX_px = 319.5;
  thought.centreY_px = 239.5;
  const CameraTwin twin = fitLens(thought, views, {0.3, 1});
  for (const TwinNumber& n : twin.numbers)
    std::cout << n.name << " " << n.after << " ± " << n.deviation << (n.identified ? "\n" : " not told\n");
  std::cout << "held out " << twin.heldOutBefore << " px before, " << twin.heldOutAfter << " after; fitted "
            << twin.fittedAfter << "\n";
  EXPECT_LT(twin.heldOutAfter, 0.393);
  EXPECT_GT(twin.heldOutBefore, 2 * twin.heldOutAfter);
  const double published[] = {535.92, 342.28, 235.57};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(twin.numbers[i].after, published[i], 4 * twin.numbers[i].deviation);
}

}  // namespace
}  // namespace btr::test
