#pragma once
#include <string>
#include <vector>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/search/analysis.h"
#include "core/gap/search/gap_report.h"

namespace btr {

/// What `btr gap analyse` was asked for: paths.
struct AnalysisRequest {
  std::string scene;
  std::vector<std::string> recordings, heldOut;
  std::string mapping, simulator, out;
  AnalysisOptions options;
};
GapProblem loadProblem(const AnalysisRequest& request);
/// Of what loadProblem() gave. Writes nothing.
GapReport analyseLoaded(const AnalysisRequest& request, const GapProblem& problem, const EffectLibrary& library,
                        const AnalysisProgress& progress = {});
/// Loads, analyses, writes the report into `out` (nothing if it is cancelled).
GapReport runAnalysis(const AnalysisRequest& request, const EffectLibrary& library,
                      const AnalysisProgress& progress = {});

}  // namespace btr
