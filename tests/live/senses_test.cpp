// What robots sense, against what mechanics and geometry say.
#include "core/sim/senses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/sim/contact/ray.h"
#include "tests/live/game_files.h"
#include "tests/refusal.h"

namespace btr::test {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double gravity = 9.81;

double valueOf(const Session& session, const std::string& channel) {
  const std::vector<std::string> names = session.channels();
  const auto found = std::ranges::find(names, channel);
  if (found == names.end()) throw std::logic_error(channel + " is no channel");
  std::vector<double> row;
  session.sample(row);
  return row.at(static_cast<std::size_t>(found - names.begin()));
}

Vector3d accelerationOf(const Session& session, const std::string& robot) {
  const std::string at = robot + ".accelerometer.";
  return {valueOf(session, at + "x_m_s2"), valueOf(session, at + "y_m_s2"), valueOf(session, at + "z_m_s2")};
}

/// A cube of 0.37 kg and 10 cm with an exact accelerometer.
Game cubeGame(double height_m, bool floor) {
  Game game = loadGame(SOURCE_DIR "/resources/robots/contactnets_cube.urdf");
  game.scene.robots.front().position_m = {0, 0, height_m};
  if (!floor) game.scene.floor.reset();
  game.robots["robot"].senses = {{"accelerometer", {{"noise_m_s2", 0}, {"delay_s", 0}}}};
  return game;
}

SenseSpec exactly(const std::string& sense) {
  SenseSpec spec{sense, {{"delay_s", 0}, {"period_s", 0}}};
  for (const char* noise : {"noise_m", "noise_m_s2", "noise_rad"})
    if (find(senseParameters(sense), noise)) spec.parameters[noise] = 0;
  return spec;
}

TEST(Accelerometer, AtRestFeelsTheFloorPushItUp) {
  Session session(cubeGame(0.0524, true), host());
  run(session, 250);
  EXPECT_LT((accelerationOf(session, "robot") - Vector3d(0, 0, gravity)).norm(), 0.01);
}

TEST(Accelerometer, InFreeFallFeelsNothing) {
  Session session(cubeGame(5, false), host());
  run(session, 50);
  EXPECT_LT(accelerationOf(session, "robot").norm(), 1e-9);
}

TEST(Accelerometer, FeelsAPullAsForceByMass) {
  Session session(cubeGame(5, false), host());
  const RobotModel& model = session.scene().robots[0].model;
  const double mass = model.links[0].inertial.mass_kg;
  const Vector3d centre = model.links[0].inertial.centreOfMass_m;
  // So far away that the hand pulls with all it has.
  session.apply(PullAct{"robot", "", {centre.x(), centre.y(), centre.z()}, {90, 0, 5}, 1000, 1.5});
  run(session, 20);
  const Vector3d force = session.handForce_n("robot");
  EXPECT_NEAR(force.norm(), 1.5, 1e-9);
  EXPECT_NEAR(accelerationOf(session, "robot").norm(), 1.5 / mass, 0.01 * 1.5 / mass);
  EXPECT_NEAR(accelerationOf(session, "robot").x(), 1.5 / mass, 0.01 * 1.5 / mass);
}

TEST(Accelerometer, SaturatesAtItsLimit) {
  Game game = cubeGame(5, false);
  game.robots["robot"].senses[0].parameters["limit_m_s2"] = 3;
  Session session(game, host());
  session.apply(PullAct{"robot", "", {0, 0, 0}, {90, 0, 5}, 1000, 10});
  run(session, 5);
  EXPECT_EQ(accelerationOf(session, "robot").x(), 3);
}

TEST(Senses, NoiseHasItsDeviationAndTheGamesSeed) {
  Game game = cubeGame(5, false);
  game.robots["robot"].senses[0].parameters["noise_m_s2"] = 0.2;
  std::vector<double> values;
  const auto noiseOf = [&](std::uint64_t seed) {
    game.seed = seed;
    Session session(game, host());
    std::vector<double> all;
    for (int i = 0; i < 120; ++i) {
      session.step();
      const Vector3d a = accelerationOf(session, "robot");
      all.insert(all.end(), {a.x(), a.y(), a.z()});
    }
    return all;
  };
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    for (const double each : noiseOf(seed)) values.push_back(each);
  double sum = 0, squares = 0;
  for (const double each : values) {
    sum += each;
    squares += each * each;
  }
  const auto n = static_cast<double>(values.size());
  // Four standard errors of mean and deviation.
  EXPECT_NEAR(sum / n, 0, 4 * 0.2 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.2, 4 * 0.2 / std::sqrt(2 * n));
  EXPECT_EQ(noiseOf(7), noiseOf(7));
  EXPECT_NE(noiseOf(7), noiseOf(8));
}

TEST(Senses, AreSampledAtTheirRateHeldAndLate) {
  const auto seen = [](double period_s, double delay_s) {
    Game game = cubeGame(50, false);
    game.robots["robot"].senses = {
        {"accelerometer", {{"noise_m_s2", 1}, {"period_s", period_s}, {"delay_s", delay_s}}}};
    Session session(game, host());
    std::vector<double> values;
    for (int i = 0; i <= 60; ++i) {
      if (i > 0) session.step();
      values.push_back(accelerationOf(session, "robot").y());
    }
    return values;
  };
  const std::vector<double> every = seen(0.008, 0), fifth = seen(0.04, 0), late = seen(0.04, 0.016);
  for (std::size_t i = 1; i < every.size(); ++i) {
    EXPECT_NE(every[i], every[i - 1]);
    EXPECT_EQ(fifth[i] != fifth[i - 1], i % 5 == 0) << i;  // 0.04 s are five control periods
    if (i >= 2) {
      EXPECT_EQ(late[i], fifth[i - 2]) << i;
    }
  }
  // 50 ms are no whole number of periods: 8 samples in 400 ms all the same.
  const std::vector<double> odd = seen(0.05, 0);
  int changes = 0;
  for (std::size_t i = 1; i <= 50; ++i) changes += odd[i] != odd[i - 1];
  EXPECT_EQ(changes, 8);
}

/// A dog that stands at the origin with its senses exact, and nothing else.
Game sensingDog() {
  Game game = dogs();
  game.scene.robots.pop_back();
  game.robots.erase("blue1");
  game.robots["red1"].controller.reset();
  game.scene.robots[0].position_m = {0, 0, 0};
  game.scene.balls.clear();
  game.scene.obstacles.clear();
  for (const char* sense : {"infrared_near", "infrared_far", "infrared_chest", "paws", "touch", "joints"})
    game.robots["red1"].senses.push_back(exactly(sense));
  return game;
}

/// Where a distance sensor of the ERS-7 is and looks.
std::pair<Vector3d, Vector3d> eyeOf(const Session& session, bool chest) {
  const RobotModel& model = session.scene().robots[0].model;
  const auto poses = session.world().linkPoses(0);
  if (chest)
    return {poses[0] * Vector3d(0.104, 0, -0.003),
            poses[0].linear() * Vector3d(std::cos(M_PI / 6), 0, -std::sin(M_PI / 6))};
  const Eigen::Isometry3d head = poses[static_cast<std::size_t>(model.findLink("HEAD"))];
  return {head * Vector3d(0.08106, 0, -0.0146), head.linear() * Vector3d::UnitX()};
}

TEST(Infrared, SeesTheFloorWhereGeometrySaysAndElseAsFarAsItCan) {
  Session session(sensingDog(), host());
  const auto [eye, look] = eyeOf(session, true);
  EXPECT_NEAR(valueOf(session, "red1.infrared.chest_m"), eye.z() / -look.z(), 1e-9);
  EXPECT_EQ(valueOf(session, "red1.infrared.near_m"), 0.5);
  EXPECT_EQ(valueOf(session, "red1.infrared.far_m"), 1.5);
}

TEST(Infrared, SeesABoxABallAndADog) {
  Game game = sensingDog();
  Vector3d eye, look;
  {
    Session session(game, host());
    std::tie(eye, look) = eyeOf(session, false);
  }
  ASSERT_NEAR(look.y(), 0, 1e-6);
  ObstacleSpec wall;
  wall.name = "wall";
  wall.size_m = {0.1, 1, 1};
  wall.position_m = {eye.x() + 0.35, 0, 0.5};
  game.scene.obstacles = {wall};
  {
    Session session(game, host());
    const double distance = 0.30 / look.x();  // its face is 5 cm before its middle
    EXPECT_NEAR(valueOf(session, "red1.infrared.near_m"), distance, 1e-6);
    EXPECT_NEAR(valueOf(session, "red1.infrared.far_m"), distance, 1e-6);
  }
  // Nearer than it can tell.
  game.scene.obstacles[0].position_m[0] = eye.x() + 0.05 + 0.03;
  {
    Session session(game, host());
    EXPECT_EQ(valueOf(session, "red1.infrared.near_m"), 0.05);
    EXPECT_EQ(valueOf(session, "red1.infrared.far_m"), 0.2);
  }
  game.scene.obstacles.clear();
  BallSpec ball;
  ball.name = "ball";
  ball.radius_m = 0.0425;
  const Vector3d at = eye + 0.4 * look;
  ball.position_m = {at.x(), at.y(), at.z()};
  game.scene.balls = {ball};
  {
    Session session(game, host());
    EXPECT_NEAR(valueOf(session, "red1.infrared.near_m"), 0.4 - 0.0425, 1e-6);
  }
  game.scene.balls.clear();
  RobotSpec other = game.scene.robots[0];
  other.name = "blue1";
  other.position_m = {eye.x() + 0.75, 0, 0};
  game.scene.robots.push_back(other);
  Session session(game, host());
  EXPECT_EQ(valueOf(session, "red1.infrared.near_m"), 0.5);
  EXPECT_GT(valueOf(session, "red1.infrared.far_m"), 0.5);
  EXPECT_LT(valueOf(session, "red1.infrared.far_m"), 0.75);
}

TEST(Rays, MeetSolidsWhereGeometrySays) {
  const auto distance = [](Shape::Kind kind, Vector3d size, Vector3d origin, Vector3d direction) {
    Shape shape;
    shape.kind = kind;
    shape.size_m = size;
    Collider collider = makeCollider(shape, Eigen::Isometry3d::Identity(), 0);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << 1, 2, 3;
    pose.rotate(Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()));
    const auto hit = rayDistance(collider, pose, pose * origin, pose.linear() * direction);
    return hit ? *hit : -1;
  };
  using Kind = Shape::Kind;
  EXPECT_NEAR(distance(Kind::box, {0.2, 0.4, 0.6}, {1, 0.1, 0.1}, {-1, 0, 0}), 0.9, 1e-12);
  EXPECT_EQ(distance(Kind::box, {0.2, 0.4, 0.6}, {1, 0.21, 0.1}, {-1, 0, 0}), -1);
  EXPECT_EQ(distance(Kind::box, {0.2, 0.4, 0.6}, {1, 0, 0}, {1, 0, 0}), -1);  // behind
  EXPECT_EQ(distance(Kind::box, {0.2, 0.4, 0.6}, {0.05, 0, 0}, {1, 0, 0}), 0);
  EXPECT_NEAR(distance(Kind::sphere, {0.5, 0, 0}, {2, 0.3, 0}, {-1, 0, 0}), 1.6, 1e-12);  // 3-4-5
  EXPECT_NEAR(distance(Kind::cylinder, {0.5, 1, 0}, {2, 0.2, 0.3}, {-1, 0, 0}), 1.6, 1e-12);
  EXPECT_NEAR(distance(Kind::cylinder, {0.5, 1, 0}, {0.1, 3, 0}, {0, -1, 0}), 2.5, 1e-12);
  EXPECT_NEAR(distance(Kind::capsule, {0.5, 1, 0}, {0.3, 3, 0}, {0, -1, 0}), 3 - 0.5 - 0.4, 1e-12);
  EXPECT_EQ(distance(Kind::capsule, {0.5, 1, 0}, {0.6, 3, 0}, {0, -1, 0}), -1);
}

