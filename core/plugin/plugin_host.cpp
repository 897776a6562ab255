#include "core/plugin/plugin_host.h"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "core/spec/error.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

template <class Kind>
using Makers = std::map<std::string, std::function<std::unique_ptr<Kind>()>>;

template <class Kind>
std::vector<std::string> names(const Makers<Kind>& makers) {
  std::vector<std::string> names;
  for (const auto& [name, make] : makers) names.push_back(name);
  return names;
}

template <class Kind>
std::unique_ptr<Kind> make(const Makers<Kind>& makers, const std::string& kind, const std::string& name) {
  const auto found = makers.find(name);
  if (found != makers.end()) return found->second();
  std::string known;
  for (const std::string& other : names(makers)) known += (known.empty() ? "" : ", ") + other;
  throw InputError(kind, "\"" + name + "\"", known.empty() ? "no plugins of this kind are there" : "known: " + known);
}

/// All regular files named *.so below the four folders, sorted, so that every machine loads them in the same order.
std::vector<fs::path> modulesBelow(const fs::path& directory) {
  std::vector<fs::path> modules;
  for (const char* kind : {"controllers", "learners", "fitness", "effects"}) {
    if (!fs::is_directory(directory / kind)) continue;
    for (const auto& entry : fs::directory_iterator(directory / kind))
      if (entry.is_regular_file() && entry.path().extension() == ".so") modules.push_back(entry.path());
  }
  std::sort(modules.begin(), modules.end());
  return modules;
}

}  // namespace

struct PluginHost::Impl final : PluginRegistry {
  Makers<Controller> controllers;
  Makers<Learner> learners;
  Makers<Fitness> fitnesses;
  Makers<Effect> effects;
  std::vector<std::string> problems;
  bool doubled = false;

  template <class Kind>
  void keep(Makers<Kind>& makers, const char* name, std::function<std::unique_ptr<Kind>()> maker) {
    doubled = !makers.emplace(name, std::move(maker)).second;
  }
  void add(const char* name, std::function<std::unique_ptr<Controller>()> maker) override {
    keep(controllers, name, std::move(maker));
  }
  void add(const char* name, std::function<std::unique_ptr<Learner>()> maker) override {
    keep(learners, name, std::move(maker));
  }
  void add(const char* name, std::function<std::unique_ptr<Fitness>()> maker) override {
    keep(fitnesses, name, std::move(maker));
  }
  void add(const char* name, std::function<std::unique_ptr<Effect>()> maker) override {
    keep(effects, name, std::move(maker));
  }

  /// Returns what is wrong with the module, or "".
  std::string load(const fs::path& path) {
    // Never closed: what a module made may live until the program ends.
    void* const module = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!module) return ::dlerror();
    const auto* plugin = static_cast<const PluginModule*>(::dlsym(module, "btr_plugin"));
    if (!plugin) return "is not a plugin of this program (it has no btr_plugin)";
    if (plugin->apiVersion != pluginApiVersion)
      return "was made for plugin version " + std::to_string(plugin->apiVersion) + ", this program has " +
             std::to_string(pluginApiVersion);
    if (std::string(plugin->compiler) != __VERSION__)
      return "was made by compiler " + std::string(plugin->compiler) + ", this program by " __VERSION__;
    doubled = false;
    plugin->registerIn(*this);
    return doubled ? "another module has the same name \"" + std::string(plugin->name) + "\"" : "";
  }
};

PluginHost::PluginHost(const std::string& directory) : impl_(std::make_unique<Impl>()) {
  if (!fs::is_directory(directory))
    throw InputError("plugin directory", directory, "a folder with controllers, learners, fitness, effects");
  for (const fs::path& path : modulesBelow(directory))
    if (const std::string problem = impl_->load(path); !problem.empty())
      impl_->problems.push_back(path.string() + ": " + problem);
}

PluginHost::~PluginHost() = default;

std::string PluginHost::standardDirectory() {
  if (const char* given = std::getenv("UCHILSIM_PLUGINS"); given && *given) return given;
  const fs::path library = fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "lib";
  const fs::path beside = library / "plugins";
  return (fs::is_directory(beside) ? beside : library / "uchilsim" / "plugins").string();
}

std::unique_ptr<Controller> PluginHost::controller(const std::string& name) const {
  return make(impl_->controllers, "controller", name);
}
std::unique_ptr<Learner> PluginHost::learner(const std::string& name) const {
  return make(impl_->learners, "learner", name);
}
std::unique_ptr<Fitness> PluginHost::fitness(const std::string& name) const {
  return make(impl_->fitnesses, "fitness", name);
}
std::shared_ptr<const Effect> PluginHost::effect(const std::string& name) const {
  return make(impl_->effects, "effect", name);
}

std::vector<std::string> PluginHost::controllers() const { return names(impl_->controllers); }
std::vector<std::string> PluginHost::learners() const { return names(impl_->learners); }
std::vector<std::string> PluginHost::fitnesses() const { return names(impl_->fitnesses); }
std::vector<std::string> PluginHost::effects() const { return names(impl_->effects); }
const std::vector<std::string>& PluginHost::problems() const { return impl_->problems; }

EffectFactory PluginHost::effectFactory() const {
  return [this](const std::string& name) { return effect(name); };
}

}  // namespace btr
