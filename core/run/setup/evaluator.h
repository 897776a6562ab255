#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/run/setup/prepared_experiment.h"
#include "core/run/setup/workforce.h"
#include "core/sim/worker_pool.h"

namespace btr {

/// One trial to run, self-contained but for the experiment that the workers already know.
struct TrialJob {
  SimulatorSpec simulator;
  std::vector<double> parameters;  ///< in the order of the genotype
  std::uint64_t seed = 0;
  bool wantTrace = false;    ///< send the packed trace back, not only its hash
  Values task = {};          ///< settings of the controller in place of the experiment's; empty: none
  bool fitnessOnly = false;  ///< wanted is the fitness (the same) with its outcome: no trace, no hash, no figures
};

/// What a trial was worth. A trial that failed in any way has the fitness of a failure and says why.
struct TrialReply {
  double fitness = 0;
  std::string outcome = "finished";  ///< toText(TrialResult::Outcome), or "no fitness"
  std::string detail;                ///< why it failed, or what else the fitness tells: "falls 0, straightness 0.97"
  std::string traceSha256;           ///< "" if a worker died, or none was wanted
  std::string packedTrace;           ///< if wanted
  Values figures = {};               ///< what else the fitness tells, as numbers
};

/// Runs one trial here and now; what a worker does.
TrialReply runTrialJob(const PreparedExperiment& prepared, const TrialJob& job);

/// What a worker does with the text of a trial, wherever it works: the reply's text. `prepared` must outlive it.
WorkerPool::Work trialWork(const PreparedExperiment& prepared);

/// Evaluates trials on worker processes, or with a workforce.
class Evaluator {
 public:
  /// `prepared` must outlive the evaluator, and so must the workforce. `workers` 0: as many as processors; with a
  /// workforce there are no others than its own.
  Evaluator(const PreparedExperiment& prepared, int workers, Workforce* workforce = nullptr);
  /// Replies in the order of the jobs; nothing if `stop` was raised. `done(n)` after each finished trial.
  std::optional<std::vector<TrialReply>> evaluate(const std::vector<TrialJob>& jobs, const std::atomic<bool>& stop,
                                                  const std::function<void(std::size_t)>& done = {});
  int workers() const { return workforce_ ? workforce_->workers() : pool_->workers(); }

 private:
  const PreparedExperiment& prepared_;
  Workforce* workforce_;
  std::unique_ptr<WorkerPool> pool_;  ///< none with a workforce
};

}  // namespace btr
