#include "core/run/reality/recorded_analysis.h"

#include <nlohmann/json.hpp>

#include "core/gap/search/analysis.h"
#include "core/gap/search/report_words.h"
#include "core/run/reality/identified_numbers.h"
#include "core/run/reality/recorded_robot.h"
#include "core/run/reality/stored_recordings.h"
#include "core/spec/system/scratch_folder.h"

namespace btr {
namespace {

std::string evidenceOf(const GapReport& report) {
  nlohmann::json evidence{{"verdict", toText(report.verdict)},
                          {"sentence", report.sentence},
                          {"calibrated", toEvidence(report.calibrated)},
                          {"effects", nlohmann::json::array()},
                          {"ladder", nlohmann::json::array()},
                          {"seed", report.seed},
                          {"version", report.version}};
  for (const GapReport::Effect& effect : report.tried)
    if (effect.accepted)
      evidence["effects"].push_back(
          {{"effect", effect.effect}, {"at", effect.at}, {"parameters", toEvidence(effect.parameters)}});
  for (const GapReport::Step& step : report.ladder)
    evidence["ladder"].push_back({{"what", step.what}, {"error_in_noise_floors", step.error}});
  return evidence.dump();
}

}  // namespace

std::vector<Recording> trialsOf(const RecordedAnalysis::Table& recording) {
  const ScratchFolder scratch("uchilsim-recordings");
  RecordingRecord record;
  record.name = recording.name;
  record.csv = recording.csv;
  record.mappingJson = recording.mappingJson;
  return loadTrials(writeRecordingFiles(record, scratch.path().string()));
}

GapProblem problemOf(const PreparedExperiment& prepared, const RecordedAnalysis& analysis) {
  std::vector<Recording> trials;
  for (const RecordedAnalysis::Table& recording : analysis.recordings)
    for (Recording& trial : trialsOf(recording)) trials.push_back(std::move(trial));
  return recordedProblem(prepared, analysis.simulator, std::move(trials), analysis.pose);
}

RecordedFinding analyseRecorded(const PreparedExperiment& prepared, const PluginHost& host,
                                const RecordedAnalysis& analysis, const GapProblem& problem, int jobs,
                                const AnalysisProgress& progress) {
  AnalysisOptions options;
  options.jobs = jobs;
  options.seed = analysis.seed;
  options.maximumEffects =
      static_cast<int>(valueOf(recordingParameters(), prepared.spec.recordings.settings, "maximum_effects"));
  options.effects = consideredEffects(prepared, host, analysis.pose);
  options.designNext = false;
  // On the floor its curve takes minutes, and nobody sees it.
  options.learnRest = analysis.pose == RobotPose::hungUp;
  const EffectLibrary library{host.effectFactory(), host.effects()};
  const GapReport report = analyse(problem, library, options, progress);
  return {report.after, evidenceOf(report)};
}

}  // namespace btr
