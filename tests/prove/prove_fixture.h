#pragma once
#include "core/plugin/plugin_host.h"
#include "tests/prove/blind_case.h"

namespace btr::prove {

/// The library as the generator sees it.
struct Plugins {
  PluginHost host{PLUGIN_DIR};
  Hideable library{host.effectFactory(), host.effects()};
};

inline BlindCase caseOf(const Plugins& plugins, const std::string& scene, const std::string& kind, std::uint64_t number,
                        const std::string& engine = "ode") {
  return drawCase({.seed = 77, .number = number, .engine = engine, .scene = scene, .kind = kind}, plugins.library);
}

}  // namespace btr::prove
