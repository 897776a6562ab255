#include "core/plugin/plugin_host.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <sstream>

#include "core/plugin/plugin_module.h"
#include "core/spec/error.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

template <class Kind>
using Makers = std::map<std::string, std::function<std::unique_ptr<Kind>()>>;

constexpr const char* kindFolders[] = {"controllers", "learners", "fitness", "effects", "reality"};

/// All regular files named *.so below the folders of the kinds, sorted, so that every machine loads them in the same
/// order.
std::vector<fs::path> modulesBelow(const fs::path& directory) {
  std::vector<fs::path> modules;
  for (const char* kind : kindFolders) {
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
  Makers<Reality> realities;
  std::vector<PluginInfo> plugins;
  std::vector<PluginFailure> failures;
  std::vector<std::string> seen;  ///< files that were tried, once each whatever folder names them
  mutable std::mutex guard;
  std::string addedKind;
  bool doubled = false;

  template <class Kind>
  void keep(Makers<Kind>& makers, const char* kind, const char* name, std::function<std::unique_ptr<Kind>()> maker) {
    addedKind = kind;
    doubled = !makers.emplace(name, std::move(maker)).second;
  }
  void add(const char* name, std::function<std::unique_ptr<Controller>()> maker) override {
    keep(controllers, "controller", name, std::move(maker));
  }
  void add(const char* name, std::function<std::unique_ptr<Learner>()> maker) override {
    keep(learners, "learner", name, std::move(maker));
  }
  void add(const char* name, std::function<std::unique_ptr<Fitness>()> maker) override {
    keep(fitnesses, "fitness", name, std::move(maker));
  }
  void add(const char* name, std::function<std::unique_ptr<Effect>()> maker) override {
    keep(effects, "effect", name, std::move(maker));
  }
  void add(const char* name, std::function<std::unique_ptr<Reality>()> maker) override {
    keep(realities, "reality", name, std::move(maker));
  }

  /// Returns what is wrong with the module, or "".
  std::string load(const fs::path& path) {
    const OpenedModule module = openModule(path.string());
    if (!module.plugin) return module.why;
    const PluginModule& plugin = *module.plugin;
    doubled = false;
    plugin.registerIn(*this);
    if (doubled) {
      const auto first = std::find_if(plugins.begin(), plugins.end(), [&](const PluginInfo& p) {
        return p.kind == addedKind && p.name == plugin.name;
      });
      return "another " + addedKind + " plugin has the same name \"" + plugin.name + "\": " + first->path;
    }
    plugins.push_back(
        {addedKind, plugin.name, plugin.about.version, plugin.about.author, plugin.about.licence, path.string()});
    nameInCrashes(module, "the " + addedKind + " plugin \"" + plugin.name + "\"");
    return "";
  }

  void loadAllBelow(const fs::path& directory) {
    for (const fs::path& path : modulesBelow(directory)) {
      const std::string file = fs::canonical(path).string();
      if (std::find(seen.begin(), seen.end(), file) != seen.end()) continue;
      seen.push_back(file);
      if (std::string why = load(path); !why.empty()) failures.push_back({path.string(), std::move(why)});
    }
  }

  template <class Kind>
  std::vector<std::string> names(const Makers<Kind>& makers) const {
    const std::lock_guard lock(guard);
    std::vector<std::string> names;
    for (const auto& [name, make] : makers) names.push_back(name);
    return names;
  }

  template <class Kind>
  std::unique_ptr<Kind> make(const Makers<Kind>& makers, const std::string& kind, const std::string& name) const {
    {
      const std::lock_guard lock(guard);
      if (const auto found = makers.find(name); found != makers.end()) return found->second();
    }
    std::string known;
    for (const std::string& other : names(makers)) known += (known.empty() ? "" : ", ") + other;
    throw InputError(kind, "\"" + name + "\"", known.empty() ? "no plugins of this kind are there" : "known: " + known);
  }
};

PluginHost::PluginHost(const std::vector<std::string>& directories) : impl_(std::make_unique<Impl>()) {
  for (const std::string& directory : directories) {
    if (fs::is_directory(directory))
      impl_->loadAllBelow(directory);
    else if (&directory == &directories.front())
      throw InputError("plugin directory", directory, "a folder with controllers, learners, fitness, effects, reality");
    else
      impl_->failures.push_back({directory, "there is no such folder of plugins"});
  }
}

PluginHost::~PluginHost() = default;

std::string PluginHost::standardDirectory() {
  const fs::path library = fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "lib";
  const fs::path installed = library / "uchilsim" / "plugins";
  return (fs::is_directory(installed) ? installed : library / "plugins").string();
}

std::vector<std::string> PluginHost::searchPath() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value ? value : "");
  };
  std::vector<std::string> path{standardDirectory()};
  std::istringstream named(variable("UCHILSIM_PLUGINS"));
  for (std::string folder; std::getline(named, folder, ':');)
    if (!folder.empty()) path.push_back(folder);
  const std::string data = variable("XDG_DATA_HOME"), home = variable("HOME");
  if (!data.empty() || !home.empty()) {
    const fs::path own = (data.empty() ? fs::path(home) / ".local" / "share" : fs::path(data)) / "uchilsim" / "plugins";
    if (fs::is_directory(own)) path.push_back(own.string());
  }
  return path;
}

void PluginHost::load(const std::vector<std::string>& directories, const std::string& place) const {
  const std::lock_guard lock(impl_->guard);
  for (const std::string& directory : directories) {
    if (!fs::is_directory(directory))
      throw InputError(place, directory, "a folder with controllers, learners, fitness, effects, reality");
    impl_->loadAllBelow(directory);
    for (const PluginFailure& failure : impl_->failures)
      if (fs::path(failure.path).parent_path().parent_path() == fs::path(directory))
        throw InputError(place + ": " + failure.path + ": " + failure.why);
  }
}

std::unique_ptr<Controller> PluginHost::controller(const std::string& name) const {
  return impl_->make(impl_->controllers, "controller", name);
}
std::unique_ptr<Learner> PluginHost::learner(const std::string& name) const {
  return impl_->make(impl_->learners, "learner", name);
}
std::unique_ptr<Fitness> PluginHost::fitness(const std::string& name) const {
  return impl_->make(impl_->fitnesses, "fitness", name);
}
std::shared_ptr<const Effect> PluginHost::effect(const std::string& name) const {
  return impl_->make(impl_->effects, "effect", name);
}
std::shared_ptr<const Reality> PluginHost::reality(const std::string& name) const {
  return impl_->make(impl_->realities, "reality", name);
}

std::vector<std::string> PluginHost::controllers() const { return impl_->names(impl_->controllers); }
std::vector<std::string> PluginHost::learners() const { return impl_->names(impl_->learners); }
std::vector<std::string> PluginHost::fitnesses() const { return impl_->names(impl_->fitnesses); }
std::vector<std::string> PluginHost::effects() const { return impl_->names(impl_->effects); }
std::vector<std::string> PluginHost::realities() const { return impl_->names(impl_->realities); }

std::vector<PluginInfo> PluginHost::plugins() const {
  const std::lock_guard lock(impl_->guard);
  return impl_->plugins;
}
std::vector<PluginFailure> PluginHost::failures() const {
  const std::lock_guard lock(impl_->guard);
  return impl_->failures;
}
std::vector<std::string> PluginHost::problems() const {
  std::vector<std::string> problems;
  for (const PluginFailure& failure : failures()) problems.push_back(failure.path + ": " + failure.why);
  return problems;
}

EffectFactory PluginHost::effectFactory() const {
  return [this](const std::string& name) { return effect(name); };
}

}  // namespace btr
