#include "core/cluster/foreman.h"

#include <signal.h>
#include <sys/prctl.h>

#include <chrono>

#include "core/cluster/analysis/analysis_foreman.h"
#include "core/cluster/analysis/analysis_messages.h"
#include "core/cluster/blind_cases.h"
#include "core/cluster/build_identity.h"
#include "core/cluster/experiment_message.h"
#include "core/cluster/foreman_pipe.h"
#include "core/cluster/own_scratch.h"
#include "core/cluster/parts.h"
#include "core/gap/proof/proof_run.h"
#include "core/run/setup/evaluator.h"
#include "core/spec/error.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

/// What is worked on, with its worker. The worker ends before what it works on.
struct Task {
  PreparedExperiment prepared;  ///< whose trials the jobs are, unless they are blind cases
  ProofRequest trial;
  EffectLibrary library;
  Parts identity;
  std::unique_ptr<WorkerPool> pool;
};

std::unique_ptr<Task> prepareExperiment(const Parts& message, const PluginHost& host, double secondsPerJob) {
  auto task = std::make_unique<Task>();
  task->prepared = prepareFromRun(experimentFrom(message.begin() + 2, message.end()), host);
  task->identity = buildIdentity(host);
  task->pool = std::make_unique<WorkerPool>(1, trialWork(task->prepared), secondsPerJob);
  return task;
}

std::unique_ptr<Task> prepareCases(const Parts& message, const PluginHost& host) {
  constexpr std::size_t head = 3;
  if (message.size() < head) throw InputError("a blind trial that is cut short");
  removeAbandonedScratch(caseScratch);
  auto task = std::make_unique<Task>();
  task->trial = proofRequestFromJson(message[2]);
  task->trial.generator = findGenerator();
  task->library = {host.effectFactory(), host.effects()};
  task->identity = buildIdentity(host, task->trial.generator);
  const Task& of = *task;
  task->pool = std::make_unique<WorkerPool>(
      1, [&of](const std::string& job) { return proveAway(of.trial, std::stoul(job), of.library); }, longestCase_s);
  return task;
}

Parts workOn(const Parts& message, WorkerPool& pool) {
  const std::vector<std::string> jobs(message.begin() + 2, message.end());
  const std::atomic<bool> never{false};
  const auto begun = std::chrono::steady_clock::now();
  const std::vector<WorkerPool::Reply> replies = pool.run(jobs, never);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  Parts answer{"done", message[1], toText(seconds)};
  for (const WorkerPool::Reply& reply : replies) {
    answer.emplace_back(reply.ok ? "R" : reply.killed ? "K" : "F");
    answer.push_back(reply.ok ? reply.bytes : reply.failure);
  }
  return answer;
}

}  // namespace

void servePieces(const PluginHost& host, double secondsPerJob, int workers) {
  // Who started it decides when it ends, Ctrl-C reaches the whole group.
  signal(SIGINT, SIG_IGN);
  signal(SIGTERM, SIG_IGN);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const ForemanPipe pipe = takeStandardStreams();
  pipe.write(joined({"hello"}, buildIdentity(host)));
  std::unique_ptr<Task> task;
  while (const auto message = pipe.read()) {
    if (message->size() < 2) continue;
    const std::string& kind = message->front();
    if (kind == "piece" && task) {
      pipe.write(workOn(*message, *task->pool));
    } else if (isAnalysis(*message)) {
      task.reset();
      serveAnalysis(*message, pipe, host, workers);
    } else if (kind == "experiment" || kind == "cases") {
      task.reset();
      try {
        task = kind == "cases" ? prepareCases(*message, host) : prepareExperiment(*message, host, secondsPerJob);
        pipe.write(joined({"ready", (*message)[1]}, task->identity));
      } catch (const std::exception& error) {
        pipe.write({"refused", (*message)[1], error.what()});
      }
    }
  }
}

}  // namespace btr
