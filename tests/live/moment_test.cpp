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

Game gameOf(const SceneSpec& scene) {
  Game game;
  game.scene = sceneFromJson(toJsonText(scene), "moment.json", scene.directory);  // as a file
  return game;
}

/// Of all its links.
Eigen::Vector3d middleOf(const Session& session, std::size_t robot) {
  const RobotModel& model = session.scene().robots[robot].model;
  const auto poses = session.world().linkPoses(robot);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    mass += model.links[i].inertial.mass_kg;
    moment += model.links[i].inertial.mass_kg * (poses[i] * model.links[i].inertial.centreOfMass_m);
  }
  return moment / mass;
}

// Up into the air and turning, its legs trotting on: the middle of its mass flies along the parabola before the moment
// and after it, in the session and in a world of the moment's scene.
TEST(Moment, AThrownRobotFliesOnAlongItsParabola) {
  auto session = std::make_optional<Session>(dogs(), host());
  run(*session, 20);
  session->apply(PlaceAct{"red1", {-0.5, 0, 2}, {1, 0, 0, 0}, {}, {}});
  session->apply(ThrowAct{"red1", {0.4, -0.3, 2.5}, {0.5, 1, -2}});
  const double period = session->scene().controlPeriod_s;
  const Eigen::Vector3d gravity = session->scene().gravity_m_s2;
  const Eigen::Vector3d start = middleOf(*session, 0);
  run(*session, 25);
  const double t = 25 * period;
  const Eigen::Vector3d middle = middleOf(*session, 0);
  const Eigen::Vector3d velocity = (middle - start) / t + gravity * t / 2;  // now
  const SceneSpec scene = momentOf(*session);
  EXPECT_TRUE(scene.robots[0].moves());
  EXPECT_GT(scene.robots[0].jointRate.size(), 8u);  // it trots
  session.reset();                                  // a process has one world

  Session again(gameOf(scene), host());
  EXPECT_LT((middleOf(again, 0) - middle).norm(), 1e-4);
  for (int i = 1; i <= 50; ++i) {
    again.step();
    const double later = i * period;
    const Eigen::Vector3d flies = middle + velocity * later + gravity * later * later / 2;
    ASSERT_LT((middleOf(again, 0) - flies).norm(), 2e-3) << later << " s";
  }
}

TEST(Moment, KeepsHowFastEverythingIs) {
  auto session = std::make_optional<Session>(dogs(), host());
  run(*session, 90);
  const RobotReadings was = session->world().robot(0);
  ASSERT_GT(was.baseVelocity_m_s.norm(), 0.02);  // it walks
  const SceneSpec scene = momentOf(*session);
  session.reset();
  const Session again(gameOf(scene), host());
  const RobotReadings is = again.world().robot(0);
  EXPECT_LT((was.baseVelocity_m_s - is.baseVelocity_m_s).norm(), 1e-9);
  EXPECT_LT((was.baseSpin_rad_s - is.baseSpin_rad_s).norm(), 1e-9);
  for (std::size_t j = 0; j < was.rate.size(); ++j) EXPECT_NEAR(was.rate[j], is.rate[j], 1e-9) << j;
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
