#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/plugin/plugin.h"
#include "core/sim/scene.h"

namespace btr {

/// Loads plugin modules (never unloads them) and makes what they offer.
class PluginHost {
 public:
  /// Loads all modules below `directory`/{controllers,learners,fitness,effects}. A module that cannot be loaded is left out
  /// and named in problems(). Throws InputError if the directory does not exist.
  explicit PluginHost(const std::string& directory);
  ~PluginHost();
  PluginHost(const PluginHost&) = delete;
  PluginHost& operator=(const PluginHost&) = delete;

  /// The folder beside the running program: $UCHILSIM_PLUGINS, else ../lib/plugins from the executable.
  static std::string standardDirectory();

  /// Each throws InputError naming the plugins that exist when `name` does not.
  std::unique_ptr<Controller> controller(const std::string& name) const;
  std::unique_ptr<Learner> learner(const std::string& name) const;
  std::unique_ptr<Fitness> fitness(const std::string& name) const;
  std::shared_ptr<const Effect> effect(const std::string& name) const;

  std::vector<std::string> controllers() const;  ///< names, sorted
  std::vector<std::string> learners() const;
  std::vector<std::string> fitnesses() const;
  std::vector<std::string> effects() const;
  const std::vector<std::string>& problems() const;

  EffectFactory effectFactory() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr
