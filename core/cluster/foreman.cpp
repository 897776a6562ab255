#include "core/cluster/foreman.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <optional>

#include "core/cluster/blind_cases.h"
#include "core/cluster/build_identity.h"
#include "core/cluster/own_scratch.h"
#include "core/cluster/parts.h"
#include "core/gap/proof/proof_run.h"
#include "core/run/setup/evaluator.h"
#include "core/spec/child_process.h"
#include "core/spec/error.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

/// Where messages come from and go to. Ends the process when nobody is there any more.
struct Pipe {
  int in = -1, out = -1;

  std::optional<Parts> read() const {
    std::uint64_t size = 0;
    if (!readAll(in, reinterpret_cast<char*>(&size), sizeof size)) return std::nullopt;
    std::string bytes(size, '\0');
    if (!readAll(in, bytes.data(), size)) return std::nullopt;
    return unpack(bytes);
  }
  void write(const Parts& parts) const {
    const std::string bytes = pack(parts);
    const std::uint64_t size = bytes.size();
    std::string all(reinterpret_cast<const char*>(&size), sizeof size);
    all += bytes;
    for (std::size_t done = 0; done < all.size();) {
      const ssize_t n = ::write(out, all.data() + done, all.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) _exit(0);
      done += static_cast<std::size_t>(n);
    }
  }
};

Pipe takeStandardStreams() {
  Pipe pipe{fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 10), fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 10)};
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  dup2(nothing, STDIN_FILENO);
  close(nothing);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  return pipe;
}

/// What is worked on, with its worker. The worker ends before what it works on.
struct Task {
  PreparedExperiment prepared;  ///< whose trials the jobs are, unless they are blind cases
  ProofRequest trial;
  EffectLibrary library;
  Parts identity;
  std::unique_ptr<WorkerPool> pool;
};

std::unique_ptr<Task> prepareExperiment(const Parts& message, const PluginHost& host, double secondsPerJob) {
  constexpr std::size_t head = 4, perFile = 3;
  if (message.size() < head) throw InputError("an experiment that is cut short");
  RunRecord record;
  record.specJson = message[2];
  record.sceneJson = message[3];
  for (std::size_t i = head; i + perFile <= message.size(); i += perFile) {
    StoredFile file;
    file.name = message[i];
    file.sha256 = message[i + 1];
    file.content = message[i + 2];
    record.files.push_back(std::move(file));
  }
  auto task = std::make_unique<Task>();
  task->prepared = prepareFromRun(record, host);
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

Parts joined(Parts head, const Parts& rest) {
  head.insert(head.end(), rest.begin(), rest.end());
  return head;
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

void servePieces(const PluginHost& host, double secondsPerJob) {
  // Who started it decides when it ends, Ctrl-C reaches the whole group.
  signal(SIGINT, SIG_IGN);
  signal(SIGTERM, SIG_IGN);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const Pipe pipe = takeStandardStreams();
  pipe.write(joined({"hello"}, buildIdentity(host)));
  std::unique_ptr<Task> task;
  while (const auto message = pipe.read()) {
    if (message->size() < 2) continue;
    const std::string& kind = message->front();
    if (kind == "piece" && task) {
      pipe.write(workOn(*message, *task->pool));
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
