#include "ui/live/stored_controller.h"

#include "core/plugin/plugin_host.h"
#include "core/spec/error.h"
#include "core/spec/experiment_spec.h"

namespace btr::ui {

GameController storedController(const RunRecord& run, const IndividualRecord& individual, const PluginHost& host) {
  const std::string place = "run " + std::to_string(run.id);
  const PluginChoice choice = experimentFromJson(run.specJson, place, "").controller;
  const auto plugin = host.controller(choice.name);
  if (!plugin->paths().empty())
    throw InputError(place, "the controller " + choice.name,
                     "one that needs no file; give the robot its stick instead");
  const std::vector<Parameter> genotype = plugin->genotype();
  if (genotype.size() != individual.parameters.size())
    throw InputError(place + " individual " + std::to_string(individual.id),
                     std::to_string(individual.parameters.size()) + " parameters",
                     std::to_string(genotype.size()) + ", as the controller " + choice.name + " has");
  GameController controller;
  controller.plugin = choice.name;
  controller.settings = settingsOf(choice, plugin->settings(), place + " controller");
  for (std::size_t i = 0; i < genotype.size(); ++i) controller.parameters[genotype[i].name] = individual.parameters[i];
  return controller;
}

}  // namespace btr::ui
