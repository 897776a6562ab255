#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/cluster/place_report.h"
#include "core/cluster/rank_link.h"
#include "core/cluster/ranks.h"
#include "core/gap/proof/proof_request.h"
#include "core/run/setup/workforce.h"

namespace btr {

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
  /// In lockstep: a foreman of each rank, with as many worker processes as the rank has foremen. Nothing of the
  /// database is needed there, and nothing on the machines' disks.
  RecordedFinding analyse(const PreparedExperiment& experiment, const RecordedAnalysis& analysis,
                          const AnalysisProgress& progress, const std::function<bool()>& goesOn) override;
  /// Cases are pieces of their own: proved where a place is free, in a folder of that machine, and brought back.
  /// Throws InputError as run() does; a machine must have the same generator, too.
  void prove(const ProofRequest& request, const std::vector<std::size_t>& numbers, const std::atomic<bool>& stop,
             const std::function<void(std::size_t, const WorkerPool::Reply&)>& done) override;
  std::vector<PlaceReport> report() const;
  /// Of all analyses so far: who took part, with parts of them as jobs.
  std::vector<PlaceReport> analysisReport() const;
  /// What fell out of an analysis, a sentence each.
  std::vector<std::string> notes() const;

 private:
  struct Impl;
  class LentRanks;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr
