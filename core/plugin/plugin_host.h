#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/plugin/plugin.h"
#include "core/sim/scene.h"

namespace btr {

/// A plugin that was loaded. What its author does not say is "".
struct PluginInfo {
  std::string kind;  ///< "controller", "learner", "fitness", "effect", "reality"
  std::string name, version, author, licence;
  std::string path;  ///< of the module's file
};

/// A module or a folder that could not be loaded.
struct PluginFailure {
  std::string path;
  std::string why;  ///< the end of a sentence that begins with the path
};

/// Loads plugin modules (never unloads them) and makes what they offer. A folder of plugins has a folder for each kind:
/// controllers, learners, fitness, effects, reality; each *.so in them is a module. Of two plugins with the same kind
/// and name the first is kept and the second refused.
class PluginHost {
 public:
  /// Loads the modules of one folder. A module that cannot be loaded is left out and stands in failures(). Throws
  /// InputError if the folder does not exist.
  explicit PluginHost(const std::string& directory) : PluginHost(std::vector<std::string>{directory}) {}
  /// The same for several folders, in their order; only the first must exist.
  explicit PluginHost(const std::vector<std::string>& directories);
  ~PluginHost();
  PluginHost(const PluginHost&) = delete;
  PluginHost& operator=(const PluginHost&) = delete;

  /// The folder that came with the running program: ../lib/uchilsim/plugins (installed) or ../lib/plugins (built).
  static std::string standardDirectory();
  /// Where programs look: the standard folder, those of $UCHILSIM_PLUGINS (separated by colons), and the user's:
  /// $XDG_DATA_HOME/uchilsim/plugins (~/.local/share/uchilsim/plugins) if it exists.
  static std::vector<std::string> searchPath();

  /// Loads further folders, which an experiment names; what was loaded before stays. Throws InputError, naming `place`,
  /// if a folder does not exist or a module in it cannot be loaded. May be called from any thread.
  void load(const std::vector<std::string>& directories, const std::string& place) const;

  /// Each throws InputError naming the plugins that exist when `name` does not.
  std::unique_ptr<Controller> controller(const std::string& name) const;
  std::unique_ptr<Learner> learner(const std::string& name) const;
  std::unique_ptr<Fitness> fitness(const std::string& name) const;
  std::shared_ptr<const Effect> effect(const std::string& name) const;
  std::shared_ptr<const Reality> reality(const std::string& name) const;

  std::vector<std::string> controllers() const;  ///< names, sorted
  std::vector<std::string> learners() const;
  std::vector<std::string> fitnesses() const;
  std::vector<std::string> effects() const;
  std::vector<std::string> realities() const;

  std::vector<PluginInfo> plugins() const;  ///< in the order in which they were loaded
  std::vector<PluginFailure> failures() const;
  std::vector<std::string> problems() const;  ///< failures(), "PATH: WHY"

  EffectFactory effectFactory() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr
