#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/spec/parameter.h"
#include "core/spec/recordings_spec.h"
#include "core/spec/simulator_spec.h"

namespace btr {

/// A plugin by name and its settings; what is absent has the plugin's default. A file says choices by their word; only
/// the plugin knows which they are, so settings read from a file stay apart until settingsOf() joins them.
struct PluginChoice {
  std::string name;
  Values settings;
  std::map<std::string, std::string> words = {};
  bool operator==(const PluginChoice&) const = default;
};

/// A known vector that L1's search begins around, and how a population is made of it.
struct SearchStart {
  Values parameters;   ///< by name of the controller's genotype; what is absent has its default
  double share = 1;    ///< of the population that are permutations of it, the first one unaltered; the rest is drawn
  double flip = 0.05;  ///< probability that a bit of a permutation flips
  bool operator==(const SearchStart&) const = default;
};

/// Settings of a reality plugin; words are choices and texts, such as paths relative to the experiment's file.
struct RealityOptions {
  Values settings;
  std::map<std::string, std::string> words;
  bool empty() const { return settings.empty() && words.empty(); }
  bool operator==(const RealityOptions&) const = default;
};

/// What the user asked for: everything that a Back-to-Reality run depends on ("format": "uchilsim-experiment-1").
/// The same spec and seed give the same bits.
struct ExperimentSpec {
  std::string name;
  std::vector<std::string> plugins;  ///< folders of further plugins, relative to the experiment's file
  std::string scene;                 ///< path of the scene file, relative to the experiment's file
  PluginChoice controller;           ///< e.g. "kick": settings = the task (d, β, α)
  PluginChoice fitness;              ///< e.g. "kick_distance"
  PluginChoice learner;              ///< L1, e.g. "ga"
  std::optional<SearchStart> start;  ///< absent: L1 begins anywhere, as its learner does
  Values stages;                     ///< cadences, counts and stops: stageParameters()
  PluginChoice adaptation;           ///< L3's learner, e.g. "ga"
  Values adaptationSettings;         ///< how L3 compares: adaptationParameters()
  std::vector<std::string> adapted;  ///< names of simulatorParameters() that L3 may change; empty means all
  PluginChoice realityLearner;       ///< L2's learner, e.g. "pgrl"; without a name the run has no L2
  Values realitySettings;            ///< when and how long L2 learns: realityLearningParameters()
  SimulatorSpec simulator;  ///< the simulator the run starts with; what is absent has the scene's and robot's numbers
  std::string reality = "person";  ///< plugin that answers the measurements: "person", "stand_in", "program", …
  RealityOptions realityOptions;   ///< what that plugin lets the user set
  Values standIn;                  ///< standInParameters(), used when reality is "stand_in"
  ConcealedSpec concealed;         ///< what its hidden effects are drawn from
  RecordingsSpec recordings;       ///< whether measured individuals are recorded and the recordings analysed
  std::uint64_t seed = 1;
  std::string directory;  ///< of the experiment's file; not part of the JSON
  bool operator==(const ExperimentSpec&) const = default;
};

class JsonReader;
/// {"name": …, "settings": {…}} as it stands in a file. Throws InputError.
PluginChoice pluginChoice(JsonReader reader);
/// Numbers and words as checked values of the declared parameters (what is absent stays absent). Throws InputError.
Values settingsOf(const PluginChoice& choice, std::span<const Parameter> declared, const std::string& place);
/// The way back: a plugin with its settings, choices as words. Throws InputError if a choice is not one.
PluginChoice choiceOf(const std::string& name, const Values& settings, std::span<const Parameter> declared);

/// first_generations, next_generations, total_generations, measured_individuals, repeats, …
const std::vector<Parameter>& stageParameters();
/// share and flip: how a first population is made of a known vector.
const std::vector<Parameter>& searchStartParameters();
/// generations, norm (mean_absolute | root_mean_square | maximum), held_out, …
const std::vector<Parameter>& adaptationParameters();
/// iterations, repeats, first_stage, every_stages, gives_back, …
const std::vector<Parameter>& realityLearningParameters();
/// seed, noise_m, parameter_error, hidden_effects, …
const std::vector<Parameter>& standInParameters();

/// The folders of `plugins` as full paths.
std::vector<std::string> pluginFolders(const ExperimentSpec& experiment);

/// Structure, names and bounds of everything that needs no plugin are checked here; the plugins' settings are checked
/// by run::validate, which knows the plugins. Throws InputError.
ExperimentSpec experimentFromJson(const std::string& text, const std::string& place, const std::string& directory);
ExperimentSpec loadExperiment(const std::string& path);
std::string toJsonText(const ExperimentSpec& experiment);

}  // namespace btr
