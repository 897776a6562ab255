#pragma once
#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/gap/fit/gap_problem.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/sim/worker_pool.h"

namespace btr {

struct RecordedAnalysis;
struct RecordedFinding;

/// Who evaluates trials and analyses recordings, where that is not this process's own worker processes alone: those of
/// other machines, too.
class Workforce {
 public:
  virtual ~Workforce() = default;
  virtual int workers() const = 0;
  /// As WorkerPool::run(), each job being a trial of `experiment` as the Evaluator writes it. Throws InputError for
  /// what a machine did rather than the trial: a build that differs, places that cannot work.
  virtual std::vector<WorkerPool::Reply> run(const PreparedExperiment& experiment, const std::vector<std::string>& jobs,
                                             const std::atomic<bool>& stop,
                                             const std::function<void(std::size_t)>& done) = 0;
  /// As problemOf() and analyseRecorded(), made by all of them together: the same finding. Throws Cancelled where
  /// `progress` or `goesOn`, which is asked now and then, says no; InputError as run() does.
  virtual RecordedFinding analyse(const PreparedExperiment& experiment, const RecordedAnalysis& analysis,
                                  const AnalysisProgress& progress, const std::function<bool()>& goesOn) = 0;
};

}  // namespace btr
