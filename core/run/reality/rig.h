#pragma once
#include <optional>
#include <string>

#include "core/spec/scene_spec.h"
#include "core/store/database.h"

namespace btr {

/// A rig is a scene that no run belongs to (a servo with a pendulum, an arm on a table). What it was found to lack is
/// kept in the experiment database like a run's simulator: in numbered versions, of which number 0 is the scene as
/// given. It is known by its scene's numbers and its models' bytes, not by where the files lie.
struct Rig {
  std::string name;  ///< of the scene's file: "xl330"
  std::string spec;  ///< JSON text ("format": "uchilsim-rig-1") that stands for it in the database
  SceneSpec scene;   ///< as its file has it
};

/// Reads the scene and its models. Throws InputError.
Rig loadRig(const std::string& scene);

/// The rig of this scene in the database, if it has one.
std::optional<Id> findRig(const Database& database, const Rig& rig);
/// The same by the scene's file. Throws InputError where the database has nothing of it.
Id requireRig(const Database& database, const std::string& scene);
/// The rig in the database: added, with the scene as given as version 0, where it is not there yet.
Id addRig(Database& database, const Rig& rig);

}  // namespace btr