TEST(Paws, SayWhatTheyStandOn) {
  Session session(sensingDog(), host());
  run(session, 100);
  for (const char* paw : {"lf", "rf", "lr", "rr"})
    EXPECT_EQ(valueOf(session, std::string("red1.paw.") + paw), 1) << paw;
  session.apply(PlaceAct{"red1", {0, 0, 1}});
  run(session, 3);
  for (const char* paw : {"lf", "rf", "lr", "rr"})
    EXPECT_EQ(valueOf(session, std::string("red1.paw.") + paw), 0) << paw;
}

TEST(TouchSense, IsWhereAHandHolds) {
  Session session(sensingDog(), host());
  const auto touched = [&](const std::string& link, double z) {
    session.apply(PullAct{"red1", link, {0, 0, z}, {0, 0, 0.3}, 10, 1});
    session.step();
    return std::array{valueOf(session, "red1.touch.head"), valueOf(session, "red1.touch.chin"),
                      valueOf(session, "red1.touch.back")};
  };
  using testing::ElementsAre;
  EXPECT_THAT(touched("HEAD", 0.03), ElementsAre(1, 0, 0));
  EXPECT_THAT(touched("HEAD", -0.03), ElementsAre(0, 1, 0));
  EXPECT_THAT(touched("MOUTH_JAW", 0), ElementsAre(0, 1, 0));
  EXPECT_THAT(touched("", 0.05), ElementsAre(0, 0, 1));
  EXPECT_THAT(touched("LF_LOWER", 0), ElementsAre(0, 0, 0));
}

