#include "core/sim/worker_pool.h"

#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <exception>
#include <optional>

#include "core/spec/error.h"
#include "core/spec/system/child_process.h"
#include "core/spec/system/crash_report.h"

namespace btr {
namespace {

using Clock = std::chrono::steady_clock;

bool writeAll(int fd, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = send(fd, data, size, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    data += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

// A message is its length (8 bytes, this machine's order) and its bytes.
bool sendMessage(int fd, const std::string& bytes) {
  const std::uint64_t size = bytes.size();
  return writeAll(fd, reinterpret_cast<const char*>(&size), sizeof size) && writeAll(fd, bytes.data(), bytes.size());
}

bool receiveMessage(int fd, std::string& bytes) {
  std::uint64_t size = 0;
  if (!readAll(fd, reinterpret_cast<char*>(&size), sizeof size) || size > (1ull << 32)) return false;
  bytes.resize(size);
  return readAll(fd, bytes.data(), size);
}

bool thisIsAWorker = false;

/// A crash inside a plugin is a last message of its own kind. Only what a signal handler may do.
void tellParentOfCrash(const char* text, std::size_t size) {
  const std::uint64_t all = size + 1;
  const char kind = 'C';
  if (writeAll(3, reinterpret_cast<const char*>(&all), sizeof all) && writeAll(3, &kind, 1)) writeAll(3, text, size);
}

/// The life of a worker: job in, reply out, until the parent hangs up. The first byte of a reply: R a reply, F why
/// there is none, C the plugin in which the worker is about to die.
[[noreturn]] void serve(int socket, const WorkerPool::Work& work) {
  // Ctrl-C reaches the whole group: the parent decides. No file of the parent stays open here (its locks among them).
  thisIsAWorker = true;
  signal(SIGINT, SIG_IGN);
  signal(SIGTERM, SIG_DFL);
  dup2(socket, 3);
  close_range(4, ~0U, 0);
  tellCrashes(tellParentOfCrash, false);
  std::string job;
  while (receiveMessage(3, job)) {
    std::string reply;
    try {
      reply = 'R' + work(job);
    } catch (const std::exception& error) {
      reply = std::string("F") + error.what();
    }
    if (!sendMessage(3, reply)) break;
  }
  _exit(0);
}

std::string howItEnded(int status) {
  if (WIFSIGNALED(status)) return "the worker died (signal " + std::to_string(WTERMSIG(status)) + ")";
  return "the worker ended (exit code " + std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : -1) + ")";
}

/// What a worker is to do.
struct Task {
  std::size_t number = 0;
  std::string job;
  int tries = 0;
};

struct Worker {
  pid_t pid = -1;
  int socket = -1;
  std::optional<Task> task;  // that it works on
  Clock::time_point since;
  double busy_s() const { return std::chrono::duration<double>(Clock::now() - since).count(); }
};

}  // namespace

struct WorkerPool::Impl {
  Work work;
  double secondsPerJob;
  std::vector<Worker> workers;
  std::deque<Task> waiting;  ///< for a worker

