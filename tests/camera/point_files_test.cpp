// Points and poses from files.
#include "core/camera/point_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "core/spec/json_reader.h"
#include "tests/camera/board_pictures.h"
#include "tests/refusal.h"
#include "tests/temporary_folder.h"

namespace btr::test {
namespace {

using ::testing::HasSubstr;

class PointFiles : public ::testing::Test {
 protected:
  const std::string& with(const std::string& text) {
    writeFile(path_, text);
    return path_;
  }
  const TemporaryFolder temporary_;
  const std::string path_ = temporary_.file("points.csv");
};

TEST_F(PointFiles, PointsBelongToTheirViews) {
  const auto views = readPoints(with("u_px,v_px,view,x_m,y_m,z_m\n10,20,b,1,2,3\n11,21,a,4,5,6\n12,22,b,7,8,9\n"));
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0].name, "b");
  EXPECT_EQ(views[0].points_m[1], (std::array<double, 3>{7, 8, 9}));
  EXPECT_EQ(views[0].seen_px[1], (std::array<double, 2>{12, 22}));
  EXPECT_EQ(views[1].points_m.size(), 1u);
}

// A camera at (1, 2, 3) that looks along the world's y: its left is −x, its up is z. A point 5 m ahead, 0.5 m to the
// right (x) and 0.25 m up is at (0.5, −0.25, 5) of the picture.
TEST_F(PointFiles, PosesTurnTheOpticalFrameIntoThePictures) {
  const double h = std::sqrt(0.5);
  const auto poses = readPoses(with("view,x_m,y_m,z_m,qw,qx,qy,qz\na,1,2,3," + toText(h) + ",0,0," + toText(h) + "\n"));
  const ViewPose& pose = poses.at("a");
  const Eigen::Vector3d axis(pose.rotation_rad[0], pose.rotation_rad[1], pose.rotation_rad[2]);
  const Eigen::Vector3d seen = Eigen::AngleAxisd(axis.norm(), axis.normalized()) * Eigen::Vector3d(1.5, 7, 3.25) +
                               Eigen::Vector3d(pose.translation_m[0], pose.translation_m[1], pose.translation_m[2]);
  EXPECT_NEAR(seen.x(), 0.5, 1e-12);
  EXPECT_NEAR(seen.y(), -0.25, 1e-12);
  EXPECT_NEAR(seen.z(), 5, 1e-12);
}

TEST_F(PointFiles, AWrongFileIsRefusedWithItsLine) {
  EXPECT_THAT(refusal([&] { readPoints(with("view,x_m,y_m,z_m,u_px\n")); }), HasSubstr("has no column v_px"));
  EXPECT_THAT(refusal([&] { readPoints(with("view,x_m,y_m,z_m,u_px,v_px\na,1,2,3,4,five\n")); }),
              HasSubstr("line 2, column 6: \"five\" is not allowed; a number"));
  EXPECT_THAT(refusal([&] { readPoses(with("view,x_m,y_m,z_m,qw,qx,qy,qz\na,1,2,3,1,1,0,0\n")); }),
              HasSubstr("a unit quaternion"));
  EXPECT_THAT(refusal([&] { readPoses(with("view,x_m,y_m,z_m,qw,qx,qy,qz\na,1,2,3,1,0,0,0\na,1,2,3,1,0,0,0\n")); }),
              HasSubstr("each view once"));
}

TEST_F(PointFiles, TheCornersOfABoardAreOrderedByItsPose) {
  Random random(3);
  const CameraSpec camera = plainCamera(416, 320);
  const BoardPattern board{9, 6, 0.03};
  const Eigen::Isometry3d place = randomPlace(random, camera, board, 5);
  PointView view;
  for (int j = 0; j < board.rows; ++j)
    for (int i = 0; i < board.columns; ++i) view.points_m.push_back({i * board.square_m, j * board.square_m, 0});
  view.seen_px = trueCorners(camera, board, place);
  const auto right = view.seen_px;
  EXPECT_EQ(withPose(view, poseOf(place), camera, true).seen_px, right);
  std::reverse(view.seen_px.begin(), view.seen_px.end());
  EXPECT_EQ(withPose(view, poseOf(place), camera, true).seen_px, right);
  EXPECT_NE(withPose(view, poseOf(place), camera, false).seen_px, right);
}

}  // namespace
}  // namespace btr::test