TEST(JointSense, ReadsInSteps) {
  Game game = sensingDog();
  game.robots["red1"].senses.back().parameters["resolution_rad"] = 0.1;
  Session session(game, host());
  run(session, 10);
  const double read = valueOf(session, "red1.LF_J3.sensed_rad"), is = valueOf(session, "red1.LF_J3.position_rad");
  EXPECT_NEAR(read / 0.1, std::round(read / 0.1), 1e-9);
  EXPECT_LE(std::abs(read - is), 0.05 + 1e-12);
}

TEST(Senses, GoOnInASavedGameWithTheSameBits) {
  Game game = sensingDog();
  game.robots["red1"].senses = sensesOfModel("ers7", "senses");
  std::string saved;
  std::vector<double> onwards, again;
  {
    Session session(game, host());
    run(session, 33);
    saved = toJsonText(session.save());
    for (int i = 0; i < 50; ++i) {
      session.step();
      session.sample(onwards);
    }
  }
  Session session(gameFromJson(saved, "saved.json", "."), host());
  for (int i = 0; i < 50; ++i) {
    session.step();
    session.sample(again);
  }
  EXPECT_EQ(onwards, again);
}

TEST(Senses, StandAfterTheWorldsOwnColumns) {
  Game game = dogs();
  std::vector<std::string> plain;
  std::string sha;
  {
    Session session(game, host());
    plain = session.channels();
    EXPECT_EQ(plain, session.world().channels());
  }
  game.robots["blue1"].senses = sensesOfModel("ers7", "senses");
  Session session(game, host());
  std::vector<std::string> channels = session.channels();
  ASSERT_GT(channels.size(), plain.size());
  EXPECT_EQ(channels[plain.size()], "blue1.accelerometer.x_m_s2");
  channels.resize(plain.size());
  EXPECT_EQ(channels, plain);
}

TEST(Senses, ThatARobotCannotHaveAreRefused) {
  Game game = cubeGame(1, false);
  game.robots["robot"].senses = {{"paws"}};
  EXPECT_THAT(refusal([&] { Session(game, host()); }), HasSubstr("LF_J3"));
  game.robots["robot"].senses = {{"smell"}};
  EXPECT_THAT(refusal([&] { Session(game, host()); }), HasSubstr("accelerometer"));
  game.robots["robot"].senses = {{"accelerometer"}, {"accelerometer"}};
  EXPECT_THAT(refusal([&] { Session(game, host()); }), HasSubstr("twice"));
  std::string text = dogsText();
  text.replace(text.find("\"team\": \"red\""), 13, "\"senses\": \"cat\"");
  EXPECT_THAT(refusal([&] { gameFromJson(text, "game.json", "."); }), HasSubstr("ers210"));
}

}  // namespace
}  // namespace btr::test
