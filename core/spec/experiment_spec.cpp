#include "core/spec/experiment_spec.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/spec_head.h"

namespace btr {
namespace {

using nlohmann::json;

json toJson(const PluginChoice& choice) {
  json settings = btr::toJson(choice.settings, {});
  for (const auto& [name, word] : choice.words) settings[name] = word;
  return {{"name", choice.name}, {"settings", settings}};
}

/// "reality": a name, or {"name": …, "settings": {…}}.
void readReality(JsonReader& reader, ExperimentSpec& spec) {
  const json* given = reader.any("reality");
  if (!given) return;
  if (given->is_string()) {
    spec.reality = given->get<std::string>();
  } else {
    PluginChoice choice = pluginChoice(reader.object("reality"));
    spec.reality = choice.name;
    spec.realityOptions = {std::move(choice.settings), std::move(choice.words)};
  }
  if (spec.reality.empty()) reader.refuse("reality", "the name of a reality plugin, as person or stand_in");
}

json realityOf(const ExperimentSpec& spec) {
  if (spec.realityOptions.empty()) return spec.reality;
  return toJson(PluginChoice{spec.reality, spec.realityOptions.settings, spec.realityOptions.words});
}

constexpr double largestSeed = 9007199254740991;  // 2^53 − 1: every whole number up to it is a double

}  // namespace

PluginChoice pluginChoice(JsonReader reader) {
  PluginChoice choice;
  choice.name = reader.text("name");
  if (choice.name.empty()) reader.refuse("name", "the name of a plugin");
  // Only the plugin knows which settings are words: both are kept, settingsOf() joins them.
  if (auto settings = reader.objectIfAny("settings"))
    for (const auto& [name, value] : settings->node().items()) {
      if (value.is_string())
        choice.words[name] = value.get<std::string>();
      else if (value.is_number())
        choice.settings[name] = value.get<double>();
      else
        settings->refuse(name, "a number or a word");
    }
  reader.finish();
  return choice;
}

Values settingsOf(const PluginChoice& choice, std::span<const Parameter> declared, const std::string& place) {
  Values values = choice.settings;
  for (const auto& [name, word] : choice.words) {
    const Parameter* parameter = find(declared, name);
    if (!parameter) {
      resolve(declared, {{name, 0.0}}, place);  // says which names are known
    } else if (parameter->choices.empty()) {
      throw InputError(place + "/" + name, "\"" + word + "\"", "a number");
    } else {
      const auto found = std::find(parameter->choices.begin(), parameter->choices.end(), word);
      if (found == parameter->choices.end()) {
        std::string words;
        for (const std::string& other : parameter->choices) words += (words.empty() ? "" : ", ") + other;
        throw InputError(place + "/" + name, "\"" + word + "\"", "one of " + words);
      }
      values[name] = static_cast<double>(found - parameter->choices.begin());
    }
  }
  resolve(declared, values, place);
  return values;
}

PluginChoice choiceOf(const std::string& name, const Values& settings, std::span<const Parameter> declared) {
  PluginChoice choice{name, settings, {}};
  for (const Parameter& parameter : declared) {
    const auto given = settings.find(parameter.name);
    if (parameter.choices.empty() || given == settings.end()) continue;
    check(parameter, given->second, name + "/" + parameter.name);
    choice.words[parameter.name] = parameter.choices[static_cast<std::size_t>(given->second)];
    choice.settings.erase(parameter.name);
  }
  return choice;
}

const std::vector<Parameter>& stageParameters() {
  static const std::vector<Parameter> parameters{
      {"first_generations", "", "generations before the first measurement", 1, 1e6, 50, {}, true},
      {"next_generations", "", "generations between further measurements", 1, 1e6, 100, {}, true},
      {"total_generations", "", "generations of the whole run", 1, 1e6, 500, {}, true},
      {"measured_individuals", "", "individuals measured at each stage", 1, 1000, 10, {}, true},
      {"disagreeing_individuals",
       "",
       "of these, chosen since candidate simulators disagree about them most; the rest are the best",
       0,
       1000,
       0,
       {},
       true},
      {"candidate_simulators",
       "",
       "simulators compared for that: the newest and others that explain what was measured about as well",
       2,
       100,
       6,
       {},
       true},
      {"candidate_error_ratio", "", "largest error of a candidate simulator, times that of the newest", 1, 100, 1.5},
      {"candidate_spread", "",
       "before any adaptation: candidates are drawn within this share of each parameter's range around the given one",
       0.001, 1, 0.1},
      {"repeats", "", "wanted measurements of each individual", 1, 100, 1, {}, true},
      {"hide_simulated", "", "hide the simulated fitness until all is measured", 0, 1, 1, {}, false, {"no", "yes"}},
      {"chosen_from",
       "",
       "where the measured individuals are chosen from",
       0,
       1,
       0,
       {},
       false,
       {"last_generation", "since_update"}},
      {"begins",
       "",
       "a trial begins in the controller's posture with its task's ball in place, or exactly as the scene says",
       0,
       1,
       0,
       {},
       false,
       {"posture", "scene"}},
      {"trial_maximum_s", "s", "longest simulated time of one trial", 0.1, 600, 20},
  };
  return parameters;
}

const std::vector<Parameter>& searchStartParameters() {
  static const std::vector<Parameter> parameters{
      {"share", "", "of the first population that are permutations of the vector, the first one unaltered", 0, 1, 1},
      {"flip", "", "probability that a bit of a permutation flips", 0, 1, 0.05},
  };
  return parameters;
}

const std::vector<Parameter>& adaptationParameters() {
  static const std::vector<Parameter> parameters{
      {"generations", "", "generations of one adaptation of the simulator", 1, 1e5, 10, {}, true},
      {"norm",
       "",
       "how real minus simulated fitness becomes one error",
       0,
       2,
       0,
       {},
       false,
       {"mean_absolute", "root_mean_square", "maximum"}},
      {"held_out", "", "measured individuals of each stage that the adaptation never sees", 0, 999, 0, {}, true},
      {"sees_policies", "", "it also sees the policies that L2 measured", 0, 1, 0, {}, false, {"no", "yes"}},
  };
  return parameters;
}

const std::vector<Parameter>& realityLearningParameters() {
  static const std::vector<Parameter> parameters{
      {"iterations", "", "iterations of one stage of learning in reality", 1, 1000, 5, {}, true},
      {"repeats", "", "wanted measurements of each policy", 1, 100, 3, {}, true},
      {"evaluated_in", "", "where policies are tried", 0, 1, 0, {}, false, {"reality", "simulator"}},
      {"begins_at", "", "the individual it begins at", 0, 1, 0, {}, false, {"best_measured", "best_simulated"}},
      {"first_stage", "", "measurement stage that it first belongs to", 1, 1e6, 1, {}, true},
      {"every_stages", "", "and then every so many stages", 1, 1e6, 1, {}, true},
      {"most_stages", "", "at most in so many stages; 0: in all", 0, 1e6, 0, {}, true},
      {"after_last", "", "also after the last measurement", 0, 1, 0, {}, false, {"no", "yes"}},
      {"patience", "", "ends early after so many iterations without a better policy; 0: never", 0, 1000, 0, {}, true},
      {"gives_back", "", "what goes back into the simulator", 0, 1, 0, {}, false, {"best_measured", "centre"}},
      {"copies", "", "share of the next population that are permutations of it; 0: nothing goes back", 0, 1, 1},
      {"flip", "", "probability that a bit of such a copy flips", 0, 0.5, 0.05},
  };
  return parameters;
}

const std::vector<Parameter>& standInParameters() {
  static const std::vector<Parameter> parameters{
      {"seed", "", "draws the concealed reality and its noise", 0, largestSeed, 1, {}, true},
      {"noise_m", "", "standard deviation of one measurement, in the unit of the fitness", 0, 10, 0.02},
      {"parameter_error", "", "relative size of the concealed deviations of the simulator's parameters", 0, 0.9, 0.2},
      {"hidden_effects", "", "concealed effects that the simulator lacks", 0, 10, 1, {}, true},
      {"effect_size", "", "how large they are: times the sizes that a robot in good order has", 0.01, 100, 1},
      {"step_s", "s", "integration step of the stand-in's world, 0 for the scene's", 0, 0.02, 0},
      {"drawn_by",
       "",
       "whether all runs meet the same concealed robot or each seed of a run another one",
       0,
       1,
       0,
       {},
       false,
       {"own_seed", "run_seed"}},
      {"played_by",
       "",
       "who plays the robot: this program's simulator, or the program that UCHILSIM_STAND_IN names",
       0,
       1,
       0,
       {},
       false,
       {"simulator", "program"}},
  };
  return parameters;
}

ExperimentSpec experimentFromJson(const std::string& text, const std::string& place, const std::string& directory) {
  JsonReader reader = JsonReader::parse(text, place);
  ExperimentSpec spec;
  spec.directory = directory;
  spec.name = nameOfSpec(reader, "uchilsim-experiment-1");
  spec.plugins = reader.texts("plugins");
  spec.scene = filledText(reader, "scene", "the path of a scene file");
  spec.controller = pluginChoice(reader.object("controller"));
  spec.fitness = pluginChoice(reader.object("fitness"));
  spec.learner = pluginChoice(reader.object("learner"));
  if (auto start = reader.objectIfAny("start")) {
    spec.start.emplace();
    spec.start->parameters = start->anyValues("parameters");
    spec.start->share = start->number("share", 0, 1, spec.start->share);
    spec.start->flip = start->number("flip", 0, 1, spec.start->flip);
    start->finish();
  }
  spec.stages = reader.values("stages", stageParameters());
  JsonReader adaptation = reader.object("adaptation");
  spec.adaptation = pluginChoice(adaptation.object("learner"));
  spec.adaptationSettings = adaptation.values("settings", adaptationParameters());
  spec.adapted = adaptation.texts("parameters");
  for (auto name = spec.adapted.begin(); name != spec.adapted.end(); ++name)
    if (!find(simulatorParameters(), *name) || std::find(spec.adapted.begin(), name, *name) != name)
      adaptation.refuse("parameters", "names of the simulator's parameters, each once; \"" + *name + "\" is not");
  adaptation.finish();
  if (auto learning = reader.objectIfAny("reality_learning")) {
    spec.realityLearner = pluginChoice(learning->object("learner"));
    spec.realitySettings = learning->values("settings", realityLearningParameters());
    learning->finish();
  }
  if (auto simulator = reader.objectIfAny("simulator")) {
    spec.simulator = simulatorFromReader(*simulator);
    simulator->finish();
  }
  readReality(reader, spec);
  spec.standIn = reader.values("stand_in", standInParameters());
  spec.concealed = concealedFrom(reader, "concealed");
  spec.recordings = recordingsFrom(reader, "recordings");
  spec.seed = reader.seed("seed", spec.seed);
  reader.finish();

  const double heldOut = valueOf(adaptationParameters(), spec.adaptationSettings, "held_out");
  const double measured = valueOf(stageParameters(), spec.stages, "measured_individuals");
  if (heldOut >= measured)
    throw InputError(place + " /adaptation/settings/held_out", toText(heldOut),
                     "less than measured_individuals = " + toText(measured));
  const double disagreeing = valueOf(stageParameters(), spec.stages, "disagreeing_individuals");
  if (disagreeing > measured)
    throw InputError(place + " /stages/disagreeing_individuals", toText(disagreeing),
                     "at most measured_individuals = " + toText(measured));
  return spec;
}

std::vector<std::string> pluginFolders(const ExperimentSpec& experiment) {
  namespace fs = std::filesystem;
  std::vector<std::string> folders;
  for (const std::string& folder : experiment.plugins)
    folders.push_back(fs::absolute(fs::path(experiment.directory) / folder).lexically_normal().string());
  return folders;
}

ExperimentSpec loadExperiment(const std::string& path) {
  return experimentFromJson(readFile(path), path, std::filesystem::path(path).parent_path().string());
}

std::string toJsonText(const ExperimentSpec& experiment) {
  json document{{"format", "uchilsim-experiment-1"},
                {"name", experiment.name},
                {"scene", experiment.scene},
                {"controller", toJson(experiment.controller)},
                {"fitness", toJson(experiment.fitness)},
                {"learner", toJson(experiment.learner)},
                {"stages", btr::toJson(experiment.stages, stageParameters())},
                {"adaptation",
                 {{"learner", toJson(experiment.adaptation)},
                  {"settings", btr::toJson(experiment.adaptationSettings, adaptationParameters())},
                  {"parameters", experiment.adapted}}},
                {"simulator", simulatorToJson(experiment.simulator)},
                {"reality", realityOf(experiment)},
                {"stand_in", btr::toJson(experiment.standIn, standInParameters())},
                {"seed", experiment.seed}};
  if (experiment.start)
    document["start"] = {{"parameters", btr::toJson(experiment.start->parameters, {})},
                         {"share", experiment.start->share},
                         {"flip", experiment.start->flip}};
  // What is not used is not written: experiments without it keep the text that their runs are known by.
  if (!experiment.realityLearner.name.empty())
    document["reality_learning"] = {{"learner", toJson(experiment.realityLearner)},
                                    {"settings", btr::toJson(experiment.realitySettings, realityLearningParameters())}};
  if (!experiment.plugins.empty()) document["plugins"] = experiment.plugins;
  if (experiment.concealed != ConcealedSpec{}) document["concealed"] = btr::toJson(experiment.concealed);
  if (experiment.recordings != RecordingsSpec{}) document["recordings"] = btr::toJson(experiment.recordings);
  return document.dump(2) + "\n";
}

}  // namespace btr
