// A moment of a session as a scene of its own.
#include "core/live/moment.h"

#include <gtest/gtest.h>

#include <optional>

#include "tests/live/game_files.h"

namespace btr::test {
namespace {

/// Where everything is.
struct Standing {
  std::vector<std::vector<Eigen::Isometry3d>> links;
  BallState ball;
  ObstacleState crate;

  explicit Standing(const Session& session) : ball(session.world().ball(0)), crate(session.world().obstacle(0)) {
    for (std::size_t i = 0; i < session.game().scene.robots.size(); ++i) links.push_back(session.world().linkPoses(i));
  }
};

TEST(Moment, AWorldOfItsSceneStandsAsTheSessionDid) {
  auto session = std::make_optional<Session>(dogs(), host());
  run(*session, 40);
  session->apply(actFromJson(R"({"act": "throw", "object": "ball", "velocity_m_s": [0.5, -1, 1.2]})", "act"));
  session->apply(actFromJson(R"({"act": "throw", "object": "crate", "velocity_m_s": [0.2, 0, 1]})", "act"));
  run(*session, 20);
  const SceneSpec scene = momentOf(*session);
  EXPECT_EQ(scene, sceneFromJson(toJsonText(scene), "moment.json", scene.directory));  // as a file
  const Standing was(*session);
  session.reset();  // a process has one world

  Game again;
  again.scene = scene;
  for (const RobotSpec& robot : scene.robots) again.robots[robot.name].posture = false;
  const Standing is(Session(again, host()));
  ASSERT_EQ(was.links.size(), is.links.size());
  for (std::size_t i = 0; i < was.links.size(); ++i) {
    ASSERT_EQ(was.links[i].size(), is.links[i].size());
    for (std::size_t link = 0; link < was.links[i].size(); ++link) {
      // The solver's joints give a little; the angles do not tell by how much.
      const Eigen::Isometry3d &a = was.links[i][link], &b = is.links[i][link];
      EXPECT_LT((a.translation() - b.translation()).norm(), link == 0 ? 1e-12 : 1e-4);
      EXPECT_LT(Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle(), link == 0 ? 1e-7 : 1e-3);
    }
  }
  EXPECT_TRUE(was.ball.position_m.isApprox(is.ball.position_m, 1e-12));
  EXPECT_TRUE(was.ball.velocity_m_s.isApprox(is.ball.velocity_m_s, 1e-12));
  EXPECT_TRUE(was.crate.pose.isApprox(is.crate.pose, 1e-9));
  EXPECT_TRUE(was.crate.velocity_m_s.isApprox(is.crate.velocity_m_s, 1e-12));
}

TEST(Moment, WhatCameIsThereAndWhatWentIsNot) {
  Session session(dogs(), host());
  session.apply(actFromJson(R"({"act": "remove", "object": "blue1"})", "act"));
  session.apply(actFromJson(R"({"act": "add", "ball": {"name": "second", "position_m": [1, 1, 0.2]}})", "act"));
  run(session, 3);
  const SceneSpec scene = momentOf(session);
  ASSERT_EQ(1u, scene.robots.size());
  ASSERT_EQ(2u, scene.balls.size());
  EXPECT_EQ("second", scene.balls[1].name);
  EXPECT_LT(scene.balls[1].position_m[2], 0.2);  // it falls
  EXPECT_LT(scene.balls[1].velocity_m_s[2], 0);
}

}  // namespace
}  // namespace btr::test
