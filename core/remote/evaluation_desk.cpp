#include "core/remote/evaluation_desk.h"

#include <algorithm>
#include <filesystem>

#include "core/model/load_model.h"
#include "core/remote/act_messages.h"
#include "core/remote/experiments.h"
#include "core/run/loop/search.h"
#include "core/spec/error.h"
#include "core/spec/file_ending.h"
#include "core/spec/json_reader.h"
#include "core/spec/scene_spec.h"
#include "core/spec/sha256.h"
#include "core/store/database.h"
#include "uchilsim.pb.h"

namespace btr::remote {
namespace {

namespace v1 = uchilsim::v1;

/// The parameters as vectors of the genotype, each number within its bounds.
std::vector<std::vector<double>> vectorsOf(const v1::EvaluateRequest& request, const std::vector<Parameter>& genotype) {
  const int count = request.vectors();
  if (count < 1 || count > EvaluationDesk::mostVectors)
    throw InputError("vectors", std::to_string(count), "1 to " + std::to_string(EvaluationDesk::mostVectors));
  const auto n = static_cast<int>(genotype.size());
  if (request.parameters_size() != count * n)
    throw InputError("parameters", std::to_string(request.parameters_size()) + " numbers",
                     std::to_string(count) + " vectors of " + std::to_string(n) + " numbers");
  std::vector<std::vector<double>> vectors(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    for (int k = 0; k < n; ++k) {
      const double value = request.parameters(i * n + k);
      const Parameter& parameter = genotype[static_cast<std::size_t>(k)];
      check(parameter, value, "vector " + std::to_string(i) + " " + parameter.name);
      vectors[static_cast<std::size_t>(i)].push_back(value);
    }
  return vectors;
}

/// What a file is now, whatever its time stamp; "" if it cannot be read.
std::string stateOf(const std::string& path) {
  try {
    return sha256(readFile(path));
  } catch (const InputError&) {
    return "";
  }
}

/// The files that trials of an experiment come from: its scene, the robots and their meshes, and what its controller
/// is told to read.
std::map<std::string, std::string> filesOf(const ExperimentSpec& spec, const PluginHost& host) {
  namespace fs = std::filesystem;
  std::map<std::string, std::string> files;
  const auto add = [&](const fs::path& path) { files.try_emplace(path.string(), stateOf(path.string())); };
  const fs::path scenePath = fs::path(spec.directory) / spec.scene;
  add(scenePath);
  const SceneSpec scene = loadScene(scenePath.string());
  for (const RobotSpec& robot : scene.robots) {
    const std::string path = (fs::path(scene.directory) / robot.model).string();
    add(path);
    if (fileEnding(path) != ".urdf") continue;
    parseUrdf(readFile(path), path, {}, [&, find = meshesBeside(path)](const std::string& mesh) {
      MeshFile found = find(mesh);
      add(found.path);
      return found;
    });
  }
  for (const std::string& name : host.controller(spec.controller.name)->paths()) {
    const auto word = spec.controller.words.find(name);
    if (word == spec.controller.words.end()) continue;
    const fs::path path = fs::path(spec.directory) / word->second;
    if (!fs::is_directory(path)) {
      add(path);
      continue;
    }
    for (const auto& entry : fs::recursive_directory_iterator(path))
      if (entry.is_regular_file()) add(entry.path());
  }
  return files;
}

}  // namespace

void EvaluationDesk::prepare(const v1::Experiment& experiment, Id run) {
  if (run != 0 && database_.empty()) throw Refusal(Code::notNow, "this server has no database");
  // A file may change, a run may get a new simulator: both are looked at again.
  std::optional<RunRecord> record;
  std::optional<ExperimentSpec> spec;
  std::string made;
  SimulatorSpec simulator;
  if (run != 0) {
    const Database db = Database::open(database_, Database::Mode::readOnly);
    record = db.run(run);
    simulator = db.latestSimulator(run).simulator;
    made = "run " + std::to_string(run) + toJsonText(simulator);
  } else {
    spec = experimentOf(experiment, folder_, host_);
    text_ = toJsonText(*spec);
    made = spec->directory + text_;
  }
  if (made == known_ && std::ranges::all_of(files_, [](const auto& f) { return stateOf(f.first) == f.second; })) return;
  known_.clear();
  evaluator_.reset();
  if (spec && !spec->plugins.empty()) host_.load(pluginFolders(*spec), "experiment /plugins");
  files_.clear();
  // Looked at before they are read: who changes one in between is seen the next time.
  if (spec) files_ = filesOf(*spec, host_);
  prepared_ =
      std::make_unique<PreparedExperiment>(record ? prepareFromRun(*record, host_) : prepareFromFiles(*spec, host_));
  simulator_ = record ? simulator : firstSimulator(*prepared_).simulator;
  seed_ = record ? record->seed : prepared_->spec.seed;
  known_ = made;
}

std::string EvaluationDesk::describe() const {
  v1::ExperimentReply reply;
  reply.set_name(prepared_->spec.name);
  for (const Parameter& parameter : prepared_->genotype) remote::describe(parameter, *reply.add_genotype());
  for (const Parameter& parameter : prepared_->adapted) remote::describe(parameter, *reply.add_adapted());
  reply.set_fitness(prepared_->spec.fitness.name);
  reply.set_unit(prepared_->fitness->unit());
  reply.set_seed(seed_);
  reply.set_json(text_);
  reply.mutable_start()->Add(prepared_->start.begin(), prepared_->start.end());
  return reply.SerializeAsString();
}

std::string EvaluationDesk::evaluate(const v1::EvaluateRequest& request) {
  RunRecord as;
  as.seed = request.has_seed() && request.run() == 0 ? request.seed() : seed_;
  const std::uint64_t trialSeed = trialSeedOf(as);
  std::vector<TrialJob> jobs;
  for (std::vector<double>& vector : vectorsOf(request, prepared_->genotype))
    jobs.push_back({simulator_, std::move(vector), trialSeed, false});
  if (!evaluator_) evaluator_ = std::make_unique<Evaluator>(*prepared_, jobs_);
  const std::atomic<bool> never{false};
  const auto replies = evaluator_->evaluate(jobs, never);
  v1::EvaluateReply out;
  for (const TrialReply& reply : *replies) {
    v1::Trial& trial = *out.add_trials();
    trial.set_fitness(reply.fitness);
    trial.set_outcome(reply.outcome);
    trial.set_detail(reply.detail);
    trial.set_trace_sha256(reply.traceSha256);
    for (const auto& [name, value] : reply.figures) (*trial.mutable_figures())[name] = value;
  }
  return out.SerializeAsString();
}

std::string EvaluationDesk::answer(Method method, std::string_view message) {
  if (method == Method::describeExperiment) {
    prepare(messageOf<v1::ExperimentRequest>(message).experiment(), 0);
    return describe();
  }
  if (method != Method::evaluate) throw Refusal(Code::notThere, "an evaluator does not answer this");
  const auto request = messageOf<v1::EvaluateRequest>(message);
  prepare(request.experiment(), request.run());
  return evaluate(request);
}

}  // namespace btr::remote
