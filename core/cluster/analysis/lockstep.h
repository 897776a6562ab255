#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/cluster/place_report.h"
#include "core/cluster/ranks.h"
#include "core/gap/fit/gap_problem.h"

namespace btr {

/// One analysis on several ranks, as rank 0 leads it. Some of their foremen make the whole analysis each, with worker
/// processes of their own; the jobs of each step (fits, replays, screened effects) are handed out in pieces among all,
/// as Schedule says, and every foreman goes on with the same results. The outcome is that of one process, whoever
/// worked on what: all must have come to the same one before the first tells it. One that is killed begins anew with
/// what is known. Belongs to one thread.
class Lockstep {
 public:
  enum class Who {
    everyForeman,  ///< each with as many worker processes as it was started with
    oneOfEachRank  ///< with as many as the rank has foremen, who have nothing else to do
  };
  struct Task {
    Parts message;    ///< "analysis" or "repair" and what follows WORKERS (analysis_messages.h)
    long number = 1;  ///< each analysis of these ranks has another one
    Who who = Who::everyForeman;
    bool readsFiles = true;  ///< of each machine, which must be the same
  };
  /// What a foreman says that is not of this analysis, and that one was lost.
  using Others = Ranks::Hear;

  Lockstep(Ranks& ranks, const PluginHost& host, Task task);
  /// Who still works on it leaves it.
  ~Lockstep();
  Lockstep(const Lockstep&) = delete;
  Lockstep& operator=(const Lockstep&) = delete;

  /// What the first tells in the end. Throws what the analysis throws, Cancelled where `progress` or `goesOn`, which
  /// is asked now and then, says no; and InputError, which names rank and host, for one that has another build or other
  /// files, that did not begin, or that came to another outcome.
  Parts run(const AnalysisProgress& progress, const std::function<bool()>& goesOn, const Others& others = {});
  std::vector<PlaceReport> report() const;  ///< of those that take part
  /// Foremen that fell out on the way, a sentence each.
  const std::vector<std::string>& notes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace btr
