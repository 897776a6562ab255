#pragma once
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/proof/proof_score.h"
#include "core/gap/proof/proved_case.h"
#include "core/gap/report/run_analysis.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/gap_report.h"

namespace btr {

/// A blind trial: cases 1 … `cases` of a seed. Empty `engine`, `scene`, `kind`, `dirt`: our own engine,
/// drawn, drawn, none.
struct ProofRequest {
  std::string generator;  ///< path of the program that conceals
  std::string out;        ///< folder; finished cases in it are kept, those of another trial refused
  std::uint64_t seed = 1;
  std::size_t cases = 20;
  std::size_t only = 0;  ///< of these only one; 0: all
  std::string engine, scene, kind, dirt;
  std::size_t spoiled = 0;  ///< trials of each case that are not what their files say
  int jobs = 1;             ///< worker processes, one case each
  AnalysisOptions options;
};

/// Loads, analyses, writes its report: runAnalysis().
using Analyse = std::function<GapReport(const AnalysisRequest& request, const EffectLibrary& library)>;

/// Lets the generator conceal, keeps the seal, analyses, writes the verdict, opens the seal and checks it, lets the
/// generator record further trials and measures the error of what was found in them, case by case; then proof.json,
/// proof.txt and proof.html of all finished cases. Each finished case is in OUT/case_NNN/verdict.json and is not
/// repeated. A raised `stop` ends it early with what is finished. `progress(done, all)` is called after each case.
/// Throws InputError for a generator that is not there, for a folder of another trial and, after all others are
/// counted, for cases that the generator failed to make.
std::vector<ProvedCase> runProof(const ProofRequest& request, const EffectLibrary& library, const Analyse& analyse,
                                 const std::atomic<bool>& stop,
                                 const std::function<void(std::size_t, std::size_t)>& progress = {});

/// $UCHILSIM_CONCEAL, else `conceal` beside the running program. Throws InputError that says how to build it.
std::string findGenerator();

}  // namespace btr
