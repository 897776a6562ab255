#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/live/game.h"
#include "core/sim/scene.h"

namespace btr {

/// Numbers of the simulator that belong together.
struct NumberGroup {
  enum class Of { world, robot, joint, link };
  Of of = Of::world;
  std::string item;                        ///< the joint or link
  std::vector<Parameter> parameters;       ///< named as in a form
  std::map<std::string, std::string> key;  ///< by those names: as a simulator file calls them
  Values usual;                            ///< what scene and models say, by those names
};

/// What can be changed of one robot's own simulator, or with "" of the one that all robots share which have none: the
/// simulator's declared parameters, and each joint's and link's numbers.
std::vector<NumberGroup> numberGroups(const Game& game, const ModelSet& models, const std::string& robot);

/// Where an effect may act, for one robot or with "" for all.
std::vector<std::string> placesFor(const Effect& effect, const Game& game, const ModelSet& models,
                                   const std::string& robot);

/// The simulator that is meant: the robot's own if it has one, else the shared one.
const SimulatorSpec& simulatorIn(const Game& game, const std::string& robot);

}  // namespace btr
