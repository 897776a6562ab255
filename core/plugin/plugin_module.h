#pragma once
#include <string>

#include "core/plugin/plugin.h"

namespace btr {

/// A module's file, opened and checked; `plugin` is nullptr if it cannot be used, and `why` ends the sentence that
/// begins with its path. Opening changes neither the rounding nor the flushing of small numbers of this thread,
/// whatever the module was compiled with. Never closed: what a module made may live until the program ends.
struct OpenedModule {
  void* handle = nullptr;
  const PluginModule* plugin = nullptr;
  std::string why;
};
OpenedModule openModule(const std::string& path);

/// Names the module's code in reports of crashes.
void nameInCrashes(const OpenedModule& module, const std::string& name);

}  // namespace btr
