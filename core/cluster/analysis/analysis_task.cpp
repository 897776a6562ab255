#include "core/cluster/analysis/analysis_task.h"

#include <memory>

#include "core/cluster/analysis/analysis_messages.h"
#include "core/cluster/experiment_message.h"
#include "core/gap/report/report_files.h"
#include "core/gap/report/report_json.h"
#include "core/gap/report/report_plain.h"
#include "core/spec/error.h"
#include "core/spec/sha256.h"

namespace btr {
namespace {

std::string hashOf(GapReport report) {
  report.seconds = 0;
  return sha256(toJsonText(report));
}

/// As `btr gap analyse` makes it: from files, into files.
AnalysisTask ofFiles(const Parts& message, const PluginHost& host) {
  AnalysisRequest request = analysisRequestFromJson(message.at(3));
  const EffectLibrary library{host.effectFactory(), host.effects()};
  refuseUnknownEffects(request.options, library);
  const auto problem = std::make_shared<const GapProblem>(loadProblem(request));
  AnalysisTask task;
  task.inputs = inputsOf(request, *problem);
  task.analyse = [request, library, problem](int jobs, const AnalysisProgress& progress) {
    AnalysisRequest here = request;
    here.options.jobs = jobs;
    const GapReport report = analyseLoaded(here, *problem, library, progress);
    return AnalysisOutcome{hashOf(report), [report, out = request.out]() -> Parts {
                             if (!out.empty()) writeReport(report, out);
                             return {toPlainText(report), toJsonText(report)};
                           }};
  };
  return task;
}

/// A run's own: from the message alone.
AnalysisTask ofARun(const Parts& message, const PluginHost& host) {
  struct Asked {
    RecordedAnalysis analysis;
    PreparedExperiment prepared;
    GapProblem problem;
  };
  const auto asked = std::make_shared<Asked>();
  constexpr std::size_t head = 4;
  if (message.size() < head) throw InputError("an analysis that is cut short");
  asked->analysis = recordedAnalysisFrom(message[head - 1]);
  asked->prepared = prepareFromRun(experimentFrom(message.begin() + head, message.end()), host);
  asked->problem = problemOf(asked->prepared, asked->analysis);
  AnalysisTask task;
  task.inputs = inputsOf(asked->problem);
  task.analyse = [asked, &host](int jobs, const AnalysisProgress& progress) {
    const Parts finding =
        partsOf(analyseRecorded(asked->prepared, host, asked->analysis, asked->problem, jobs, progress));
    return AnalysisOutcome{sha256(pack(finding)), [finding] { return finding; }};
  };
  return task;
}

}  // namespace

AnalysisTask analysisTaskFrom(const Parts& message, const PluginHost& host) {
  return message.at(0) == "repair" ? ofARun(message, host) : ofFiles(message, host);
}

}  // namespace btr
