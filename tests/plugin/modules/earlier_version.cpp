#include "tests/plugin/modules/empty_effect.h"

extern "C" {
extern const btr::PluginModule btr_plugin;
const btr::PluginModule btr_plugin = {
    btr::pluginApiVersion - 1, BTR_PLUGIN_BUILD, "earlier_version", {}, [](btr::PluginRegistry& registry) {
      registry.add("earlier_version",
                   std::function<std::unique_ptr<btr::Effect>()>([] { return std::make_unique<EmptyEffect>(); }));
    }};
}
