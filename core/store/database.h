#pragma once
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/spec/sha256.h"
#include "core/store/grid_records.h"
#include "core/store/records.h"

namespace btr {

class Connection;

/// Traces above this are stored only as their hash: 20 s of walking are a megabyte, which a replay makes again.
inline constexpr std::size_t largestKeptTrace_bytes = std::size_t{256} * 1024;

/// What a merge has added.
struct MergedRuns {
  int experiments = 0, runs = 0, individuals = 0;
};

/// The experiment database: one SQLite file (WAL, foreign keys, STRICT tables, numbered migrations, synchronous =
/// FULL). All SQL of the program stands behind this class. One Database belongs to one thread; open another for another
/// thread or process, a forked one too. Every writing call is one transaction: all of it is stored or nothing. Errors:
/// InputError (what the user can mend: foreign, newer, damaged, read-only file, disk full, database locked for more
/// than 5 s, unknown id).
class Database {
 public:
  enum class Mode { readOnly, readWrite, create };
  /// `create` makes the file if it is not there; `readOnly` and `readWrite` refuse an absent one. `create` and
  /// `readWrite` bring an older file up to date. A file that is empty, not ours, damaged (quick_check) or made by a
  /// newer program is refused and left unchanged. `readOnly` also works beside a writer and in a folder that cannot be
  /// written. A call that meets another process's lock waits `patience_ms` for it.
  static Database open(const std::string& path, Mode mode, int patience_ms = 5000);
  ~Database();
  Database(Database&&) noexcept;
  Database& operator=(Database&&) noexcept;

  const std::string& path() const;
  /// Number that changes when any connection has committed (cheap; for polling).
  std::int64_t dataVersion() const;
  /// Of a connection that only reads: while `stop` is true, which another thread may set, a call ends soon with an
  /// InputError, also one that waits for a lock. `stop` lives longer than the database.
  void endWhen(const std::atomic<bool>& stop);

  // ---- the file as a whole
  /// A consistent, checked copy while others work with the database: complete under another name first, on the disk,
  /// then named. Returns its bytes. Refuses a file that is there unless it is to be replaced.
  std::int64_t backUp(const std::string& to, bool replace) const;
  /// What is wrong with pages, indexes and references; empty: the file is sound.
  std::vector<std::string> findings() const;
  /// Moves what was committed from the write-ahead log into the database file, so that a copy of that file has it.
  /// False if another process reads an older state for longer than `patience_ms`: then some of it stays in the log.
  bool moveLogIntoFile(int patience_ms = 500) const;

  // ---- experiments and runs
  Id addExperiment(const ExperimentRecord& experiment);
  std::vector<ExperimentRecord> experiments() const;
  std::optional<Id> findExperiment(const std::string& specJson) const;  ///< the latest with exactly this text
  ExperimentRecord experiment(Id id) const;
  void setExperimentNote(Id id, const std::string& note);
  /// Stores run, files and its first simulator version (number 0) together. An absent programVersion, startedAt or
  /// createdAt is filled in. Files are shared by content between runs.
  Id addRun(const RunRecord& run, const SimulatorRecord& first);
  /// The same with an experiment of its own: both are stored, or neither is.
  Id addRun(const ExperimentRecord& experiment, RunRecord run, const SimulatorRecord& first);
  std::vector<RunRecord> runs(Id experiment = 0) const;  ///< without specs' files; 0: of all experiments
  RunRecord run(Id id) const;                            ///< with everything
  /// The latest such run that is not a cell of a grid.
  std::optional<Id> findRun(const std::string& specSha256, std::uint64_t seed) const;
  std::optional<Id> latestRun() const;
  void setRunState(Id run, RunState state, const std::string& message);
  void setRunNote(Id run, const std::string& note);
  void setProgress(Id run, const std::string& progressJson);
  void requestStop(Id run, bool stop);

  // ---- L1
  /// Generation, its individuals (ids, and what they take from the generation, are written back) and the run's counter.
  /// Refuses a number that is not the next. −0 becomes 0, also in the record; NaN is refused, infinity kept.
  void addGeneration(GenerationRecord& generation);
  std::vector<GenerationRecord> generations(Id run, int after = 0) const;  ///< without individuals and learner states
  std::optional<GenerationRecord> lastGeneration(Id run) const;            ///< with individuals and states
  /// Those of L1; 0: of all generations, in their order.
  std::vector<IndividualRecord> individuals(Id run, int generation = 0) const;
  std::vector<IndividualRecord> individualsOfSimulator(Id run,
                                                       Id simulator) const;  ///< simulated ones only (sameAs = 0)
  std::vector<IndividualRecord> bestIndividuals(Id run, int count, int firstGeneration, int lastGeneration) const;
  ///< distinct (identityOf), best first, ties by generation and slot; lastGeneration 0: no limit
  IndividualRecord individual(Id id) const;
  /// Refuses a hash that differs from the one stored with the individual: that would be another trial. Of a trace that
  /// is not to be kept (`packed` empty) only the hash is stored: a replay makes it again and is checked by it.
  void setTrace(Id individual, const std::string& packed, const std::string& sha256);
  std::optional<std::string> trace(Id individual) const;  ///< packed bytes

  // ---- measurements
  /// All tasks of the next stage at once; the run's state becomes waiting.
  void addMeasurementStage(Id run, int stage, const std::vector<MeasurementTask>& tasks);
  std::vector<MeasurementTask> measurementTasks(Id run, int stage = 0) const;  ///< 0: of all stages; by stage, position
  /// Refuses a value that is not finite and an individual that no task names.
  Id addMeasurement(const MeasurementRecord& measurement);
  std::vector<Id> addMeasurements(const std::vector<MeasurementRecord>& measurements);  ///< all or none
  void setMeasurementVoid(Id measurement, bool isVoid, const std::string& note);
  std::vector<MeasurementRecord> measurements(Id run) const;  ///< in the order of entry, void ones too
  MeasurementRecord measurement(Id id) const;

