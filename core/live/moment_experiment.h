#pragma once
#include <string>

#include "core/plugin/plugin_host.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/scene_spec.h"

namespace btr {

class Session;

/// An experiment that begins where a session is, and the scene that it needs.
struct MomentExperiment {
  ExperimentSpec experiment;  ///< without a path of its scene
  SceneSpec scene;
};

/// One robot learns: `robot`, or where it is "" the first that a controller plugin moves, or else the first. It is the
/// scene's first and stands on the z axis, looking along x, as controllers place what they drive; everything else is
/// where it is, seen from there. What it learns is the plugin that moves it, the search beginning around the parameters
/// it has; of a robot without one the first of kick, walk and all others that this scene is enough for, with the
/// fitness that belongs to it. Throws InputError where there is no robot, or none of them.
MomentExperiment experimentOf(const Session& session, const PluginHost& host, const std::string& robot = "");

/// Writes both: the experiment into `file`, its scene beside it as NAME.scene.json. Throws InputError.
void writeExperiment(const MomentExperiment& moment, const std::string& file);

}  // namespace btr
