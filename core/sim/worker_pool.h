#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace btr {

/// Worker processes that turn job texts into reply texts. They are forked when the pool is made, so they see everything
/// that the caller had in memory by then; a job carries the rest. A worker that dies or does not answer in time is
/// replaced; its job is tried once more and then gets a failure. Replies come back in the order of the jobs, whatever
/// worker ran them, so results do not depend on the number of workers. Workers never outlive their parent.
class WorkerPool {
 public:
  /// Runs in the worker. An exception becomes a failure of that job.
  using Work = std::function<std::string(const std::string& job)>;
  struct Reply {
    bool ok = false;
    std::string bytes;    ///< what Work returned
    std::string failure;  ///< why there is no reply, e.g. "the worker died (signal 11)"
    bool killed = false;  ///< the worker was killed from outside (signal 9), as by a machine without memory
  };
  /// A job that came to its end.
  struct Ended {
    std::size_t number = 0;  ///< as it was added
    Reply reply;
    double seconds = 0;  ///< in its worker, by the clock
  };

  /// `workers` ≥ 1. `secondsPerJob` is wall time, meant as a last resort. Throws InputError if no process can be made.
  WorkerPool(int workers, Work work, double secondsPerJob = 120);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  int workers() const;
  /// True in a worker process: what runs there makes no workers of its own.
  static bool inWorker();
  /// Runs all jobs. Returns nothing if `stop` was raised before all were done (running jobs are abandoned).
  /// `done(n)` is called in this thread after each finished job.
  std::vector<Reply> run(const std::vector<std::string>& jobs, const std::atomic<bool>& stop,
                         const std::function<void(std::size_t)>& done = {});

  /// Where jobs come while others are worked on, in place of run(): one more, which wait() names by its number.
  void add(std::size_t number, std::string job);
  /// Hands out what was added, and returns what has come to its end: after at most so long, or as soon as `file` (−1:
  /// none) can be read.
  std::vector<Ended> wait(int milliseconds, int file = -1);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Processors that this process may use.
int processorCount();

}  // namespace btr
