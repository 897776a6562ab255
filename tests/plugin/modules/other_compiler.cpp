#include "tests/plugin/modules/empty_effect.h"

namespace {
constexpr btr::PluginBuild withAnotherCompiler() {
  btr::PluginBuild build = BTR_PLUGIN_BUILD;
  build.compiler = "another compiler 1.0";
  return build;
}
}  // namespace

extern "C" {
extern const btr::PluginModule btr_plugin;
const btr::PluginModule btr_plugin = {
    btr::pluginApiVersion, withAnotherCompiler(), "other_compiler", {}, [](btr::PluginRegistry& registry) {
      registry.add("other_compiler",
                   std::function<std::unique_ptr<btr::Effect>()>([] { return std::make_unique<EmptyEffect>(); }));
    }};
}
