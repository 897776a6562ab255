#pragma once
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "core/plugin/plugin_host.h"
#include "core/run/loop/back_to_reality.h"
#include "core/run/loop/time_left.h"
#include "core/run/setup/evaluator.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/store/database.h"

namespace btr {

/// What the stages of one run share while a process works on it: the records it goes by, the workers, progress and
/// stop. Belongs to one thread.
class RunContext {
 public:
  RunContext(Database& database, const PluginHost& host, Id run, const StopFlag& stop, const RunOptions& options);

  Database& database;
  const PluginHost& host;
  RunRecord record;  ///< as it was when this process began; counters are asked from the database
  PreparedExperiment prepared;
  RunProgress progress;
  PlannedWork planned;  ///< populations as far as they are known; whoever asks a learner puts in what it made

  /// Starts the workers when they are first needed.
  Evaluator& evaluator();
  /// True once a stop was asked for, by the caller's flag or in the database; the latter is looked at once a second.
  bool stopped();
  /// Evaluates jobs with progress and stop. Nothing if stopped.
  std::optional<std::vector<TrialReply>> evaluate(const std::vector<TrialJob>& jobs);
  /// Publishes progress: at once if `now`, else at most once a second.
  void publish(bool now);

  int jobs() const;  ///< worker processes
  Workforce* workforce() const { return options_.workforce; }
  bool withoutRecordings() const { return options_.withoutRecordings; }
  int stageSetting(const std::string& name) const;          ///< of stageParameters()
  double adaptationSetting(const std::string& name) const;  ///< of adaptationParameters()
  double recordingSetting(const std::string& name) const;   ///< of recordingParameters()
  double realitySetting(const std::string& name) const;     ///< of realityLearningParameters()
  std::uint64_t trialSeed() const;                          ///< the one seed of all trials of this run
  int measuredAfter(int stage) const { return planned.measuredAfter(stage); }
  /// What is simulated until the run is finished, at the pace of this session's trials, into progress.secondsLeft;
  /// negative while there were none. See PlannedWork::trialsLeft.
  void estimateTimeLeft(int learned, int stage, int adapted);
  /// The newest simulator version.
  SimulatorRecord simulator() const;

 private:
  const StopFlag& stop_;
  std::atomic<bool> halt_{false};
  const RunOptions& options_;
  std::unique_ptr<Evaluator> evaluator_;
  double evaluated_s_ = 0;  ///< spent in evaluate()
  std::chrono::steady_clock::time_point begun_, published_, looked_;
};

/// One generation of L1 after another until `lastGeneration` is stored. False if stopped.
bool learnUntil(RunContext& context, int lastGeneration);
/// A packed trace if it is small enough to be stored, else nothing.
inline std::string keptTrace(const std::string& packed) {
  return packed.size() <= largestKeptTrace_bytes ? packed : std::string();
}

/// Chooses who is measured after the stage's last generation and stores tasks and traces; a stage in which everybody
/// was measured before is passed over. False if stopped. Throws InputError if no trial came to its end.
bool beginMeasuring(RunContext& context, int stage);
/// Lets the robot answer what is not settled yet; with a person it only looks. True when all tasks of the stage are
/// settled; with an iteration those of L2's.
bool completeMeasuring(RunContext& context, int stage, int iteration = 0);
/// How a stage ended that may also wait for a person.
enum class StageEnd { done, waiting, stopped };
/// L2, where the experiment wants it after this stage: iteration by iteration the learner proposes policies, which are
/// tried in reality (or in the newest simulator).
StageEnd learnInReality(RunContext& context, int stage);
/// What L2 of a completed stage gives back to L1; nothing if it had none or nothing is to go back.
std::optional<std::vector<double>> givenBack(const RunContext& context, int stage);
/// Where the experiment wants it after this stage: records the measured individuals (a person attaches recordings),
/// analyses them and stores the repaired simulator as the newest version.
StageEnd repairSimulator(RunContext& context, int stage);
/// L3 beside L2: breeds simulators while a person tries policies that L3 does not see; the version is made by
/// adaptSimulator(). done: nothing waits for the person any more, so L2 may go on. waiting: all is bred, or L3 must see
/// the policies first.
StageEnd adaptMeanwhile(RunContext& context, int stage);
/// L3: a new simulator version from all measurements so far. False if stopped.
bool adaptSimulator(RunContext& context, int stage);

}  // namespace btr
