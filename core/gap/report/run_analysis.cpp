#include "core/gap/report/run_analysis.h"

#include <filesystem>

#include "core/gap/fit/gap_problem.h"
#include "core/gap/recordings/recording.h"
#include "core/gap/replay/trial_scenes.h"
#include "core/gap/report/report_files.h"
#include "core/gap/search/gap_report.h"
#include "core/sim/engine/ode_session.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"

namespace btr {

namespace {

/// A recording that was fitted scores nothing.
void refuseSeenHeldOut(const GapProblem& problem) {
  for (const Recording& held : problem.heldOut)
    for (const Recording& fitted : problem.recordings)
      if (held.sha256 == fitted.sha256)
        throw InputError(held.source + " (held out): has the same bytes as " + fitted.source +
                         ", which is fitted; what is held out is a recording that no fit sees");
}

}  // namespace

GapProblem loadProblem(const AnalysisRequest& request) {
  requireOde();
  GapProblem problem;
  problem.scene = loadScene(request.scene);
  problem.models = loadModels(problem.scene);
  if (!request.simulator.empty()) problem.simulator = loadSimulator(request.simulator);
  const auto load = [&](const std::vector<std::string>& paths, std::vector<Recording>& recordings) {
    for (const std::string& path : paths)
      for (Recording& trial : loadTrialsFor(path, request.mapping, request.scene))
        recordings.push_back(std::move(trial));
  };
  load(request.recordings, problem.recordings);
  load(request.heldOut, problem.heldOut);
  const TrialScenes scenes{problem.scene, problem.models, problem.simulator};
  scenes.prepare(problem.recordings);
  scenes.prepare(problem.heldOut);
  refuseSeenHeldOut(problem);
  return problem;
}

GapReport analyseLoaded(const AnalysisRequest& request, const GapProblem& problem, const EffectLibrary& library,
                        const AnalysisProgress& progress) {
  GapReport report = analyse(problem, library, request.options, progress);
  report.scene = std::filesystem::absolute(request.scene).lexically_normal().string();
  report.sceneSha256 = sha256(readFile(request.scene));
  return report;
}

GapReport runAnalysis(const AnalysisRequest& request, const EffectLibrary& library, const AnalysisProgress& progress) {
  refuseUnknownEffects(request.options, library);
  const GapReport report = analyseLoaded(request, loadProblem(request), library, progress);
  if (!request.out.empty()) writeReport(report, request.out);
  return report;
}

}  // namespace btr
