#pragma once
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/report/run_analysis.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/gap_report.h"
#include "core/sim/worker_pool.h"

namespace btr {

struct ProofRequest;

/// Who proves cases, where that is not this process's own worker processes alone: those of other machines, too.
class CaseForce {
 public:
  virtual ~CaseForce() = default;
  /// Proves cases and puts each that came to its end into the request's folder, whole, as proveCase() would have.
  /// `done(i, reply)`: the i-th of `numbers` is there, or the reply says why not; in any order. Returns early, without
  /// the rest, when `stop` was raised. Throws InputError for what a machine did rather than a case.
  virtual void prove(const ProofRequest& request, const std::vector<std::size_t>& numbers,
                     const std::atomic<bool>& stop,
                     const std::function<void(std::size_t, const WorkerPool::Reply&)>& done) = 0;
};

/// A blind trial: cases 1 … `cases` of a seed. Empty `engine`, `scene`, `kind`, `dirt`: our own engine,
/// drawn, drawn, none.
struct ProofRequest {
  std::string generator;  ///< path of the program that conceals
  std::string out;        ///< folder; finished cases in it are kept, those of another trial refused
  std::string place;      ///< what reports call that folder, where cases are carried to another one; empty: as it is
  std::uint64_t seed = 1;
  std::size_t cases = 20;
  std::size_t from = 0, to = 0;  ///< of these only some; 0, 0: all
  std::string engine, scene, kind, dirt;
  std::size_t spoiled = 0;  ///< trials of each case that are not what their files say
  int jobs = 1;             ///< worker processes, one case each
  AnalysisOptions options;
  CaseForce* force = nullptr;  ///< proves the cases in place of them, if there is one

  bool asksFor(std::size_t number) const {
    return number >= 1 && number <= cases && (to == 0 || (number >= from && number <= to));
  }
};

/// What another process needs in order to prove cases of the same trial: all but generator, folder, jobs and force.
std::string toJsonText(const ProofRequest& request);
ProofRequest proofRequestFromJson(const std::string& text);  ///< throws InputError

/// Loads and analyses: runAnalysis(), which is asked for no folder.
using Analyse = std::function<GapReport(const AnalysisRequest& request, const EffectLibrary& library)>;

/// A case that takes longer has been lost, in s.
constexpr double longestCase_s = 4 * 3600;

}  // namespace btr
