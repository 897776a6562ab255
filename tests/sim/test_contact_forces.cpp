#include <gtest/gtest.h>

#include "core/sim/world.h"

namespace btr {
namespace {

/// A box of 2 kg and 0.1 m that stands on the floor.
Scene boxOnTheFloor() {
  Scene scene;
  scene.step_s = scene.controlPeriod_s = 0.002;
  scene.floor = FloorSpec{};
  ObstacleSpec box;
  box.name = "box";
  box.mass_kg = 2;
  box.position_m = {0.3, 0.2, 0.05};
  scene.obstacles = {box};
  return scene;
}

void advance(World& world, double seconds) { world.advance({}, seconds); }

TEST(ContactForces, CarryTheWeightUnderTheBody) {
  World world(boxOnTheFloor(), 1);
  world.measureForces();
  advance(world, 2);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  ASSERT_GE(world.contactForces().size(), 3u);
  for (const ContactForce& contact : world.contactForces()) {
    EXPECT_NEAR(contact.place_m.z(), 0, 1e-3);
    EXPECT_NEAR(contact.place_m.x(), 0.3, 0.051);
    EXPECT_NEAR(contact.place_m.y(), 0.2, 0.051);
    sum += contact.force_n;
    moment += (contact.place_m - Eigen::Vector3d(0.3, 0.2, 0)).cross(contact.force_n);
  }
  EXPECT_NEAR(sum.z(), 2 * 9.81, 1e-3);
  EXPECT_NEAR(sum.head<2>().norm(), 0, 1e-3);
  EXPECT_NEAR(moment.norm(), 0, 1e-3);
  EXPECT_LT((sum - world.floorForce_n()).norm(), 1e-12);
}

TEST(ContactForces, OfTwoBodiesAreThoseOfTheUpperOnesWeight) {
  Scene scene = boxOnTheFloor();
  ObstacleSpec upper = scene.obstacles[0];
  upper.name = "upper";
  upper.mass_kg = 0.5;
  upper.position_m[2] = 0.15;
  scene.obstacles.push_back(upper);
  World world(scene, 1);
  world.measureForces();
  advance(world, 2);
  double below = 0, between = 0;
  for (const ContactForce& contact : world.contactForces())
    (contact.place_m.z() > 0.05 ? between : below) += std::abs(contact.force_n.z());
  EXPECT_NEAR(below, 2.5 * 9.81, 1e-2);
  EXPECT_NEAR(between, 0.5 * 9.81, 1e-2);
}

/// Where a tumbling box is after a second.
std::vector<double> tumbled(bool measured) {
  World world(boxOnTheFloor(), 1);
  world.measureForces(measured);
  ObstacleState thrown = world.obstacle(0);
  thrown.velocity_m_s = {1, 0.3, 2};
  thrown.spin_rad_s = {3, 1, 0};
  world.setObstacle(0, thrown);
  advance(world, 1);
  EXPECT_EQ(world.contactForces().empty(), !measured);
  std::vector<double> row;
  world.sample(row);
  return row;
}

TEST(ContactForces, AreNotThereUnlessTheyAreMeasuredAndChangeNoBit) { EXPECT_EQ(tumbled(true), tumbled(false)); }

}  // namespace
}  // namespace btr
