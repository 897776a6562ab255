#include "core/run/loop/back_to_reality.h"

#include <nlohmann/json.hpp>

#include "core/run/loop/run_context.h"
#include "core/run/setup/run_lock.h"
#include "core/run/setup/spec_changes.h"
#include "core/spec/error.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"

namespace btr {

std::string toJsonText(const RunProgress& p) {
  return nlohmann::json{{"stage", p.stage},
                        {"generation", p.generation},
                        {"total_generations", p.totalGenerations},
                        {"stage_done", p.stageDone},
                        {"stage_total", p.stageTotal},
                        {"trials", p.trials},
                        {"trials_per_second", p.trialsPerSecond},
                        {"seconds_left", p.secondsLeft},
                        {"best", p.best},
                        {"mean", p.mean},
                        {"message", p.message}}
      .dump();
}

RunProgress progressFromJson(const std::string& text) {
  RunProgress p;
  if (text.empty()) return p;
  JsonReader r = JsonReader::parse(text, "progress of a run");
  constexpr double any = 1e300;
  p.stage = r.text("stage", "");
  p.generation = static_cast<int>(r.integer("generation", 0, 1'000'000'000, 0));
  p.totalGenerations = static_cast<int>(r.integer("total_generations", 0, 1'000'000'000, 0));
  p.stageDone = static_cast<int>(r.integer("stage_done", -1'000'000'000, 1'000'000'000, 0));
  p.stageTotal = static_cast<int>(r.integer("stage_total", 0, 1'000'000'000, 0));
  p.trials = static_cast<long>(r.integer("trials", 0, 1'000'000'000'000, 0));
  p.trialsPerSecond = r.number("trials_per_second", 0, any, 0);
  p.secondsLeft = r.number("seconds_left", -any, any, -1);
  p.best = r.number("best", -any, any, 0);
  p.mean = r.number("mean", -any, any, 0);
  p.message = r.text("message", "");
  return p;
}

namespace {

std::string saidOf(const RunRecord& old, const RunRecord& fresh, Id begins) {
  const std::string number = std::to_string(old.id);
  return "run " + number + " of the same name differs in " + inWords(specChanges(old, fresh)) + "; run " +
         std::to_string(begins) + " begins" +
         (old.state == RunState::finished ? " (run " + number + " is finished)"
                                          : "; to go on with run " + number + ": --run " + number);
}

}  // namespace

Id startRun(Database& database, const PluginHost& host, const ExperimentSpec& spec, std::uint64_t seed, bool again,
            std::string* edited) {
  const PreparedExperiment prepared = prepareFromFiles(spec, host);
  RunRecord record = makeRunRecord(prepared, 0, seed);
  if (!again)
    if (const auto run = database.findRun(record.specSha256, seed)) return *run;

  const std::optional<RunRecord> old = edited ? editedRun(database, spec.name, record) : std::nullopt;
  // Runs of the same spec with other seeds belong to one experiment.
  for (const ExperimentRecord& e : database.experiments())
    if (e.name == spec.name && e.specJson == record.specJson) record.experiment = e.id;
  ExperimentRecord experiment;
  experiment.name = spec.name;
  experiment.specJson = record.specJson;
  experiment.createdAt = utcNow();
  const Id begins = record.experiment != 0 ? database.addRun(record, firstSimulator(prepared))
                                           : database.addRun(experiment, record, firstSimulator(prepared));
  if (old) *edited = saidOf(*old, record, begins);
  return begins;
}

Id startRun(Database& database, const PluginHost& host, const std::string& path, std::uint64_t seed, bool again) {
  return startRun(database, host, loadExperiment(path), seed, again);
}

RunEnd continueRun(Database& database, const PluginHost& host, Id run, const StopFlag& stop,
                   const RunOptions& options) {
  if (database.run(run).state == RunState::finished) return RunEnd::finished;
  if (const auto grid = database.gridOfRun(run))
    throw InputError("run " + std::to_string(run) + " of " + database.path() + ": it is a cell of grid " +
                     std::to_string(*grid) + "; its cells go on together (btr grid)");
  const RunLock lock(database.path(), run, "run", [&] {
    if (!options.earlierStopCounts) database.requestStop(run, false);
  });
  RunContext context(database, host, run, stop, options);
  const auto stopped = [&] {
    database.setRunState(run, RunState::stopped, "stopped; continue it at any time");
    context.publish(true);
    return RunEnd::stopped;
  };
  const auto waiting = [&] {
    database.setRunState(run, RunState::waiting, context.progress.message);
    return RunEnd::waiting;
  };

  while (true) {
    const RunRecord now = database.run(run);
    context.progress.generation = now.generation;
    if (now.state == RunState::finished) {
      context.progress.stage = "finished";
      if (const auto last = database.lastGeneration(run)) {
        context.progress.best = last->best;
        context.progress.mean = last->mean;
      }
      context.progress.secondsLeft = 0;
      context.publish(true);
      return RunEnd::finished;
    }
    const int stage = now.stage + 1;
    if (database.measurementTasks(run, stage).empty()) {
      if (!learnUntil(context, context.measuredAfter(stage))) return stopped();
      if (!beginMeasuring(context, stage)) return stopped();
      if (database.run(run).stage == stage) continue;  // nobody was left to measure
    }
    if (!completeMeasuring(context, stage)) {
      if (context.stopped()) return stopped();
      return waiting();
    }
    const StageEnd repaired = repairSimulator(context, stage);
    if (repaired == StageEnd::stopped) return stopped();
    if (repaired == StageEnd::waiting) return waiting();
    const StageEnd learned = learnInReality(context, stage);
    if (learned == StageEnd::stopped) return stopped();
    if (learned == StageEnd::waiting) {
      const RunEnd waits = waiting();
      const StageEnd adapted = adaptMeanwhile(context, stage);
      if (adapted == StageEnd::done) continue;
      if (adapted == StageEnd::stopped) return stopped();
      return waits;
    }
    if (!adaptSimulator(context, stage)) return stopped();
  }
}

void forgetStop(Database& database, Id run) {
  RunLock::ifNobodyWorks(database.path(), run, [&] { database.requestStop(run, false); });
}

bool isRunActive(const std::string& databasePath, Id run) { return RunLock::isHeld(databasePath, run); }

}  // namespace btr
