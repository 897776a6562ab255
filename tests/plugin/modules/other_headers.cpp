#include "tests/plugin/modules/empty_effect.h"

namespace {
constexpr btr::PluginBuild withOtherHeaders() {
  btr::PluginBuild build = BTR_PLUGIN_BUILD;
  ++build.layout;
  return build;
}
}  // namespace

extern "C" {
extern const btr::PluginModule btr_plugin;
const btr::PluginModule btr_plugin = {
    btr::pluginApiVersion, withOtherHeaders(), "other_headers", {}, [](btr::PluginRegistry& registry) {
      registry.add("other_headers",
                   std::function<std::unique_ptr<btr::Effect>()>([] { return std::make_unique<EmptyEffect>(); }));
    }};
}