  // ---- L2
  /// The next iteration as it begins (run, stage, number, centre before, states after the learner was asked), its
  /// policies (ids, generation and slots are written back), their packed traces ("" for none) and, with `wantedRepeats`
  /// > 0, their measurement tasks in the order `order` (indices of policies); the run then waits.
  void beginRealityIteration(const RealityIteration& begun, std::vector<IndividualRecord>& policies,
                             const std::vector<std::string>& traces, const std::vector<std::size_t>& order,
                             int wantedRepeats);
  std::optional<RealityIteration> begunRealityIteration(Id run,
                                                        int stage) const;  ///< begun and not finished; no policies
  std::vector<IndividualRecord> realityPolicies(Id run, int stage, int number) const;  ///< begun or finished; else none
  /// Ends the iteration that was begun; its centre before is kept from there.
  void addRealityIteration(const RealityIteration& iteration);
  std::vector<RealityIteration> realityIterations(Id run, int stage = 0) const;  ///< 0: of all stages
  /// A person ends L2 of the run's present stage. Refuses where L2 has not begun in it; asking twice changes nothing.
  void endRealityLearning(Id run, const std::string& who);
  bool isRealityLearningEnded(Id run, int stage) const;

  // ---- L3
  void addAdaptation(const AdaptationRecord& adaptation);  ///< refuses a stage or number that is not the next
  std::vector<AdaptationRecord> adaptations(Id run, int stage) const;
  /// New simulator version, gap record, stage counter and the state `next`, together. Returns the version's id, which
  /// is also the gap's simulatorAfter. A version's number is the next of its run.
  Id finishStage(const SimulatorRecord& simulator, GapRecord gap, RunState next);
  void passStage(Id run, int stage, RunState next);  ///< a stage without an individual to measure and without an update
  Id addSimulator(const SimulatorRecord& simulator);  ///< by hand or by gap analysis
  std::vector<SimulatorRecord> simulators(Id run) const;
  SimulatorRecord simulator(Id id) const;
  SimulatorRecord latestSimulator(Id run) const;
  std::vector<GapRecord> gaps(Id run) const;

  // ---- rigs: scenes that no run belongs to, each an experiment without runs, with simulator versions of its own
  /// Experiment and version 0 together; an experiment of the same specification that is there already is returned.
  Id addRig(const ExperimentRecord& rig, const SimulatorRecord& first);
  /// Refuses a number that is not the next of its rig, and a parent that is not a version of it.
  Id addRigSimulator(const SimulatorRecord& version);
  std::vector<SimulatorRecord> rigSimulators(Id rig) const;  ///< by number; 0: of all rigs, by rig and number

  // ---- recordings
  Id addRecording(
      const RecordingRecord& recording);  ///< refuses a sha256 that is not that of csv; an absent one is filled in
  std::vector<RecordingRecord> recordings(Id experiment) const;  ///< without csv
  RecordingRecord recording(Id id) const;

  // ---- grids
  /// Grid, cells and the first runs together; there is one grid of a spec, method and seed.
  Id addGrid(const GridRecord& grid, const std::vector<GridCellRecord>& cells, const std::vector<GridStart>& first);
  /// The same with an experiment of its own: all is stored, or nothing is.
  Id addGrid(const ExperimentRecord& experiment, GridRecord grid, const std::vector<GridCellRecord>& cells,
             std::vector<GridStart> first);
  void beginGridCells(Id grid, const std::vector<GridStart>& starts);
  /// A generation of each of these cells; ids are written back, also the bests'.
  void addGridRound(Id grid, std::vector<GridStep>& steps);
  void settleGrid(Id grid,
                  std::vector<GridSettlement>& settlements);  ///< their runs are finished then; ids written back
  void addGridPoints(Id grid, const std::vector<GridPoint>& points);
  std::vector<GridRecord> grids() const;
  GridRecord grid(Id id) const;
  std::optional<Id> findGrid(const std::string& specSha256, const std::string& method, std::uint64_t seed) const;
  std::optional<Id> gridOfRun(Id run) const;               ///< the grid that the run is a cell of
  std::vector<GridCellRecord> gridCells(Id grid) const;    ///< by number
  std::vector<GridBest> gridBests(Id grid) const;          ///< by cell and generation
  std::vector<GridSolution> gridSolutions(Id grid) const;  ///< by cell
  std::vector<GridPoint> gridPoints(Id grid) const;        ///< by number

  // ---- other databases
  /// Copies all experiments, runs, grids and recordings of another database, with new numbers; experiments of the same
  /// name and specification become one. The other file is only read. Traces of more than `largestTrace` bytes stay
  /// behind (their hashes come along: a replay makes them again). Refuses, and copies nothing, where a run or grid is
  /// in both. With `runs` (the other database's numbers) only these come along, with their experiments and recordings,
  /// and no grid or rig; one that is not there is refused.
  MergedRuns merge(const std::string& path, std::size_t largestTrace, const std::vector<Id>& runs = {});

 private:
  explicit Database(std::unique_ptr<Connection> connection);
  std::unique_ptr<Connection> connection_;
};

/// The version of this program, e.g. "0.1.0".
std::string programVersion();
/// Now in UTC, "2026-11-21T10:11:12Z".
std::string utcNow();

}  // namespace btr
