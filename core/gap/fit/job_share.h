#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/sim/worker_pool.h"

namespace btr {

/// Where several processes, on one machine or many, make the same analysis together: each makes the same calls of
/// parallel() one after another, and the jobs of a call are divided among them. All of them get the results of all
/// jobs, so that whoever computes what changes no result.
class JobShare {
 public:
  virtual ~JobShare() = default;
  /// What jobs 0 … count−1 gave, in order, wherever they were worked on. `work` is for worker processes of this one;
  /// `goOn` is told how many are known here. Throws Cancelled when it says no.
  virtual std::vector<WorkerPool::Reply> run(std::size_t count, const std::function<std::string(std::size_t)>& work,
                                             const std::function<bool(std::size_t)>& goOn) = 0;
};

/// While it lives, parallel() of this process divides its jobs so. One at a time; belongs to the thread that analyses.
class SharedJobs {
 public:
  explicit SharedJobs(JobShare& share);
  ~SharedJobs();
  SharedJobs(const SharedJobs&) = delete;
  SharedJobs& operator=(const SharedJobs&) = delete;
  /// None where this process works alone.
  static JobShare* now();
};

/// Wall time of a job of an analysis, as WorkerPool means it.
constexpr double longestAnalysisJob_s = 3600;

}  // namespace btr
