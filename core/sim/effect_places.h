#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/sim/effect.h"
#include "core/sim/scene.h"

namespace btr {

enum class EffectJoints {
  moving,  ///< every joint that is not fixed
  driven   ///< only those with a drive
};

/// Where an effect of this kind can sit in a scene, as simulator files write it (`dog.leg1`, `ball`, `floor`,
/// `world`), in the scene's order: at joints and links of `robots`, at all balls. Links are those that can move and
/// have a mass, as a load changes nothing of the others.
std::vector<std::string> effectPlaces(Effect::Place place, const Scene& scene, std::span<const SceneRobot> robots,
                                      EffectJoints joints = EffectJoints::moving);

/// What a place belongs to: "dog" of "dog.leg1"; a ball's or the floor's is itself.
std::string ownerOf(const std::string& place);

/// The place of an effect that all joints of a robot have with the same numbers, as simulator files write it: "dog.*".
std::string everyJointOf(const std::string& robot);

/// Where all joints of a robot may share an effect: at robots with several drives, what changes commands on their way
/// to them (one bus, one frame, one firmware). Empty for other effects.
std::vector<std::string> sharedPlaces(const Effect& effect, std::span<const SceneRobot> robots);

/// All of these: where this effect can sit by itself, then what it may be shared by.
std::vector<std::string> effectPlaces(const Effect& effect, const Scene& scene, std::span<const SceneRobot> robots);

}  // namespace btr
