#include "core/sim/effect_places.h"

#include <algorithm>
#include <iterator>

namespace btr {
namespace {

bool isPlace(const SceneRobot& robot, std::size_t joint, EffectJoints joints) {
  if (joints == EffectJoints::driven) return robot.drives[joint].kind != Drive::Kind::none;
  return robot.model.joints[joint].type != Joint::Type::fixed;
}

void addJoints(const SceneRobot& robot, EffectJoints joints, std::vector<std::string>& places) {
  for (std::size_t i = 0; i < robot.model.joints.size(); ++i)
    if (isPlace(robot, i, joints)) places.push_back(robot.name + "." + robot.model.joints[i].name);
}

void addLinks(const SceneRobot& robot, std::vector<std::string>& places) {
  for (std::size_t i = robot.freeBase ? 0 : 1; i < robot.model.links.size(); ++i)
    if (robot.model.links[i].inertial.mass_kg > 0) places.push_back(robot.name + "." + robot.model.links[i].name);
}

}  // namespace

std::vector<std::string> effectPlaces(Effect::Place place, const Scene& scene, std::span<const SceneRobot> robots,
                                      EffectJoints joints) {
  std::vector<std::string> places;
  switch (place) {
    case Effect::Place::joint:
      for (const SceneRobot& robot : robots) addJoints(robot, joints, places);
      break;
    case Effect::Place::link:
      for (const SceneRobot& robot : robots) addLinks(robot, places);
      break;
    case Effect::Place::ball:
      for (const BallSpec& ball : scene.balls) places.push_back(ball.name);
      break;
    case Effect::Place::floor:
      if (scene.floor) places.emplace_back("floor");
      break;
    case Effect::Place::world:
      places.emplace_back("world");
      break;
  }
  return places;
}

std::string ownerOf(const std::string& place) { return place.substr(0, place.find('.')); }

std::string everyJointOf(const std::string& robot) { return robot + ".*"; }

std::vector<std::string> sharedPlaces(const Effect& effect, std::span<const SceneRobot> robots) {
  std::vector<std::string> places;
  if (effect.place() != Effect::Place::joint || effect.law().acts != EffectLaw::Acts::command) return places;
  for (const SceneRobot& robot : robots)
    if (std::ranges::count_if(robot.drives, [](const Drive& drive) { return drive.kind != Drive::Kind::none; }) > 1)
      places.push_back(everyJointOf(robot.name));
  return places;
}

std::vector<std::string> effectPlaces(const Effect& effect, const Scene& scene, std::span<const SceneRobot> robots) {
  std::vector<std::string> places = effectPlaces(effect.place(), scene, robots);
  std::ranges::move(sharedPlaces(effect, robots), std::back_inserter(places));
  return places;
}

}  // namespace btr
