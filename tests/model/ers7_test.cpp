// The ERS-7's file against the dimensions of the robot's drawing (millimetres there, metres here).
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "core/model/kinematics.h"
#include "core/model/load_model.h"

namespace btr {
namespace {

using Eigen::Vector3d;
constexpr double tenth_mm = 1e-4;
constexpr double degree = 3.14159265358979323846 / 180;

const RobotModel& ers7() {
  static const RobotModel model = loadModel(SOURCE_DIR "/resources/robots/ers7.wrl");
  return model;
}

/// Link poses in the body's frame when these joints stand at these degrees and the others at 0.
std::map<std::string, Eigen::Isometry3d> posesAt(const std::map<std::string, double>& degrees) {
  std::vector<double> positions(ers7().joints.size(), 0.0);
  for (const auto& [joint, value] : degrees)
    positions.at(static_cast<std::size_t>(ers7().findJoint(joint))) = value * degree;
  const auto poses = forwardKinematics(ers7(), Eigen::Isometry3d::Identity(), positions);
  std::map<std::string, Eigen::Isometry3d> result;
  for (std::size_t i = 0; i < poses.size(); ++i) result[ers7().links[i].name] = poses[i];
  return result;
}

Vector3d origin(const std::string& link, const std::map<std::string, double>& degrees = {}) {
  return posesAt(degrees).at(link).translation();
}

/// The foot ball of a leg: the only sphere that collides on its lower part.
const Shape& footBall(const std::string& leg) {
  const Link& lower = ers7().links.at(static_cast<std::size_t>(ers7().findLink(leg + "_LOWER")));
  for (const Shape& shape : lower.shapes)
    if (shape.collides && shape.kind == Shape::Kind::sphere) return shape;
  throw std::runtime_error("no foot ball");
}

/// The lowest point of the foot ball in the body's frame.
Vector3d contact(const std::string& leg, const std::map<std::string, double>& degrees) {
  const Shape& ball = footBall(leg);
  return posesAt(degrees).at(leg + "_LOWER") * ball.pose.translation() - Vector3d(0, 0, ball.size_m.x());
}

const std::map<std::string, double> standing{{"LF_J3", 30}, {"LR_J3", 30}, {"RF_J3", 30}, {"RR_J3", 30}};

void expectNear(const Vector3d& expected, const Vector3d& actual, double tolerance = tenth_mm) {
  EXPECT_LT((expected - actual).norm(), tolerance)
      << "expected " << expected.transpose() << ", is " << actual.transpose();
}

TEST(Ers7, HasTheLinksAndJointsOfTheRobot) {
  EXPECT_EQ("ERS-7", ers7().name);
  EXPECT_TRUE(ers7().freeBase);
  EXPECT_EQ("BODY", ers7().links.front().name);
  for (const char* name : {"LF_J1", "LF_J2", "LF_J3", "LR_J1", "LR_J2", "LR_J3", "RF_J1", "RF_J2", "RF_J3", "RR_J1",
                           "RR_J2", "RR_J3", "NECK_TILT", "HEAD_PAN", "HEAD_TILT", "MOUTH", "TAIL_TILT", "TAIL_PAN"})
    EXPECT_GE(ers7().findJoint(name), 0) << name;
  EXPECT_EQ(Joint::Type::fixed, ers7().joints.at(static_cast<std::size_t>(ers7().findJoint("L_EAR_BASE"))).type);
  EXPECT_TRUE(ers7().warnings.empty());
}

TEST(Ers7, HipAxesStandWhereTheDrawingHasThem) {
  expectNear({0.065, 0.0625, 0}, origin("LF_ROTOR"));
  expectNear({-0.065, 0.0625, 0}, origin("LR_ROTOR"));
  expectNear({0.065, -0.0625, 0}, origin("RF_ROTOR"));
  expectNear({-0.065, -0.0625, 0}, origin("RR_ROTOR"));
}

TEST(Ers7, KneesAreNineMillimetresAheadAndBehindAnd69Point5Below) {
  expectNear({0.009, 0.0047, -0.0695}, origin("LF_LOWER") - origin("LF_UPPER"));
  expectNear({-0.009, 0.0047, -0.0695}, origin("LR_LOWER") - origin("LR_UPPER"));
  expectNear({0.009, -0.0047, -0.0695}, origin("RF_LOWER") - origin("RF_UPPER"));
  expectNear({-0.009, -0.0047, -0.0695}, origin("RR_LOWER") - origin("RR_UPPER"));
}

TEST(Ers7, StandsAtTheDrawnHipHeights) {
  EXPECT_NEAR(-0.1410, contact("LF", standing).z(), tenth_mm);
  EXPECT_NEAR(-0.1410, contact("RF", standing).z(), tenth_mm);
  EXPECT_NEAR(-0.1460, contact("LR", standing).z(), tenth_mm);
  EXPECT_NEAR(-0.1460, contact("RR", standing).z(), tenth_mm);
}

TEST(Ers7, FeetTouchTheFloorWhereTheDrawingHasThem) {
  // 28.3 and 21.3 mm from the knee, 37.3 and 30.3 mm from the hip; the feet of a pair are 134.4 mm apart.
  EXPECT_NEAR(0.065 + 0.0373, contact("LF", standing).x(), tenth_mm);
  EXPECT_NEAR(-0.065 - 0.0303, contact("LR", standing).x(), tenth_mm);
  EXPECT_NEAR(0.1344, contact("LF", standing).y() - contact("RF", standing).y(), tenth_mm);
  EXPECT_NEAR(0.1344, contact("LR", standing).y() - contact("RR", standing).y(), tenth_mm);
  const Vector3d knee = origin("LF_LOWER", standing);
  expectNear({0.0283, 0, -0.0715}, contact("LF", standing) - knee);
  expectNear({-0.0213, 0, -0.0765}, contact("RR", standing) - origin("RR_LOWER", standing));
}

TEST(Ers7, FootBallLiesWhereAnIndependentModelHasItsCentre) {
  // The published Denavit-Hartenberg tables: 65.434 mm at -4.409 degrees in front, 67.647 mm at -11.537 degrees behind.
  const Vector3d front = footBall("LF").pose.translation(), rear = footBall("LR").pose.translation();
  EXPECT_NEAR(0.065434, front.norm(), 2e-4);
  EXPECT_NEAR(4.409, std::atan2(-front.x(), -front.z()) / degree, 0.15);
  EXPECT_NEAR(0.067647, rear.norm(), 2e-4);
  EXPECT_NEAR(11.537, std::atan2(rear.x(), -rear.z()) / degree, 0.15);
  EXPECT_NEAR(0.0124, footBall("LF").size_m.x(), 1e-9);
}

TEST(Ers7, PositiveLegAnglesSwingAwayFromTheMiddleOutwardAndFold) {
  for (const std::string leg : {"LF", "RF", "LR", "RR"}) {
    const double away = leg[1] == 'F' ? 1 : -1, out = leg[0] == 'L' ? 1 : -1;
    const Vector3d rest = contact(leg, {});
    EXPECT_GT(away * (contact(leg, {{leg + "_J1", 20}}) - rest).x(), 0.03) << leg;
    EXPECT_GT(out * (contact(leg, {{leg + "_J2", 20}}) - rest).y(), 0.03) << leg;
    EXPECT_GT(away * (contact(leg, {{leg + "_J3", 20}}) - rest).x(), 0.02) << leg;
  }
}

TEST(Ers7, LeftAndRightAreMirrorImages) {
  const std::map<std::string, double> left{{"LF_J1", 25},  {"LF_J2", 40}, {"LF_J3", 60},
                                           {"LR_J1", -35}, {"LR_J2", 15}, {"LR_J3", 90}};
  std::map<std::string, double> right;
  for (const auto& [joint, value] : left) right["R" + joint.substr(1)] = value;
  for (const std::string pair : {"F", "R"}) {
    Vector3d mirrored = contact("R" + pair, right);
    mirrored.y() = -mirrored.y();
    expectNear(contact("L" + pair, left), mirrored, 1e-9);
  }
}

TEST(Ers7, NeckHeadAndCameraStandWhereTheDrawingHasThem) {
  expectNear({0.0675, 0, 0.0195}, origin("NECK"));
  EXPECT_NEAR(0.080, (origin("HEAD") - origin("NECK")).norm(), tenth_mm);
  expectNear(origin("HEAD"), origin("HEAD_BASE"));
  expectNear({0.040, 0, -0.0175}, origin("MOUTH_JAW") - origin("HEAD"));
  expectNear({-0.102, 0, 0.033}, origin("TAIL_BASE"));

  ASSERT_EQ(2u, ers7().sensors.size());
  const Sensor& camera = ers7().sensors[1];
  EXPECT_EQ(Sensor::Kind::vision, camera.kind);
  EXPECT_EQ(ers7().findLink("HEAD"), camera.link);
  expectNear({0.08106, 0, -0.0146}, camera.pose.translation());
  // Looks forward, upright, 208 x 160 pixels with 56.9 x 45.2 degrees.
  expectNear({1, 0, 0}, camera.pose.linear() * Vector3d(0, 0, -1), 1e-5);
  expectNear({0, 0, 1}, camera.pose.linear() * Vector3d(0, 1, 0), 1e-5);
  EXPECT_EQ(208, camera.width);
  EXPECT_EQ(160, camera.height);
  EXPECT_NEAR(45.2 * degree, camera.fieldOfView_rad, 1e-4);
}

TEST(Ers7, NegativeNeckTiltLowersTheHeadAndPositiveHeadTiltRaisesTheNose) {
  EXPECT_NEAR(0.0195, origin("HEAD", {{"NECK_TILT", -90}}).z(), tenth_mm);
  EXPECT_NEAR(0.0675 + 0.080, origin("HEAD", {{"NECK_TILT", -90}}).x(), tenth_mm);
  EXPECT_GT(origin("MOUTH_JAW", {{"HEAD_TILT", 30}}).z(), origin("MOUTH_JAW").z() + 0.015);
  EXPECT_GT(origin("MOUTH_JAW", {{"HEAD_PAN", 30}}).y(), 0.015);
}

TEST(Ers7, JointRangesAreThoseOfTheSoftware) {
  const std::map<std::string, std::pair<double, double>> ranges{
      {"LF_J1", {-115, 130}},  {"RF_J1", {-115, 130}},  {"LR_J1", {-130, 115}},   {"RR_J1", {-130, 115}},
      {"LF_J2", {-10, 88}},    {"RR_J2", {-10, 88}},    {"LR_J3", {-25, 122}},    {"RF_J3", {-25, 122}},
      {"NECK_TILT", {-75, 0}}, {"HEAD_PAN", {-88, 88}}, {"HEAD_TILT", {-15, 45}}, {"MOUTH", {-55, -3}},
      {"TAIL_TILT", {5, 60}},  {"TAIL_PAN", {-45, 45}}};
  for (const auto& [name, range] : ranges) {
    const Joint& joint = ers7().joints.at(static_cast<std::size_t>(ers7().findJoint(name)));
    EXPECT_NEAR(range.first * degree, joint.lower, 1e-5) << name;
    EXPECT_NEAR(range.second * degree, joint.upper, 1e-5) << name;
  }
}

TEST(Ers7, MassGroupsAddUpToTheStartingValuesOfTheMassParameters) {
  std::map<std::string, double> sums;
  for (const Link& link : ers7().links) sums[link.massGroup] += link.inertial.mass_kg;
  const std::map<std::string, double> expected{{"head", 0.19},  {"neck", 0.025}, {"body", 0.62}, {"leg:LF", 0.2},
                                               {"leg:LR", 0.2}, {"leg:RF", 0.2}, {"leg:RR", 0.2}};
  ASSERT_EQ(expected.size(), sums.size());
  for (const auto& [group, mass] : expected) EXPECT_NEAR(mass, sums[group], 1e-9) << group;
}

TEST(Ers7, BalancesOnItsMidlineBetweenItsFeet) {
  std::vector<double> positions(ers7().joints.size(), 0.0);
  const Inertial total = massProperties(ers7(), positions);
  EXPECT_NEAR(1.635, total.mass_kg, 1e-9);
  EXPECT_NEAR(0, total.centreOfMass_m.y(), 1e-9);
  EXPECT_GT(total.centreOfMass_m.x(), contact("LR", standing).x());
  EXPECT_LT(total.centreOfMass_m.x(), contact("LF", standing).x());
}

TEST(Ers7, HasBothJacketsAndKeepsTheTrianglesModerate) {
  std::map<std::string, std::size_t> triangles;
  for (const Link& link : ers7().links)
    for (const Shape& shape : link.shapes) {
      EXPECT_FALSE(shape.collides && !shape.part.empty());
      if (!shape.surface) continue;
      triangles[shape.part] += shape.surface->triangles.size();
      EXPECT_EQ(shape.surface->vertices.size(), shape.surface->normals.size());
    }
  EXPECT_GT(triangles["red"], 100u);
  EXPECT_EQ(triangles["red"], triangles["blue"]);
  EXPECT_LT(triangles[""], 20000u);
}

TEST(Ers7, NothingOfTheStandingDogButItsFeetTouchesTheFloor) {
  const auto poses = posesAt(standing);
  for (const Link& link : ers7().links)
    for (const Shape& shape : link.shapes) {
      if (!shape.collides || shape.kind == Shape::Kind::mesh || link.name.find("LOWER") != std::string::npos) continue;
      // A ball around the shape is a safe bound.
      const double radius = shape.kind == Shape::Kind::box ? shape.size_m.norm() / 2 : shape.size_m.head<2>().norm();
      EXPECT_GT((poses.at(link.name) * shape.pose.translation()).z() - radius, -0.141) << link.name;
    }
}

}  // namespace
}  // namespace btr