  void start(Worker& worker) {
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
      throw InputError(std::string("cannot make a worker process: ") + std::strerror(errno));
    const pid_t parent = getpid();
    const pid_t pid = fork();
    if (pid < 0) {
      close(pair[0]);
      close(pair[1]);
      throw InputError(std::string("cannot make a worker process: ") + std::strerror(errno));
    }
    if (pid == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent) _exit(0);
      serve(pair[1], work);
    }
    close(pair[1]);
    // Who stops in the middle of a message is waited for no longer than who says nothing.
    const double whole_s = std::floor(std::min(secondsPerJob, 1e6));
    constexpr double perSecond = 1e6;
    const timeval limit{static_cast<time_t>(whole_s),
                        static_cast<suseconds_t>((std::min(secondsPerJob, 1e6) - whole_s) * perSecond)};
    setsockopt(pair[0], SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    setsockopt(pair[0], SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
    worker = Worker{pid, pair[0], std::nullopt, Clock::now()};
  }

  /// Ends a worker and says how it ended; nothing of one that should have ended by itself and had to be killed.
  static std::optional<int> finish(Worker& worker, bool force) {
    close(worker.socket);
    constexpr int patience_ms = 1000;
    const bool stuck = !force && !endsWithin(worker.pid, patience_ms);
    if (force || stuck) kill(worker.pid, SIGKILL);
    int status = 0;
    while (waitpid(worker.pid, &status, 0) < 0 && errno == EINTR) {
    }
    return stuck ? std::nullopt : std::optional(status);
  }

  ~Impl() {
    for (Worker& worker : workers)
      if (worker.pid > 0) finish(worker, worker.task.has_value());
  }

  static bool isLate() { return errno == EAGAIN || errno == EWOULDBLOCK; }
  std::string noAnswer() const { return "no answer within " + std::to_string(static_cast<int>(secondsPerJob)) + " s"; }

  /// Nobody waits any more for what is worked on.
  void abandon() {
    waiting.clear();
    for (Worker& worker : workers)
      if (worker.task) {
        finish(worker, true);
        start(worker);
      }
  }

  /// A worker that is lost. Its job is tried again, or fails when it has had its second try.
  void replace(Worker& worker, bool force, const std::string& why, std::vector<Ended>& ended) {
    Task task = std::move(*worker.task);
    const double seconds = worker.busy_s();
    const std::optional<int> status = finish(worker, force);
    start(worker);
    if (task.tries < 2) return waiting.push_front(std::move(task));
    Ended lost{task.number, {}, seconds};
    lost.reply.killed = why.empty() && status && WIFSIGNALED(*status) && WTERMSIG(*status) == SIGKILL;
    lost.reply.failure = !why.empty() ? why : status ? howItEnded(*status) : "the worker hung up and did not end";
    ended.push_back(std::move(lost));
  }

  void handOut(std::vector<Ended>& ended) {
    for (Worker& worker : workers) {
      if (worker.task || waiting.empty()) continue;
      worker.task = std::move(waiting.front());
      waiting.pop_front();
      ++worker.task->tries;
      worker.since = Clock::now();
      errno = 0;
      if (!sendMessage(worker.socket, worker.task->job)) replace(worker, true, isLate() ? noAnswer() : "", ended);
    }
  }

  /// An answer that has arrived, or the end of a worker.
  void take(Worker& worker, std::vector<Ended>& ended) {
    std::string bytes;
    errno = 0;
    if (!receiveMessage(worker.socket, bytes) || bytes.empty())
      return replace(worker, isLate(), isLate() ? noAnswer() : "", ended);
    if (bytes[0] == 'C') return replace(worker, false, bytes.substr(1), ended);
    Ended answered{worker.task->number, {}, worker.busy_s()};
    answered.reply.ok = bytes[0] == 'R';
    (answered.reply.ok ? answered.reply.bytes : answered.reply.failure) = bytes.substr(1);
    worker.task.reset();
    ended.push_back(std::move(answered));
  }
};

WorkerPool::WorkerPool(int workers, Work work, double secondsPerJob)
    : impl_(new Impl{std::move(work), secondsPerJob, {}, {}}) {
  impl_->workers.resize(static_cast<std::size_t>(workers));
  for (Worker& worker : impl_->workers) impl_->start(worker);
}

WorkerPool::~WorkerPool() = default;

bool WorkerPool::inWorker() { return thisIsAWorker; }

int WorkerPool::workers() const { return static_cast<int>(impl_->workers.size()); }

void WorkerPool::add(std::size_t number, std::string job) { impl_->waiting.push_back({number, std::move(job), 0}); }

std::vector<WorkerPool::Ended> WorkerPool::wait(int milliseconds, int file) {
  std::vector<Ended> ended;
  impl_->handOut(ended);
  std::vector<pollfd> files;
  std::vector<Worker*> whose;
  for (Worker& worker : impl_->workers)
    if (worker.task) {
      files.push_back({worker.socket, POLLIN, 0});
      whose.push_back(&worker);
    }
  if (file >= 0) files.push_back({file, POLLIN, 0});
  poll(files.data(), files.size(), ended.empty() ? milliseconds : 0);
  for (std::size_t i = 0; i < whose.size(); ++i) {
    if (files[i].revents != 0)
      impl_->take(*whose[i], ended);
    else if (whose[i]->busy_s() > impl_->secondsPerJob)
      impl_->replace(*whose[i], true, impl_->noAnswer(), ended);
  }
  return ended;
}

std::vector<WorkerPool::Reply> WorkerPool::run(const std::vector<std::string>& jobs, const std::atomic<bool>& stop,
                                               const std::function<void(std::size_t)>& done) {
  impl_->abandon();
  for (std::size_t i = 0; i < jobs.size(); ++i) add(i, jobs[i]);
  std::vector<Reply> replies(jobs.size());
  constexpr int lookForStop_ms = 100;
  for (std::size_t finished = 0; finished < jobs.size();) {
    if (stop) {
      impl_->abandon();
      return {};
    }
    for (Ended& ended : wait(lookForStop_ms)) {
      replies[ended.number] = std::move(ended.reply);
      ++finished;
      if (done) done(finished);
    }
  }
  return replies;
}

int processorCount() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return std::max(1, CPU_COUNT(&set));
}

}  // namespace btr
