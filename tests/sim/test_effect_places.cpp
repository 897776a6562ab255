// Where effects can sit in a scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/sim/effect_places.h"
#include "tests/plugin/built_plugins.h"
#include "tests/sim/small_worlds.h"

namespace btr::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A rig with a driven hinge, a hinge without a drive, a frame without mass bolted to the last; and a body that lies.
Scene rigAndBody() {
  RobotModel rig;
  rig.name = "rig";
  rig.links = {link("stand", 5, {0, 0, 0}, {1, 1, 1}), link("arm", 1, {0, 0, -0.1}, {0.01, 0.01, 0.01}),
               link("tip", 0.1, {0, 0, -0.1}, {0.001, 0.001, 0.001}), link("marker", 0, {0, 0, 0}, {0, 0, 0})};
  rig.joints = {joint("hinge", 0, {0, 1, 0}), joint("flap", 1, {0, 1, 0}),
                joint("bolt", 2, {0, 1, 0}, {0, 0, 0}, Joint::Type::fixed)};
  RobotModel body;
  body.name = "body";
  body.links = {link("hull", 1, {0, 0, 0}, {0.01, 0.01, 0.01})};
  Scene scene;
  scene.robots = {robot(rig, false), robot(body, true)};
  scene.robots[0].drives[0].kind = Drive::Kind::torque;
  return scene;
}

std::vector<std::string> places(Effect::Place place, const Scene& scene, EffectJoints joints = EffectJoints::moving) {
  return effectPlaces(place, scene, scene.robots, joints);
}

TEST(EffectPlaces, AreJointsThatMoveOrOnlyThoseThatAreDriven) {
  const Scene scene = rigAndBody();
  EXPECT_THAT(places(Effect::Place::joint, scene), ElementsAre("rig.hinge", "rig.flap"));
  EXPECT_THAT(places(Effect::Place::joint, scene, EffectJoints::driven), ElementsAre("rig.hinge"));
}

TEST(EffectPlaces, ALoadSitsOnlyOnWhatHasAMassAndCanMove) {
  EXPECT_THAT(places(Effect::Place::link, rigAndBody()), ElementsAre("rig.arm", "rig.tip", "body.hull"));
}

TEST(EffectPlaces, AreThoseOfTheRobotsThatAreAskedFor) {
  const Scene scene = rigAndBody();
  EXPECT_THAT(effectPlaces(Effect::Place::link, scene, std::span(scene.robots).last(1)), ElementsAre("body.hull"));
  EXPECT_THAT(effectPlaces(Effect::Place::joint, scene, {}), IsEmpty());
}

TEST(EffectPlaces, AFloorIsOneOnlyWhereThereIsOne) {
  Scene scene = rigAndBody();
  scene.floor.reset();
  EXPECT_THAT(places(Effect::Place::floor, scene), IsEmpty());
  EXPECT_THAT(places(Effect::Place::world, scene), ElementsAre("world"));
  EXPECT_THAT(places(Effect::Place::ball, scene), IsEmpty());
}

/// What joints share is looked for on the way of commands, and only where several drives follow commands.
TEST(EffectPlaces, AreSharedByAllJointsWhereSeveralHaveDrives) {
  Scene scene = rigAndBody();
  const auto late = host().effect("command_delay");
  EXPECT_THAT(sharedPlaces(*late, scene.robots), IsEmpty());
  scene.robots[0].drives[1].kind = Drive::Kind::torque;
  EXPECT_THAT(sharedPlaces(*late, scene.robots), ElementsAre("rig.*"));
  EXPECT_THAT(sharedPlaces(*host().effect("backlash"), scene.robots), IsEmpty());
}

}  // namespace
}  // namespace btr::test
