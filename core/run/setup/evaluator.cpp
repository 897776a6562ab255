#include "core/run/setup/evaluator.h"

#include <map>
#include <nlohmann/json.hpp>

#include "core/spec/error.h"

namespace btr {
namespace {

using nlohmann::json;

std::string encode(const TrialJob& job) {
  return json{{"simulator", toJsonText(job.simulator)},
              {"parameters", job.parameters},
              {"seed", job.seed},
              {"wantTrace", job.wantTrace},
              {"task", job.task},
              {"fitnessOnly", job.fitnessOnly}}
      .dump();
}

TrialJob decodeJob(const std::string& text) {
  const json j = json::parse(text);
  TrialJob job;
  job.simulator = simulatorFromJson(j.at("simulator").get<std::string>(), "job");
  job.parameters = j.at("parameters").get<std::vector<double>>();
  job.seed = j.at("seed").get<std::uint64_t>();
  job.wantTrace = j.at("wantTrace").get<bool>();
  job.task = j.at("task").get<Values>();
  job.fitnessOnly = j.at("fitnessOnly").get<bool>();
  return job;
}

// One line of JSON, then the trace's bytes.
std::string encode(const TrialReply& reply) {
  return json{{"fitness", reply.fitness},
              {"outcome", reply.outcome},
              {"detail", reply.detail},
              {"sha256", reply.traceSha256},
              {"figures", reply.figures}}
             .dump(-1, ' ', false, json::error_handler_t::replace) +
         '\n' + reply.packedTrace;
}

TrialReply decodeReply(const std::string& bytes) {
  const std::size_t line = bytes.find('\n');
  const json j = json::parse(bytes.substr(0, line));
  return {j.at("fitness").get<double>(),
          j.at("outcome").get<std::string>(),
          j.at("detail").get<std::string>(),
          j.at("sha256").get<std::string>(),
          bytes.substr(line + 1),
          j.at("figures").get<Values>()};
}

/// The outcome of a trial that came to its end and whose fitness is no number: it failed as others do.
constexpr const char* withoutNumber = "no fitness";

TrialReply evaluateIn(const PreparedExperiment& prepared, const Scene& scene, const TrialJob& job) {
  const TrialResult result = job.fitnessOnly ? prepared.trialForFitness(scene, job.parameters, job.seed)
                                             : prepared.trial(scene, job.parameters, job.seed, true);
  const std::optional<double> number = prepared.numberOf(result);
  TrialReply reply;
  reply.fitness = number.value_or(prepared.fitness->ofFailure());
  reply.outcome = number ? toText(result.outcome) : withoutNumber;
  reply.detail = !number           ? "the fitness plugin \"" + prepared.spec.fitness.name + "\" gave no finite number"
                 : job.fitnessOnly ? result.detail
                                   : prepared.detailOf(result);
  if (job.fitnessOnly) return reply;
  if (number) reply.figures = prepared.figuresOf(result);
  reply.traceSha256 = result.trace.sha256();
  if (job.wantTrace) reply.packedTrace = result.trace.pack();
  return reply;
}

}  // namespace

TrialReply runTrialJob(const PreparedExperiment& prepared, const TrialJob& job) {
  const PreparedExperiment own = prepared.withTask(job.task);
  return evaluateIn(own, own.scene(job.simulator), job);
}

WorkerPool::Work trialWork(const PreparedExperiment& prepared) {
  // A worker keeps the scenes of the last simulator: L1 asks for the same ones all the time.
  struct Task {
    PreparedExperiment experiment;
    Scene scene;
  };
  struct Cache {
    std::optional<SimulatorSpec> simulator;
    std::map<Values, Task> tasks;
  };
  constexpr std::size_t mostTasks = 64;
  return [&prepared, cache = std::make_shared<Cache>()](const std::string& text) {
    const TrialJob job = decodeJob(text);
    if (!cache->simulator || *cache->simulator != job.simulator || cache->tasks.size() >= mostTasks)
      cache->tasks.clear();
    cache->simulator = job.simulator;
    auto task = cache->tasks.find(job.task);
    if (task == cache->tasks.end()) {
      PreparedExperiment own = prepared.withTask(job.task);
      Scene scene = own.scene(job.simulator);
      task = cache->tasks.emplace(job.task, Task{std::move(own), std::move(scene)}).first;
    }
    return encode(evaluateIn(task->second.experiment, task->second.scene, job));
  };
}

Evaluator::Evaluator(const PreparedExperiment& prepared, int workers, Workforce* workforce)
    : prepared_(prepared), workforce_(workforce) {
  if (!workforce_) pool_ = std::make_unique<WorkerPool>(workers > 0 ? workers : processorCount(), trialWork(prepared));
}

std::optional<std::vector<TrialReply>> Evaluator::evaluate(const std::vector<TrialJob>& jobs,
                                                           const std::atomic<bool>& stop,
                                                           const std::function<void(std::size_t)>& done) {
  std::vector<std::string> texts;
  texts.reserve(jobs.size());
  for (const TrialJob& job : jobs) texts.push_back(encode(job));
  const std::vector<WorkerPool::Reply> replies =
      workforce_ ? workforce_->run(prepared_, texts, stop, done) : pool_->run(texts, stop, done);
  if (replies.size() != jobs.size()) return std::nullopt;
  std::vector<TrialReply> results;
  results.reserve(replies.size());
  // What the machine did is no result of the trial.
  for (const WorkerPool::Reply& reply : replies)
    if (reply.killed)
      throw InputError(
          "a trial's worker process was killed twice (signal 9), as happens when memory runs out; nothing "
          "of this generation is stored: go on with fewer jobs or when the machine is free");
  for (const WorkerPool::Reply& reply : replies)
    results.push_back(
        reply.ok
            ? decodeReply(reply.bytes)
            : TrialReply{
                  prepared_.fitness->ofFailure(), toText(TrialResult::Outcome::workerDied), reply.failure, "", "", {}});
  return results;
}

}  // namespace btr
