#include "core/sim/scene.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/sim/effect_places.h"
#include "core/sim/world/scene_build.h"
#include "core/spec/error.h"

namespace btr {
namespace {

/// One of a whole robot is one at each of its joints that moves.
std::vector<SceneEffect> atEveryJoint(const Scene& scene, const SceneEffect& effect) {
  std::vector<SceneEffect> all;
  for (const auto& robot : scene.robots) {
    if (effect.at != everyJointOf(robot.name)) continue;
    for (const std::string& joint : effectPlaces(Effect::Place::joint, scene, {&robot, 1})) {
      all.push_back(effect);
      all.back().at = joint;
    }
  }
  return all;
}

std::vector<SceneEffect> placeEffect(const Scene& scene, const PlacedEffect& placed, const EffectFactory& factory) {
  SceneEffect effect;
  effect.effect = factory(placed.effect);
  effect.name = placed.effect;
  effect.at = placed.at;
  const std::string where = "effect " + placed.effect;
  effect.values = resolve(effect.effect->parameters(), placed.parameters, where);

  const auto among = [&](const auto& things, auto&& nameOf) {
    return std::any_of(things.begin(), things.end(), [&](const auto& thing) { return nameOf(thing) == placed.at; });
  };
  bool there = false;
  std::string allowed;
  switch (effect.effect->place()) {
    case Effect::Place::joint:
      if (const auto everywhere = atEveryJoint(scene, effect); !everywhere.empty()) return everywhere;
      allowed = "ROBOT.* (all its joints) or ROBOT.JOINT";
      for (const auto& robot : scene.robots)
        there = there || among(robot.model.joints, [&](const Joint& joint) {
                  return joint.type == Joint::Type::fixed ? std::string() : robot.name + "." + joint.name;
                });
      break;
    case Effect::Place::link:
      allowed = "ROBOT.LINK";
      for (const auto& robot : scene.robots)
        there = there || among(robot.model.links, [&](const Link& link) { return robot.name + "." + link.name; });
      break;
    case Effect::Place::ball:
      allowed = "the name of a ball";
      there = among(scene.balls, [](const BallSpec& ball) { return ball.name; });
      break;
    case Effect::Place::floor:
      allowed = "floor";
      there = placed.at == "floor" && scene.floor;
      break;
    case Effect::Place::world:
      allowed = "world";
      there = placed.at == "world";
      break;
  }
  if (!there) throw InputError(where + " at", placed.at, allowed + " of the scene");
  return {effect};
}

}  // namespace

Scene makeScene(const SceneSpec& spec, const ModelSet& models, const SimulatorSpec& simulator,
                const EffectFactory& effects) {
  Scene scene = sceneFromModels(spec, models);
  // Group parameters first: a path may then correct a single number.
  const auto isParameter = [](const std::string& name) { return find(simulatorParameters(), name) != nullptr; };
  for (const auto& [name, value] : simulator.values)
    if (isParameter(name)) setSimulatorParameter(scene, spec, name, value);
  // A mass takes its inertia with it: it comes before an inertia that is given.
  for (const bool mass : {true, false})
    for (const auto& [name, value] : simulator.values)
      if (!isParameter(name) && name.ends_with(".mass_kg") == mass) setByPath(scene, name, value);
  for (const auto& placed : simulator.effects)
    std::ranges::move(placeEffect(scene, placed, effects), std::back_inserter(scene.effects));
  // Of what else is there an effect may ask, in whichever order they stand.
  for (const SceneEffect& effect : std::vector<SceneEffect>(scene.effects))
    effect.effect->changeScene(scene, effect.at, effect.values);
  // Hits need a millisecond, whatever the rest of a kick can bear.
  constexpr double nearStep_s = 0.001;
  if (!scene.robots.empty() && !scene.balls.empty())
    scene.nearSubsteps = std::max(1, static_cast<int>(std::lround(scene.step_s / nearStep_s)));
  return scene;
}

}  // namespace btr
