// The scenes that come with the program, as far as the robot's file and arithmetic can judge them.
#include <gtest/gtest.h>

#include <cmath>

#include "core/model/kinematics.h"
#include "core/model/load_model.h"
#include "core/spec/scene_spec.h"

namespace btr {
namespace {

using Eigen::Vector3d;

class ShippedScene : public testing::TestWithParam<const char*> {
 protected:
  ShippedScene()
      : scene_(loadScene(std::string(SOURCE_DIR "/resources/scenes/") + GetParam())),
        model_(loadModel(scene_.directory + "/" + scene_.robots.at(0).model)),
        positions_(model_.joints.size(), 0.0) {
    for (const auto& [joint, position] : scene_.robots[0].jointStart)
      positions_.at(static_cast<std::size_t>(model_.findJoint(joint))) = position;
    const auto& at = scene_.robots[0].position_m;
    const auto& q = scene_.robots[0].orientation_wxyz;
    start_ = Eigen::Translation3d(at[0], at[1], at[2]) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
  }
  SceneSpec scene_;
  RobotModel model_;
  std::vector<double> positions_;
  Eigen::Isometry3d start_;
};
INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScene,
                         testing::Values("kick.json", "walk.json", "walk-ers210.json", "walk-ers220.json"));

TEST_P(ShippedScene, TheDogStandsWithAllFourFeetOnTheFloor) {
  const auto poses = forwardKinematics(model_, start_, positions_);
  int feet = 0;
  for (std::size_t i = 0; i < model_.links.size(); ++i)
    for (const Shape& shape : model_.links[i].shapes)
      if (shape.collides && shape.kind == Shape::Kind::sphere &&
          model_.links[i].name.find("LOWER") != std::string::npos) {
        EXPECT_NEAR(0, (poses[i] * shape.pose).translation().z() - shape.size_m.x(), 5e-5) << model_.links[i].name;
        ++feet;
      }
  EXPECT_EQ(4, feet);
}

TEST_P(ShippedScene, EveryJointStartsWithinItsRange) {
  for (std::size_t i = 0; i < positions_.size(); ++i)
    if (model_.joints[i].type != Joint::Type::fixed) {
      EXPECT_GE(positions_[i], model_.joints[i].lower - 1e-6) << model_.joints[i].name;
      EXPECT_LE(positions_[i], model_.joints[i].upper + 1e-6) << model_.joints[i].name;
    }
}

TEST_P(ShippedScene, TheBallLiesOnTheFloorAheadOfTheNose) {
  for (const BallSpec& ball : scene_.balls) {
    EXPECT_DOUBLE_EQ(ball.radius_m, ball.position_m[2]);
    const auto poses = forwardKinematics(model_, start_, positions_);
    const Vector3d neck = poses.at(static_cast<std::size_t>(model_.findLink("NECK"))).translation();
    const double distance = std::hypot(ball.position_m[0] - neck.x(), ball.position_m[1] - neck.y());
    EXPECT_GT(distance, 0.14);
    EXPECT_LT(distance, 0.18);
  }
  EXPECT_EQ(std::string(GetParam()) == "kick.json" ? 1u : 0u, scene_.balls.size());
}

}  // namespace
}  // namespace btr
