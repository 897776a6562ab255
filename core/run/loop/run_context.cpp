#include "core/run/loop/run_context.h"

#include <algorithm>

#include "core/run/loop/search.h"

namespace btr {
namespace {
using Clock = std::chrono::steady_clock;
double secondsSince(Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); }

/// What L3's learner calls its population; 0 where it has none or chooses it itself.
int adaptersPopulation(const PreparedExperiment& prepared, const PluginHost& host) {
  const PluginChoice& chosen = prepared.spec.adaptation;
  const std::vector<Parameter> known = host.learner(chosen.name)->settingsFor(prepared.adapted);
  const bool hasOne = find(known, "population") != nullptr;
  return hasOne ? static_cast<int>(valueOf(known, chosen.settings, "population")) : 0;
}
}  // namespace

RunContext::RunContext(Database& db, const PluginHost& plugins, Id run, const StopFlag& stop, const RunOptions& options)
    : database(db),
      host(plugins),
      record(db.run(run)),
      prepared(prepareFromRun(record, plugins)),
      stop_(stop),
      options_(options),
      begun_(Clock::now()) {
  progress.totalGenerations = stageSetting("total_generations");
  planned = {0,
             adaptersPopulation(prepared, host),
             stageSetting("first_generations"),
             stageSetting("next_generations"),
             stageSetting("total_generations"),
             static_cast<int>(adaptationSetting("generations")),
             stageSetting("measured_individuals") - static_cast<int>(adaptationSetting("held_out"))};
}

void RunContext::estimateTimeLeft(int learned, int stage, int adapted) {
  progress.secondsLeft = progress.trials > 0 ? planned.trialsLeft(learned, stage, adapted) * evaluated_s_ /
                                                   static_cast<double>(progress.trials)
                                             : -1;
}

Evaluator& RunContext::evaluator() {
  if (!evaluator_) evaluator_ = std::make_unique<Evaluator>(prepared, options_.jobs, options_.workforce);
  return *evaluator_;
}

bool RunContext::stopped() {
  if (stop_) halt_ = true;
  if (!halt_ && secondsSince(looked_) > 1) {
    looked_ = Clock::now();
    if (database.run(record.id).stopRequested) halt_ = true;
  }
  return halt_;
}

std::optional<std::vector<TrialReply>> RunContext::evaluate(const std::vector<TrialJob>& jobs) {
  if (stopped()) return std::nullopt;
  const long before = progress.trials;
  const auto begun = Clock::now();
  auto replies = evaluator().evaluate(jobs, halt_, [&](std::size_t done) {
    progress.trials = before + static_cast<long>(done);
    stopped();
    publish(false);
  });
  evaluated_s_ += secondsSince(begun);
  return replies;
}

void RunContext::publish(bool now) {
  if (!now && secondsSince(published_) < 1) return;
  published_ = Clock::now();
  const double seconds = secondsSince(begun_);
  progress.trialsPerSecond = seconds > 0 ? static_cast<double>(progress.trials) / seconds : 0;
  database.setProgress(record.id, toJsonText(progress));
  if (options_.progress) options_.progress(progress);
}

int RunContext::jobs() const { return options_.jobs > 0 ? options_.jobs : processorCount(); }

int RunContext::stageSetting(const std::string& name) const {
  return static_cast<int>(valueOf(stageParameters(), prepared.spec.stages, name));
}

double RunContext::adaptationSetting(const std::string& name) const {
  return valueOf(adaptationParameters(), prepared.spec.adaptationSettings, name);
}

double RunContext::recordingSetting(const std::string& name) const {
  return valueOf(recordingParameters(), prepared.spec.recordings.settings, name);
}

double RunContext::realitySetting(const std::string& name) const {
  return valueOf(realityLearningParameters(), prepared.spec.realitySettings, name);
}

std::uint64_t RunContext::trialSeed() const { return trialSeedOf(record); }

SimulatorRecord RunContext::simulator() const { return database.simulators(record.id).back(); }

}  // namespace btr
