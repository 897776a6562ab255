#include "core/plugin/plugin_module.h"

#include <dlfcn.h>
#include <link.h>

#include <cfenv>

#include "core/spec/system/crash_report.h"

namespace btr {
namespace {

/// A module made with -ffast-math switches denormal numbers off when it is opened.
class KeptFloatingPoint {
 public:
  KeptFloatingPoint() { std::fegetenv(&environment_); }
  ~KeptFloatingPoint() { std::fesetenv(&environment_); }
  KeptFloatingPoint(const KeptFloatingPoint&) = delete;
  KeptFloatingPoint& operator=(const KeptFloatingPoint&) = delete;

 private:
  std::fenv_t environment_{};
};

constexpr PluginBuild ownBuild = BTR_PLUGIN_BUILD;

std::string whyNot(const PluginModule& plugin) {
  if (plugin.apiVersion != pluginApiVersion)
    return "was made for plugin version " + std::to_string(plugin.apiVersion) + ", this program has " +
           std::to_string(pluginApiVersion);
  return differenceOf(plugin.build, ownBuild);
}

}  // namespace

OpenedModule openModule(const std::string& path) {
  const KeptFloatingPoint kept;
  OpenedModule module;
  module.handle = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!module.handle) {
    module.why = std::string("cannot be loaded: ") + ::dlerror();
    return module;
  }
  const auto* plugin = static_cast<const PluginModule*>(::dlsym(module.handle, "btr_plugin"));
  if (!plugin)
    module.why = "is not a plugin of this program (it has no btr_plugin)";
  else
    module.why = whyNot(*plugin);
  if (module.why.empty()) module.plugin = plugin;
  return module;
}

void nameInCrashes(const OpenedModule& module, const std::string& name) {
  link_map* map = nullptr;
  if (::dlinfo(module.handle, RTLD_DI_LINKMAP, &map) != 0 || !map) return;
  struct Search {
    ElfW(Addr) base;
    const std::string& name;
  } search{map->l_addr, name};
  ::dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* data) {
        const auto& wanted = *static_cast<const Search*>(data);
        if (info->dlpi_addr != wanted.base) return 0;
        for (int i = 0; i < info->dlpi_phnum; ++i) {
          const auto& segment = info->dlpi_phdr[i];
          if (segment.p_type != PT_LOAD || !(segment.p_flags & PF_X)) continue;
          const auto* begin = reinterpret_cast<const char*>(info->dlpi_addr + segment.p_vaddr);
          rememberCode(begin, begin + segment.p_memsz, wanted.name);
        }
        return 1;
      },
      &search);
}

}  // namespace btr
