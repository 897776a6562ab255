#include "core/remote/evaluation_desk.h"

#include "core/remote/act_messages.h"
#include "core/remote/experiments.h"
#include "core/run/search.h"
#include "core/spec/error.h"
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
  if (made == known_) return;
  known_.clear();
  evaluator_.reset();
  if (spec && !spec->plugins.empty()) host_.load(pluginFolders(*spec), "experiment /plugins");
  prepared_ =
      std::make_unique<PreparedExperiment>(record ? prepareFromRun(*record, host_) : prepareFromFiles(*spec, host_));
  simulator_ = record ? simulator : firstSimulator(prepared_->spec).simulator;
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
