#include "ui/live/stored_controller.h"

#include <filesystem>

#include "core/plugin/plugin_host.h"
#include "core/spec/error.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"

namespace btr::ui {
namespace {

namespace fs = std::filesystem;

/// The stick with its parameters, as trials of the run had it. The same individual has the same folder again.
std::string stickWith(const std::string& stick, const std::string& parameters, const std::string& name,
                      const std::string& sticks) {
  constexpr std::size_t letters = 12;
  const fs::path folder = fs::path(sticks) / (name + "-" + sha256(stick + "\n" + parameters).substr(0, letters));
  std::error_code problem;
  fs::remove_all(folder, problem);
  if (!problem) fs::create_directories(folder.parent_path(), problem);
  // Links stay links, which the program cannot follow out of its stick.
  if (!problem) fs::copy(stick, folder, fs::copy_options::recursive | fs::copy_options::copy_symlinks, problem);
  if (problem) throw InputError(stick, problem.message(), "the run's memory stick, to be copied to " + folder.string());
  writeFile((folder / "PARAMS.TXT").string(), parameters);
  return folder.string();
}

}  // namespace

GameController storedController(const RunRecord& run, const IndividualRecord& individual, const PluginHost& host,
                                const std::string& sticks) {
  const std::string place = "run " + std::to_string(run.id);
  PluginChoice choice = experimentFromJson(run.specJson, place, "").controller;
  std::shared_ptr<const Controller> plugin = host.controller(choice.name);
  std::map<std::string, std::string> paths;
  for (const std::string& path : plugin->paths()) {
    const auto given = choice.words.extract(path);
    if (!given) throw InputError(place + " controller " + choice.name, "no " + path, "a path");
    paths[path] = given.mapped();
  }
  if (!paths.empty()) plugin = plugin->with(paths);
  const std::vector<Parameter> genotype = plugin->genotype();
  if (genotype.size() != individual.parameters.size())
    throw InputError(place + " individual " + std::to_string(individual.id),
                     std::to_string(individual.parameters.size()) + " parameters",
                     std::to_string(genotype.size()) + ", as the controller " + choice.name + " has");
  const Values settings = settingsOf(choice, plugin->settings(), place + " controller");
  GameController controller;
  if (const auto stick = paths.find("stick"); stick != paths.end()) {
    std::string text;  // what the stick's parameters.json asks for
    for (std::size_t i = 0; i < genotype.size(); ++i)
      text += genotype[i].name + ' ' + toText(individual.parameters[i]) + '\n';
    const std::string name = "run-" + std::to_string(run.id) + "-individual-" + std::to_string(individual.id);
    const bool motorsOn = valueOf(plugin->settings(), settings, "motors") == 0;  // the first of "on" and "off"
    controller.openr = GameStick{stickWith(stick->second, text, name, sticks), "", motorsOn, false};
    return controller;
  }
  if (!paths.empty())
    throw InputError(place, "the controller " + choice.name, "one that needs no file, or an OPEN-R stick");
  controller.plugin = choice.name;
  controller.settings = settings;
  for (std::size_t i = 0; i < genotype.size(); ++i) controller.parameters[genotype[i].name] = individual.parameters[i];
  return controller;
}

}  // namespace btr::ui
