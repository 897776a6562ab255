#pragma once
#include <atomic>
#include <functional>
#include <string>

#include "core/plugin/plugin_host.h"
#include "core/store/database.h"

namespace btr {

/// Where a run is, for progress bars. Written to the database about once a second and after each generation.
struct RunProgress {
  std::string stage;   ///< "L1", "measuring", "gap analysis", "L2", "L3", "finished"
  int generation = 0;  ///< L1 generations done
  int totalGenerations = 0;
  int stageDone = 0, stageTotal = 0;  ///< within this stage: generations of L1 or L3, iterations of L2
  long trials = 0;                    ///< simulated in this session
  double trialsPerSecond = 0;
  double secondsLeft = -1;    ///< estimate for the simulated part, negative: not known yet
  double best = 0, mean = 0;  ///< of the last generation (L3: best and mean error)
  std::string message;
};
std::string toJsonText(const RunProgress& progress);
RunProgress progressFromJson(const std::string& text);  ///< default values where text is empty

enum class RunEnd { finished, waiting, stopped };

/// Raised by signals or a window; read between trials.
using StopFlag = std::atomic<bool>;

class Workforce;

struct RunOptions {
  int jobs = 0;                    ///< worker processes, 0: as many as processors
  Workforce* workforce = nullptr;  ///< evaluates the trials in place of them, if there is one
  bool withoutRecordings = false;  ///< do not wait for recordings that a person has not attached
  bool earlierStopCounts = false;  ///< one asked for since forgetStop(); else only one asked for from now on does
  std::function<void(const RunProgress&)> progress;
};

/// Starts a run: checks, stores experiment (if new), run and simulator version 0. Returns the run's id. If the same
/// spec and seed is already stored, returns that run unless `again`.
Id startRun(Database& database, const PluginHost& host, const std::string& experimentPath, std::uint64_t seed,
            bool again = false);
/// The same from a spec in memory (the form). With `edited`: if the new run probably is another that was edited, in
/// what they differ and how to go on with that one; else empty.
Id startRun(Database& database, const PluginHost& host, const struct ExperimentSpec& spec, std::uint64_t seed,
            bool again = false, std::string* edited = nullptr);

/// Goes on with a run until it is finished, waits for a person, or `stop` is raised (or requested in the database): the
/// stage machine L1 → measure → (L2) → L3 → L1 …. All state is in the database: after kill -9 at any moment the next
/// call goes on with the same bits as if nothing had happened. Throws InputError if another process works on this run.
RunEnd continueRun(Database& database, const PluginHost& host, Id run, const StopFlag& stop, const RunOptions& options);

/// A stop that was asked for until now counts no longer, unless a process works on the run.
void forgetStop(Database& database, Id run);

/// True while some process works on this run.
bool isRunActive(const std::string& databasePath, Id run);

}  // namespace btr
