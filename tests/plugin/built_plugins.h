#pragma once
// The plugins that were built, and where their effects sit in a small scene.
#include <memory>
#include <string>
#include <vector>

#include "core/plugin/plugin_host.h"

namespace btr::test {

/// With those of UCHILSIM_PLUGINS: an author may run the same tests over a new effect.
inline const PluginHost& host() {
  static const PluginHost plugins(PluginHost::searchPath());
  return plugins;
}

inline std::shared_ptr<const Effect> effect(const std::string& name) { return host().effect(name); }

/// All but measured_law, a table of 60 numbers that does nothing in its defaults:
/// tests/gap/search/measured_law_test.cpp.
inline std::vector<std::string> effectsWithASize() {
  std::vector<std::string> names = host().effects();
  std::erase(names, "measured_law");
  return names;
}

/// Where an effect can sit in a scene with this joint and link.
inline std::string placeFor(Effect::Place place, const std::string& joint, const std::string& link) {
  switch (place) {
    case Effect::Place::joint:
      return joint;
    case Effect::Place::link:
      return link;
    case Effect::Place::ball:
      return "ball";
    case Effect::Place::floor:
      return "floor";
    case Effect::Place::world:
      return "world";
  }
  return "";
}

}  // namespace btr::test
