#pragma once
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "core/cluster/coordinator.h"
#include "core/cluster/ranks.h"
#include "core/gap/report/run_analysis.h"

namespace btr {

/// An analysis on several ranks. One foreman of each makes the whole analysis, with worker processes of its own; the
/// jobs of each step (fits, replays, screened effects) are handed out in pieces among all, as Schedule says, and every
/// foreman goes on with the same results. The report is that of one process, whoever worked on what: all foremen must
/// have come to the same one before the first writes it. One that is killed begins anew with what is known.
/// Belongs to one thread; for one analysis.
class SharedAnalysis {
 public:
  /// As Ranks; of options.foremen there is one.
  SharedAnalysis(std::unique_ptr<RankLink> link, const PluginHost& host, CoordinatorOptions options);
  ~SharedAnalysis();

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
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr
