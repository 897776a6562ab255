#pragma once
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "core/cluster/analysis/lockstep.h"
#include "core/gap/report/run_analysis.h"

namespace btr {

/// The analysis of files on several ranks (`mpirun btr gap analyse`), in lockstep: the report of one process, whoever
/// worked on what, written by the first foreman. Belongs to one thread; for one analysis.
class SharedAnalysis {
 public:
  /// As Ranks; of options.foremen there is one.
  SharedAnalysis(std::unique_ptr<RankLink> link, const PluginHost& host, CoordinatorOptions options);

  /// The report as text.
  struct Report {
    std::string plain, json;
  };
  /// Loads, analyses and writes into request.out. Throws what runAnalysis() throws, Cancelled where `progress` or
  /// `stop` say so; and InputError, which names rank and host, for one that has another build or other files, that did
  /// not begin, or that came to another report.
  Report run(const AnalysisRequest& request, const AnalysisProgress& progress, const std::atomic<bool>& stop);
  std::vector<PlaceReport> report() const;
  /// Ranks that fell out on the way, a sentence each.
  std::vector<std::string> notes() const;

 private:
  const PluginHost& host_;
  Ranks ranks_;
  std::unique_ptr<Lockstep> lockstep_;
};

}  // namespace btr
