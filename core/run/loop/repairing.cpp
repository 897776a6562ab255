// Between measuring and L3, where the experiment wants it: the measured individuals are recorded as well, gap analysis
// says what the simulator lacks, and the repaired simulator becomes the run's next version.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/run/loop/robot.h"
#include "core/run/loop/run_context.h"
#include "core/run/loop/waiting.h"
#include "core/run/reality/reality_gap.h"
#include "core/run/reality/recorded_analysis.h"
#include "core/run/reality/recorded_robot.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/system/cancelled.h"
#include "core/spec/system/scratch_folder.h"

namespace btr {
namespace {

/// Whom this stage records: the first in the order of measuring, without those whose trials all failed and without
/// those held out: what is made of the recordings must not know them.
std::vector<Id> whomToRecord(const RunContext& context, int stage, RobotPose pose) {
  std::vector<Id> who;
  for (const RealFitness& real : realFitness(context.database.measurementTasks(context.record.id, stage),
                                             context.database.measurements(context.record.id), stage))
    if (real.iteration == 0 && !real.heldOut) who.push_back(real.individual);
  double most = context.recordingSetting("individuals");
  const double hungUp = context.recordingSetting("hung_up_individuals");
  const bool both = context.prepared.spec.recordings.poses().size() > 1;
  if (both && pose == RobotPose::hungUp && hungUp > 0) most = std::min(most, hungUp);
  if (static_cast<double>(who.size()) > most) who.resize(static_cast<std::size_t>(most));
  return who;
}

RecordedAnalysis::Table tableOf(const RecordingRecord& record) { return {record.name, record.csv, record.mappingJson}; }

/// The individuals' recordings in that pose, in their order; several of one in the order in which they came.
std::vector<RecordingRecord> recordingsOf(const RunContext& context, const std::vector<Id>& who, RobotPose pose) {
  const std::vector<RecordingRecord> all = context.database.recordings(context.record.experiment);
  const bool both = context.prepared.spec.recordings.poses().size() > 1;
  std::vector<RecordingRecord> found;
  for (const Id individual : who)
    for (const RecordingRecord& listed : all) {
      if (listed.individual != individual) continue;
      RecordingRecord record = context.database.recording(listed.id);
      if (!both || poseOf(trialsOf(tableOf(record)).front()) == pose) found.push_back(std::move(record));
    }
  return found;
}

/// Who of them has no recording among these.
std::vector<Id> withoutRecording(std::vector<Id> who, const std::vector<RecordingRecord>& recordings) {
  std::erase_if(who, [&](Id individual) {
    return std::ranges::any_of(recordings, [&](const RecordingRecord& r) { return r.individual == individual; });
  });
  return who;
}

/// The robot records itself. False if stopped.
bool recordRobot(RunContext& context, const std::vector<Id>& who, RobotPose pose) {
  const ScratchFolder scratch("uchilsim-recordings");
  const auto robot = openRobot(context);
  if (!robot)
    throw InputError("reality " + context.record.reality + ": the plugin says that it records, and opens no robot");
  for (const Id individual : who) {
    if (context.stopped()) return false;
    RecordingRecord record;
    record.experiment = context.record.experiment;
    record.individual = individual;
    record.name = "run-" + std::to_string(context.record.id) + "-individual-" + std::to_string(individual) +
                  (pose == RobotPose::onFloor ? "-on-floor.csv" : ".csv");
    const auto answer =
        robot->measure({context.record.id, individual, 0, 0, context.database.individual(individual).parameters,
                        scratch.file(record.name), toText(pose)});
    if (!answer) return false;
    record.csv = readFile(scratch.file(record.name));
    record.sha256 = sha256(record.csv);
    record.source = context.prepared.reality->who();
    context.database.addRecording(record);
  }
  return true;
}

/// What the analysis says, and of what.
std::string evidenceOf(const RecordedFinding& finding, int stage, RobotPose pose,
                       const std::vector<RecordingRecord>& recordings) {
  nlohmann::json evidence = nlohmann::json::parse(finding.evidence);
  evidence["stage"] = stage;
  evidence["robot"] = toText(pose);
  evidence["recordings"] = evidence["recordings_sha256"] = nlohmann::json::array();
  for (const RecordingRecord& recording : recordings) {
    evidence["recordings"].push_back(recording.id);
    evidence["recordings_sha256"].push_back(recording.sha256);
  }
  return evidence.dump();
}

/// The analysis of the recordings, by whoever works for the run; nothing if stopped.
std::optional<RecordedFinding> analyseRecordings(RunContext& context, const SimulatorSpec& simulator,
                                                 const std::vector<RecordingRecord>& recordings, RobotPose pose) {
  RecordedAnalysis analysis{{}, simulator, pose, context.record.seed};
  for (const RecordingRecord& recording : recordings) analysis.recordings.push_back(tableOf(recording));
  context.progress.stage = "gap analysis";
  context.progress.stageTotal = 100;
  context.progress.secondsLeft = -1;
  const AnalysisProgress progress = [&](const std::string& what, double share) {
    context.progress.stageDone = static_cast<int>(100 * share);
    context.progress.message = what;
    context.publish(false);
    return !context.stopped();
  };
  const PreparedExperiment& prepared = context.prepared;
  try {
    if (Workforce* all = context.workforce())
      return all->analyse(prepared, analysis, progress, [&] { return !context.stopped(); });
    return analyseRecorded(prepared, context.host, analysis, problemOf(prepared, analysis), context.jobs(), progress);
  } catch (const Cancelled&) {
    return std::nullopt;
  }
}

/// What was adopted by hand in the meantime names no stage.
bool isRepairOf(const SimulatorRecord& version, int stage, RobotPose pose) {
  if (version.madeBy != "gap analysis") return false;
  const auto evidence = nlohmann::json::parse(version.evidence, nullptr, false);
  // Versions of one pose did not always say which.
  return evidence.is_object() && evidence.value("stage", 0) == stage &&
         evidence.value("robot", toText(pose)) == toText(pose);
}

/// How a person is told which recordings are waited for, where there are two kinds.
std::string describe(const PreparedExperiment& prepared, RobotPose pose) {
  if (prepared.spec.recordings.poses().size() < 2) return "";
  if (pose == RobotPose::hungUp) return " of the robot hung up, without its body's place";
  const std::string body = prepared.sceneSpec.robots.front().name + ".base.";
  return " on the floor, with its body's place (" + body + "x_m, " + body + "y_m)";
}

/// One pose's recordings, analysis and version.
StageEnd repairFrom(RunContext& context, int stage, RobotPose pose) {
  Database& db = context.database;
  const Id run = context.record.id;
  // Done before, or L3 has begun without it.
  const SimulatorRecord parent = context.simulator();
  if (std::ranges::any_of(db.simulators(run), [&](const SimulatorRecord& s) { return isRepairOf(s, stage, pose); }))
    return StageEnd::done;
  if (!db.adaptations(run, stage).empty()) return StageEnd::done;

  db.setRunState(run, RunState::adapting, "");
  const std::vector<Id> who = whomToRecord(context, stage, pose);
  if (who.empty()) return StageEnd::done;
  std::vector<RecordingRecord> recordings = recordingsOf(context, who, pose);
  std::vector<Id> missing = withoutRecording(who, recordings);
  const PreparedExperiment& prepared = context.prepared;
  if (prepared.reality->records(prepared.spec.realityOptions.settings) && !missing.empty()) {
    if (!recordRobot(context, missing, pose)) return StageEnd::stopped;
    recordings = recordingsOf(context, who, pose);
    missing = withoutRecording(who, recordings);
  }
  if (context.withoutRecordings() && recordings.empty()) return StageEnd::done;
  if (!missing.empty() && !context.withoutRecordings()) {
    context.progress.message = "measurement stage " + std::to_string(stage) + ": " + std::to_string(missing.size()) +
                               " of " + std::to_string(who.size()) + " individuals" + waitForRecording +
                               describe(context.prepared, pose) +
                               " (btr gap recordings import --individual); "
                               "btr run --without-recordings goes on with those that are there";
    context.publish(true);
    return StageEnd::waiting;
  }

  const auto finding = analyseRecordings(context, parent.simulator, recordings, pose);
  if (!finding) return StageEnd::stopped;
  // A version even if nothing was found: that the analysis was made, and what it said, is part of the lineage.
  SimulatorRecord version;
  version.run = run;
  version.parent = parent.id;
  version.simulator = finding->simulator;
  version.madeBy = "gap analysis";
  version.evidence = evidenceOf(*finding, stage, pose, recordings);
  version.madeAfterGeneration = context.measuredAfter(stage);
  version.createdAt = utcNow();
  db.addSimulator(version);
  context.progress.message.clear();
  return StageEnd::done;
}

}  // namespace

StageEnd repairSimulator(RunContext& context, int stage) {
  if (static_cast<double>(stage) != context.recordingSetting("after_stage")) return StageEnd::done;
  for (const RobotPose pose : context.prepared.spec.recordings.poses())
    if (const StageEnd end = repairFrom(context, stage, pose); end != StageEnd::done) return end;
  return StageEnd::done;
}

}  // namespace btr
