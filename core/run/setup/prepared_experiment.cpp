#include "core/run/setup/prepared_experiment.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <locale>
#include <sstream>

#include "core/model/load_model.h"
#include "core/plugin/ball_fitness.h"
#include "core/run/setup/reality_settings.h"
#include "core/sim/engine/ode_session.h"
#include "core/sim/model_losses.h"
#include "core/sim/scene_parameters.h"
#include "core/sim/world/scene_build.h"
#include "core/spec/error.h"
#include "core/spec/file_ending.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"
#include "core/store/database.h"

namespace btr {
namespace {

/// A plugin's settings as numbers, checked; `choice` keeps no words.
void settle(PluginChoice& choice, const std::vector<Parameter>& declared) {
  const std::string place = "settings of " + choice.name;
  choice.settings = settingsOf(choice, declared, place);
  choice.words.clear();
  resolve(declared, choice.settings, place);
}

/// The controller for the paths that it wants, which become absolute: what is stored does not know the experiment's
/// folder.
std::shared_ptr<const Controller> controllerWithPaths(std::shared_ptr<const Controller> controller,
                                                      ExperimentSpec& spec) {
  const std::vector<std::string> names = controller->paths();
  if (names.empty()) return controller;
  std::map<std::string, std::string> paths;
  for (const std::string& name : names) {
    const auto word = spec.controller.words.find(name);
    if (word == spec.controller.words.end())
      throw InputError("settings of " + spec.controller.name + "/" + name, "nothing",
                       "a path relative to the experiment's file");
    const auto path = std::filesystem::absolute(std::filesystem::path(spec.directory) / word->second);
    word->second = path.lexically_normal().string();
    paths[name] = word->second;
  }
  return controller->with(paths);
}

/// A choice as it is stored: choices as words, and the controller's paths.
PluginChoice controllerInWords(const PluginChoice& numbers, const PluginChoice& given, const Controller& controller) {
  PluginChoice choice = choiceOf(numbers.name, numbers.settings, controller.settings());
  for (const std::string& name : controller.paths()) choice.words[name] = given.words.at(name);
  return choice;
}

/// A mesh of a robot is stored beside it, under the robot's name and the name that the robot gives it.
std::string nameOfMesh(const std::string& robot, const std::string& mesh) { return robot + ": " + mesh; }

StoredFile fileOf(const std::string& name, std::string content) {
  StoredFile file;
  file.name = name;
  file.sha256 = sha256(content);
  file.content = std::move(content);
  return file;
}

/// The mesh files of a robot that lies at `path`, as far as they are there.
std::vector<StoredFile> meshesOf(const StoredFile& robot, const std::string& path) {
  std::vector<StoredFile> meshes;
  if (fileEnding(robot.name) != ".urdf") return meshes;
  parseUrdf(robot.content, path, {}, [&, find = meshesBeside(path)](const std::string& mesh) {
    MeshFile found = find(mesh);
    const std::string name = nameOfMesh(robot.name, mesh);
    if (std::ranges::find(meshes, name, &StoredFile::name) == meshes.end()) meshes.push_back(fileOf(name, found.bytes));
    return found;
  });
  return meshes;
}

RobotModel parseModel(const StoredFile& file, const MeshSource& meshes) {
  const std::string ending = fileEnding(file.name);
  if (ending == ".wrl") return parseVrml(file.content, file.name);
  if (ending == ".urdf") return parseUrdf(file.content, file.name, {}, meshes);
  throw InputError("robot model", file.name, "a file that ends in .wrl or .urdf");
}

/// The robots of a scene from what is stored.
ModelSet parseModels(const SceneSpec& scene, const std::vector<StoredFile>& files) {
  const auto stored = [&](const std::string& name) -> const StoredFile& {
    const auto file = std::ranges::find(files, name, &StoredFile::name);
    if (file == files.end()) throw InputError("\"" + name + "\" is not stored with the run");
    return *file;
  };
  ModelSet models;
  for (const auto& robot : scene.robots) {
    if (models.contains(robot.model)) continue;
    RobotModel model = parseModel(stored(robot.model), [&](const std::string& mesh) -> MeshFile {
      return {mesh, stored(nameOfMesh(robot.model, mesh)).content};
    });
    makeHulls(model, robot.model, scene);
    models[robot.model] = std::make_shared<const RobotModel>(std::move(model));
  }
  return models;
}

/// Which simulator parameters mean something in the scene, and which of them L3 may change. Another robot has no head
/// or legs of an AIBO: what says nothing but the usual of them is passed over, the rest is an error.
void settleParameters(PreparedExperiment& prepared) {
  prepared.parameters = simulatorParametersOf(prepared.sceneSpec, prepared.models);
  const std::vector<std::string>& wanted = prepared.spec.adapted;
  for (const Parameter& p : simulatorParameters()) {
    const bool isHere = find(prepared.parameters, p.name) != nullptr;
    const bool named = std::ranges::find(wanted, p.name) != wanted.end();
    if (named && !isHere) throw InputError("experiment /adaptation/parameters", p.name, whoHas(p.name));
    if (isHere && (wanted.empty() || named)) prepared.adapted.push_back(p);
    Values& values = prepared.spec.simulator.values;
    const auto value = values.find(p.name);
    if (value == values.end()) continue;
    check(p, value->second, "simulator " + p.name);
    if (isHere) continue;
    if (value->second != p.byDefault) throw InputError("experiment /simulator/values", p.name, whoHas(p.name));
    values.erase(value);
  }
}

/// Everything but reading files: plugins, settings, models and a first scene.
PreparedExperiment prepare(const ExperimentSpec& spec, SceneSpec sceneSpec, std::vector<StoredFile> files,
                           const PluginHost& host, bool fromFiles) {
  requireOde();
  PreparedExperiment prepared;
  prepared.spec = spec;
  prepared.spec.plugins = pluginFolders(spec);  // what is stored does not know the experiment's folder
  host.load(prepared.spec.plugins, "experiment /plugins");
  prepared.sceneSpec = std::move(sceneSpec);
  prepared.files = std::move(files);
  prepared.controller = controllerWithPaths(host.controller(spec.controller.name), prepared.spec);
  prepared.fitness = host.fitness(spec.fitness.name);
  prepared.effects = host.effectFactory();
  prepared.genotype = prepared.controller->genotype();
  if (spec.start) prepared.start = resolve(prepared.genotype, spec.start->parameters, "start/parameters");

  prepared.models = parseModels(prepared.sceneSpec, prepared.files);
  if (prepared.sceneSpec.robots.empty()) throw InputError(spec.scene, "no robot", "a scene with at least one robot");
  settleParameters(prepared);

  // Each plugin with what may be set on it: a learner's settings may depend on what it searches.
  const auto learner = host.learner(spec.learner.name);
  const auto adaptation = host.learner(spec.adaptation.name);
  prepared.specInWords = prepared.spec;
  const auto settleBoth = [&](PluginChoice ExperimentSpec::*choice, const std::vector<Parameter>& declared) {
    settle(prepared.spec.*choice, declared);
    prepared.specInWords.*choice = choiceOf((prepared.spec.*choice).name, (prepared.spec.*choice).settings, declared);
  };
  settleReality(prepared, host, fromFiles);
  const PluginChoice controller = prepared.spec.controller;
  for (const std::string& path : prepared.controller->paths()) prepared.spec.controller.words.erase(path);
  settle(prepared.spec.controller, prepared.controller->settings());
  prepared.specInWords.controller = controllerInWords(prepared.spec.controller, controller, *prepared.controller);
  settleBoth(&ExperimentSpec::fitness, prepared.fitness->settings());
  settleBoth(&ExperimentSpec::learner, learner->settingsFor(prepared.genotype));
  settleBoth(&ExperimentSpec::adaptation, adaptation->settingsFor(simulatorParameters()));
  // What is set for a parameter that is not adapted plays no part.
  std::erase_if(prepared.spec.adaptation.settings,
                [used = adaptation->settingsFor(prepared.adapted)](const auto& s) { return !find(used, s.first); });

  const bool inReality = !spec.realityLearner.name.empty();
  const auto realityLearner = host.learner(inReality ? spec.realityLearner.name : spec.learner.name);
  if (inReality) settleBoth(&ExperimentSpec::realityLearner, realityLearner->settingsFor(prepared.genotype));

  // The learners' own checks: what they cannot search is refused now, not after hours.
  Random unused(0);
  learner->start(prepared.genotype, prepared.spec.learner.settings, unused);
  adaptation->start(prepared.adapted, prepared.spec.adaptation.settings, unused);
  if (inReality) realityLearner->start(prepared.genotype, prepared.spec.realityLearner.settings, unused);

  prepared.scene(prepared.spec.simulator);
  return prepared;
}

/// Everything where it was and as fast, whatever a controller's task arranged.
void putBack(Scene& scene, const Scene& was) {
  for (std::size_t i = 0; i < was.robots.size(); ++i) {
    SceneRobot& robot = scene.robots.at(i);
    robot.start = was.robots[i].start;
    robot.startVelocity_m_s = was.robots[i].startVelocity_m_s;
    robot.startSpin_rad_s = was.robots[i].startSpin_rad_s;
    robot.jointStart = was.robots[i].jointStart;
    robot.jointStartRate = was.robots[i].jointStartRate;
  }
  scene.balls = was.balls;
  scene.obstacles = was.obstacles;
}

/// Trials have no pictures.
void requireNoCamera(const PreparedExperiment& prepared) {
  if (prepared.controller->looks())
    throw InputError("controller/name", "\"" + prepared.spec.controller.name + "\", which looks through a camera",
                     "a controller that does not look: trials have no pictures, games and the open interface have");
}

/// A motion that is longer than a trial makes every trial fail.
void requireTimeForTheMotion(const PreparedExperiment& prepared, const Scene& scene) {
  std::vector<double> vector = prepared.start;
  if (vector.empty())
    for (const Parameter& p : prepared.genotype) vector.push_back(p.byDefault);
  const Values& settings = prepared.spec.controller.settings;
  const double motion_s = prepared.controller->begin(scene, settings, vector)->duration();
  const double trial_s = valueOf(stageParameters(), prepared.spec.stages, "trial_maximum_s");
  if (motion_s > trial_s + scene.controlPeriod_s / 2)
    throw InputError("stages/trial_maximum_s", toText(trial_s) + " s",
                     "at least " + toText(motion_s) + " s, the duration of the motion (controller " +
                         prepared.spec.controller.name + ")");
}

}  // namespace

Scene PreparedExperiment::scene(const SimulatorSpec& simulator) const {
  Scene scene = makeScene(sceneSpec, models, simulator, effects);
  if (valueOf(stageParameters(), spec.stages, "begins") == 0) {
    controller->arrange(scene, spec.controller.settings);
    return scene;
  }
  const Scene asItIs = scene;
  controller->arrange(scene, spec.controller.settings);
  putBack(scene, asItIs);
  return scene;
}

SimulatorSpec PreparedExperiment::adaptedTo(SimulatorSpec simulator, std::span<const double> values) const {
  for (std::size_t i = 0; i < adapted.size(); ++i) simulator.values[adapted[i].name] = values[i];
  return simulator;
}

TrialResult PreparedExperiment::trial(const Scene& arranged, std::span<const double> parameters, std::uint64_t seed,
                                      bool recordTrace) const {
  TrialOptions options;
  options.recordTrace = recordTrace;
  return trial(arranged, parameters, seed, options);
}

TrialResult PreparedExperiment::trialForFitness(const Scene& arranged, std::span<const double> parameters,
                                                std::uint64_t seed) const {
  TrialOptions options;
  const auto* ofBalls = dynamic_cast<const BallFitness*>(fitness.get());
  options.ballsOnly = ofBalls && ofBalls->seesBallsOnly(spec.fitness.settings);
  options.recordTrace = !options.ballsOnly;  // any other fitness may look at everything, traces too
  return trial(arranged, parameters, seed, options);
}

TrialResult PreparedExperiment::trial(const Scene& arranged, std::span<const double> parameters, std::uint64_t seed,
                                      TrialOptions options) const {
  options.maximum_s = valueOf(stageParameters(), spec.stages, "trial_maximum_s");
  return runTrial(arranged, *controller, spec.controller.settings, parameters, seed, options);
}

std::optional<double> PreparedExperiment::numberOf(const TrialResult& result) const {
  if (result.outcome != TrialResult::Outcome::finished) return fitness->ofFailure();
  const double value = fitness->evaluate(result, spec.fitness.settings, task());
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

double PreparedExperiment::fitnessOf(const TrialResult& result) const {
  return numberOf(result).value_or(fitness->ofFailure());
}

std::string PreparedExperiment::detailOf(const TrialResult& result) const {
  if (result.outcome != TrialResult::Outcome::finished) return result.detail;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(4);
  for (const auto& [name, value] : figuresOf(result)) text << (text.tellp() > 0 ? ", " : "") << name << ' ' << value;
  return text.str();
}

Values PreparedExperiment::figuresOf(const TrialResult& result) const {
  if (result.outcome != TrialResult::Outcome::finished) return {};
  Values figures = fitness->figures(result, spec.fitness.settings, task());
  std::erase_if(figures, [](const auto& figure) { return !std::isfinite(figure.second); });
  return figures;
}

PreparedExperiment PreparedExperiment::withTask(const Values& settings) const {
  PreparedExperiment other = *this;
  for (const auto& [name, value] : settings) other.spec.controller.settings[name] = value;
  resolve(controller->settings(), other.spec.controller.settings, "settings of " + spec.controller.name);
  other.specInWords.controller = controllerInWords(other.spec.controller, specInWords.controller, *controller);
  return other;
}

Values PreparedExperiment::task() const {
  Values task;
  for (const Parameter& p : controller->settings())
    task[p.name] = valueOf(controller->settings(), spec.controller.settings, p.name);
  return task;
}

PreparedExperiment prepareFromFiles(const ExperimentSpec& spec, const PluginHost& host) {
  namespace fs = std::filesystem;
  const fs::path scenePath = fs::path(spec.directory) / spec.scene;
  SceneSpec scene = loadScene(scenePath.string());
  std::vector<StoredFile> files;
  for (const RobotSpec& robot : scene.robots) {
    bool known = false;
    for (const StoredFile& file : files) known = known || file.name == robot.model;
    if (known) continue;
    const std::string path = (fs::path(scene.directory) / robot.model).string();
    StoredFile file = fileOf(robot.model, readFile(path));
    std::vector<StoredFile> meshes = meshesOf(file, path);
    files.push_back(std::move(file));
    std::ranges::move(meshes, std::back_inserter(files));
  }
  PreparedExperiment prepared = prepare(spec, std::move(scene), std::move(files), host, true);
  const Scene arranged = prepared.scene(prepared.spec.simulator);
  requireNoCamera(prepared);
  requireTimeForTheMotion(prepared, arranged);
  prepared.fitness->check(arranged);
  return prepared;
}

PreparedExperiment prepareFromRun(const RunRecord& run, const PluginHost& host) {
  const std::string place = "run " + std::to_string(run.id);
  return prepare(experimentFromJson(run.specJson, place, ""), sceneFromJson(run.sceneJson, place, ""), run.files, host,
                 false);
}

std::vector<std::string> runLosses(const RunRecord& run, const PluginHost& host) {
  const PreparedExperiment prepared = prepareFromRun(run, host);
  return modelLosses(prepared.sceneSpec, prepared.models);
}

std::vector<Parameter> parametersOfScene(const std::string& path) {
  const SceneSpec scene = loadScene(path);
  return simulatorParametersOf(scene, loadModels(scene));
}

std::vector<Parameter> parametersOfRun(const RunRecord& run) {
  const SceneSpec scene = sceneFromJson(run.sceneJson, "run " + std::to_string(run.id), "");
  return simulatorParametersOf(scene, parseModels(scene, run.files));
}

SimulatorRecord firstSimulator(const PreparedExperiment& prepared) {
  SimulatorRecord first;
  first.simulator = prepared.spec.simulator;
  for (const Parameter& p : prepared.parameters) first.simulator.values.try_emplace(p.name, p.byDefault);
  first.madeBy = "start";
  first.createdAt = utcNow();
  return first;
}

RunRecord makeRunRecord(const PreparedExperiment& prepared, Id experiment, std::uint64_t seed) {
  RunRecord record;
  record.experiment = experiment;
  record.seed = seed;
  record.specJson = toJsonText(prepared.specInWords);
  record.sceneJson = toJsonText(prepared.sceneSpec);
  record.files = prepared.files;
  std::string all = record.specJson + record.sceneJson;
  for (const StoredFile& file : prepared.files) all += file.name + file.sha256;
  record.specSha256 = sha256(all);
  record.reality = prepared.spec.reality;
  for (const Parameter& p : prepared.genotype)
    record.genes.push_back({p.minimum, p.maximum, p.integer || !p.choices.empty()});
  return record;
}

}  // namespace btr
