#pragma once
#include <string>

#include "core/spec/experiment_spec.h"

namespace btr {

/// A published gait and how fast a real robot went with it ("format": "uchilsim-gait-1").
struct GaitSpec {
  std::string name;
  std::string scene;        ///< path of the scene file with the robot it belongs to, relative to the gait's file
  PluginChoice controller;  ///< with its settings
  Values parameters;        ///< of the controller's genotype, by name; what is absent has its default
  PluginChoice fitness;     ///< what was measured
  double real = 0;          ///< in the fitness' unit
  bool measured = true;     ///< false: a speed that was commanded or reached at most, nobody says that it was measured
  std::string source, certainty, note;
  std::string directory;  ///< of the gait's file; not part of the JSON
};

/// Throws InputError. The plugins' own names and bounds are checked where the plugins are known.
GaitSpec gaitFromJson(const std::string& text, const std::string& place, const std::string& directory);
GaitSpec loadGait(const std::string& path);

}  // namespace btr
