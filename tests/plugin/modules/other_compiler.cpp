#include "tests/plugin/modules/empty_effect.h"

extern "C" {
extern const btr::PluginModule btr_plugin;
const btr::PluginModule btr_plugin = {
    btr::pluginApiVersion, "another compiler 1.0", "other_compiler", [](btr::PluginRegistry& registry) {
      registry.add("other_compiler",
                   std::function<std::unique_ptr<btr::Effect>()>([] { return std::make_unique<EmptyEffect>(); }));
    }};
}
