#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/cluster/rank_link.h"
#include "core/cluster/ranks.h"
#include "core/gap/proof/proof_request.h"
#include "core/run/setup/workforce.h"

namespace btr {

/// How the work goes at one place: a foreman of a rank.
struct PlaceReport {
  int rank = 0, foreman = 0;
  int workers = 1;  ///< its worker processes
  std::string host;
  long pieces = 0, jobs = 0, losses = 0;
  double worked_s = 0;  ///< in its worker, by the clock
};

/// The workforce of rank 0: its own foremen and those of the other ranks. Hands out pieces as Schedule says and puts
/// results together by the numbers of their jobs, so that they do not depend on who worked where, or when. A place that
/// is lost or does not answer in time is started anew and its piece given to the next that is free. All must have the
/// build that this process has. Belongs to one thread.
class Coordinator : public Workforce, public CaseForce {
 public:
  /// `link` may be none: only this rank's foremen. `host` must outlive it; its plugins are those that the others must
  /// have.
  Coordinator(std::unique_ptr<RankLink> link, const PluginHost& host, CoordinatorOptions options);
  /// Lets all ranks end.
  ~Coordinator() override;

  int workers() const override;
  /// Throws InputError, which names rank and host, if one of them has another build or other words, cannot prepare the
  /// experiment or never began; and if all places are gone or a job was lost three times with its process.
  std::vector<WorkerPool::Reply> run(const PreparedExperiment& experiment, const std::vector<std::string>& jobs,
                                     const std::atomic<bool>& stop,
                                     const std::function<void(std::size_t)>& done) override;
  /// Cases are pieces of their own: proved where a place is free, in a folder of that machine, and brought back.
  /// Throws InputError as run() does; a machine must have the same generator, too.
  void prove(const ProofRequest& request, const std::vector<std::size_t>& numbers, const std::atomic<bool>& stop,
             const std::function<void(std::size_t, const WorkerPool::Reply&)>& done) override;
  std::vector<PlaceReport> report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr
