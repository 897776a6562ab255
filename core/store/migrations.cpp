#include "core/store/migrations.h"

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Statement.h>
#include <SQLiteCpp/Transaction.h>
#include <sqlite3.h>

#include <array>
#include <string>

#include "core/store/migration_steps.h"

namespace btr {
namespace {

// What was asked for, and by which program. Rows of experiment and run stay as they were when the run began; what
// changes while it goes on stands in run_state, so that a step of progress does not write the specification again.
constexpr const char* experimentsAndRuns = R"(
CREATE TABLE experiment (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL,
  spec_json TEXT NOT NULL,
  created_at TEXT NOT NULL,
  note TEXT NOT NULL
) STRICT;
CREATE TABLE stored_file (
  sha256 TEXT PRIMARY KEY,
  content BLOB NOT NULL
) STRICT;
CREATE TABLE run (
  id INTEGER PRIMARY KEY,
  experiment_id INTEGER NOT NULL REFERENCES experiment(id),
  seed INTEGER NOT NULL,
  spec_json TEXT NOT NULL,
  spec_sha256 TEXT NOT NULL,
  scene_json TEXT NOT NULL,
  reality TEXT NOT NULL CHECK (reality IN ('person', 'stand_in')),
  program_version TEXT NOT NULL,
  started_at TEXT NOT NULL
) STRICT;
CREATE INDEX run_by_spec ON run(spec_sha256, seed);
CREATE INDEX run_by_experiment ON run(experiment_id);
CREATE TABLE run_state (
  run_id INTEGER PRIMARY KEY REFERENCES run(id),
  state TEXT NOT NULL
    CHECK (state IN ('ready', 'learning', 'waiting', 'adapting', 'finished', 'stopped', 'failed')),
  stage INTEGER NOT NULL CHECK (stage >= 0),
  generation INTEGER NOT NULL CHECK (generation >= 0),
  stop_requested INTEGER NOT NULL CHECK (stop_requested IN (0, 1)),
  updated_at TEXT NOT NULL,
  message TEXT NOT NULL,
  progress_json TEXT NOT NULL,
  note TEXT NOT NULL
) STRICT;
CREATE TABLE run_file (
  run_id INTEGER NOT NULL REFERENCES run(id),
  position INTEGER NOT NULL,
  name TEXT NOT NULL,
  sha256 TEXT NOT NULL REFERENCES stored_file(sha256),
  PRIMARY KEY (run_id, position),
  UNIQUE (run_id, name)
) STRICT, WITHOUT ROWID;
)";

// A simulator is a version with a parent; its numbers are rows, so that they can be asked for and keep their bits.
constexpr const char* simulators = R"(
CREATE TABLE simulator (
  id INTEGER PRIMARY KEY,
  run_id INTEGER NOT NULL REFERENCES run(id),
  number INTEGER NOT NULL CHECK (number >= 0),
  parent_id INTEGER REFERENCES simulator(id),
  made_by TEXT NOT NULL,
  evidence TEXT NOT NULL,
  made_after_generation INTEGER NOT NULL,
  created_at TEXT NOT NULL,
  UNIQUE (run_id, number)
) STRICT;
CREATE TABLE simulator_value (
  simulator_id INTEGER NOT NULL REFERENCES simulator(id),
  name TEXT NOT NULL,
  value REAL NOT NULL,
  PRIMARY KEY (simulator_id, name)
) STRICT, WITHOUT ROWID;
CREATE TABLE simulator_effect (
  simulator_id INTEGER NOT NULL REFERENCES simulator(id),
  position INTEGER NOT NULL,
  effect TEXT NOT NULL,
  place TEXT NOT NULL,
  PRIMARY KEY (simulator_id, position)
) STRICT, WITHOUT ROWID;
CREATE TABLE simulator_effect_value (
  simulator_id INTEGER NOT NULL,
  position INTEGER NOT NULL,
  name TEXT NOT NULL,
  value REAL NOT NULL,
  PRIMARY KEY (simulator_id, position, name),
  FOREIGN KEY (simulator_id, position) REFERENCES simulator_effect(simulator_id, position)
) STRICT, WITHOUT ROWID;
)";

// L1. What a resumed run goes on with is kept apart from the figures that charts read; traces are large and rarely
// read.
constexpr const char* generations = R"(
CREATE TABLE generation (
  run_id INTEGER NOT NULL REFERENCES run(id),
  number INTEGER NOT NULL CHECK (number >= 1),
  simulator_id INTEGER NOT NULL REFERENCES simulator(id),
  best REAL NOT NULL,
  mean REAL NOT NULL,
  worst REAL NOT NULL,
  trials INTEGER NOT NULL,
  reused INTEGER NOT NULL,
  failed INTEGER NOT NULL,
  seconds REAL NOT NULL,
  finished_at TEXT NOT NULL,
  PRIMARY KEY (run_id, number)
) STRICT, WITHOUT ROWID;
CREATE TABLE learner_state (
  run_id INTEGER NOT NULL,
  number INTEGER NOT NULL,
  random_state TEXT NOT NULL,
  learner_state TEXT NOT NULL,
  PRIMARY KEY (run_id, number),
  FOREIGN KEY (run_id, number) REFERENCES generation(run_id, number)
) STRICT;
CREATE TABLE individual (
  id INTEGER PRIMARY KEY,
  run_id INTEGER NOT NULL,
  generation INTEGER NOT NULL,
  slot INTEGER NOT NULL CHECK (slot >= 0),
  simulator_id INTEGER NOT NULL REFERENCES simulator(id),
  fitness REAL NOT NULL,
  outcome TEXT NOT NULL,
  detail TEXT NOT NULL,
  same_as INTEGER REFERENCES individual(id),
  trial_seed INTEGER NOT NULL,
  trace_sha256 TEXT NOT NULL,
  chromosome TEXT NOT NULL,
  parameters BLOB NOT NULL,
  UNIQUE (run_id, generation, slot),
  FOREIGN KEY (run_id, generation) REFERENCES generation(run_id, number)
) STRICT;
CREATE INDEX individual_by_fitness ON individual(run_id, fitness DESC, generation, slot);
CREATE INDEX individual_simulated ON individual(simulator_id) WHERE same_as IS NULL;
CREATE TABLE trace (
  individual_id INTEGER PRIMARY KEY REFERENCES individual(id),
  packed BLOB NOT NULL
) STRICT;
)";

// Reality. A value is never changed or removed: a correction voids the old one and adds another.
constexpr const char* measurements = R"(
CREATE TABLE measurement_task (
  run_id INTEGER NOT NULL REFERENCES run(id),
  stage INTEGER NOT NULL CHECK (stage >= 1),
  position INTEGER NOT NULL CHECK (position >= 1),
  individual_id INTEGER NOT NULL REFERENCES individual(id),
  simulated_fitness REAL NOT NULL,
  wanted_repeats INTEGER NOT NULL CHECK (wanted_repeats >= 1),
  held_out INTEGER NOT NULL CHECK (held_out IN (0, 1)),
  PRIMARY KEY (run_id, stage, position),
  UNIQUE (run_id, stage, individual_id)
) STRICT, WITHOUT ROWID;
CREATE INDEX measurement_task_by_individual ON measurement_task(individual_id);
CREATE TABLE measurement (
  id INTEGER PRIMARY KEY,
  run_id INTEGER NOT NULL REFERENCES run(id),
  individual_id INTEGER NOT NULL REFERENCES individual(id),
  value REAL NOT NULL CHECK (abs(value) < 9e999),
  is_void INTEGER NOT NULL CHECK (is_void IN (0, 1)),
  note TEXT NOT NULL,
  who TEXT NOT NULL,
  source TEXT NOT NULL CHECK (source IN ('person', 'stand_in')),
  entered_at TEXT NOT NULL
) STRICT;
CREATE INDEX measurement_by_run ON measurement(run_id, individual_id);
)";

// L3: its candidates generation by generation, and the gap before and after each new simulator version.
constexpr const char* adaptations = R"(
CREATE TABLE adaptation (
  run_id INTEGER NOT NULL REFERENCES run(id),
  stage INTEGER NOT NULL CHECK (stage >= 1),
  number INTEGER NOT NULL CHECK (number >= 1),
  best_error REAL NOT NULL,
  mean_error REAL NOT NULL,
  random_state TEXT NOT NULL,
  learner_state TEXT NOT NULL,
  PRIMARY KEY (run_id, stage, number)
) STRICT;
CREATE TABLE adaptation_candidate (
  run_id INTEGER NOT NULL,
  stage INTEGER NOT NULL,
  number INTEGER NOT NULL,
  slot INTEGER NOT NULL,
  error REAL NOT NULL,
  chromosome TEXT NOT NULL,
  parameters BLOB NOT NULL,
  PRIMARY KEY (run_id, stage, number, slot),
  FOREIGN KEY (run_id, stage, number) REFERENCES adaptation(run_id, stage, number)
) STRICT, WITHOUT ROWID;
CREATE TABLE gap (
  run_id INTEGER NOT NULL REFERENCES run(id),
  stage INTEGER NOT NULL CHECK (stage >= 1),
  simulator_before INTEGER NOT NULL REFERENCES simulator(id),
  simulator_after INTEGER NOT NULL REFERENCES simulator(id),
  before REAL NOT NULL,
  after REAL NOT NULL,
  held_out_before REAL,
  held_out_after REAL,
  new_before REAL NOT NULL,
  new_after REAL NOT NULL,
  standard_error REAL NOT NULL,
  individuals INTEGER NOT NULL,
  PRIMARY KEY (run_id, stage)
) STRICT, WITHOUT ROWID;
)";

// Recordings keep the bytes of their file; these may be large and stand apart from what lists show.
constexpr const char* recordings = R"(
CREATE TABLE recording (
  id INTEGER PRIMARY KEY,
  experiment_id INTEGER NOT NULL REFERENCES experiment(id),
  individual_id INTEGER REFERENCES individual(id),
  name TEXT NOT NULL,
  sha256 TEXT NOT NULL,
  mapping_json TEXT NOT NULL,
  source TEXT NOT NULL,
  added_at TEXT NOT NULL
) STRICT;
CREATE INDEX recording_by_experiment ON recording(experiment_id);
CREATE TABLE recording_data (
  recording_id INTEGER PRIMARY KEY REFERENCES recording(id),
  csv BLOB NOT NULL
) STRICT;
)";

// What was found is kept.
void guard(SQLite::Database& database) {
  const auto trigger = [&](const std::string& table, const std::string& event, const std::string& when) {
    keep(database, table, event, when);
  };
  for (const char* table : {"stored_file", "run", "run_file", "simulator", "simulator_value", "simulator_effect",
                            "simulator_effect_value", "generation", "learner_state", "trace", "measurement_task",
                            "adaptation", "adaptation_candidate", "gap", "recording", "recording_data"}) {
    trigger(table, "UPDATE", "");
    trigger(table, "DELETE", "");
  }
  for (const char* table : {"experiment", "run_state", "individual", "measurement"}) trigger(table, "DELETE", "");
  trigger("experiment", "UPDATE OF id, name, spec_json, created_at", "");
  trigger("measurement", "UPDATE OF id, run_id, individual_id, value, who, source, entered_at", "");
  // A trace may be added later, then its hash stays.
  trigger(
      "individual", "UPDATE",
      "WHEN old.trace_sha256 <> '' OR (old.id, old.run_id, old.generation, old.slot, old.simulator_id, old.fitness, "
      "old.outcome, old.detail, old.same_as, old.trial_seed, old.chromosome, old.parameters) IS NOT (new.id, "
      "new.run_id, new.generation, new.slot, new.simulator_id, new.fitness, new.outcome, new.detail, new.same_as, "
      "new.trial_seed, new.chromosome, new.parameters)");
}

void firstSchema(SQLite::Database& database) {
  for (const char* tables : {experimentsAndRuns, simulators, generations, measurements, adaptations, recordings})
    database.exec(tables);
  guard(database);
}

constexpr std::array steps{
    Migration{"the first schema: everything that a Back-to-Reality run is resumed, shown and replayed from",
              firstSchema},
    Migration{"policies of L2, and how its learner goes on", learningInReality},
    Migration{"grids of experiments whose runs are learned together", gridsOfExperiments},
    Migration{"why individuals are measured, how sure the held-out gap is, and that a person ended L2",
              reasonsForMeasuring},
    Migration{"from which measured values the errors of a generation of L3 come", evidenceOfAdaptations},
    Migration{"simulator versions of rigs: scenes that no run belongs to", simulatorsOfRigs},
    Migration{"rows that take less room: bits, hashes, parameters, recordings, files, learners' states", packedRows},
    Migration{"real fitness comes from plugins of any name", realitiesOfAnyName},
};

/// Foreign keys are not enforced while this lives; afterwards they are as they were.
class ForeignKeysLater {
 public:
  explicit ForeignKeysLater(SQLite::Database& database)
      : database_(database), were_(database.execAndGet("PRAGMA foreign_keys").getInt() != 0) {
    database.exec("PRAGMA foreign_keys = OFF");
  }
  ~ForeignKeysLater() {
    if (were_) database_.tryExec("PRAGMA foreign_keys = ON");
  }
  ForeignKeysLater(const ForeignKeysLater&) = delete;
  ForeignKeysLater& operator=(const ForeignKeysLater&) = delete;

 private:
  SQLite::Database& database_;
  const bool were_;
};

}  // namespace

std::span<const Migration> migrations() { return steps; }

void migrate(SQLite::Database& database, std::span<const Migration> toDo) {
  // Tables are made anew by a step, and are referred to meanwhile. The pragma does nothing inside a transaction.
  const ForeignKeysLater later(database);
  // The version is read under the lock: another process may have migrated while we waited for it.
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  const auto version = static_cast<std::size_t>(database.execAndGet("PRAGMA user_version").getInt());
  if (version >= toDo.size()) return;
  for (std::size_t number = version + 1; number <= toDo.size(); ++number) {
    toDo[number - 1].apply(database);
    database.exec("PRAGMA user_version = " + std::to_string(number));
  }
  database.exec("PRAGMA application_id = " + std::to_string(applicationId));
  SQLite::Statement dangling(database, "PRAGMA foreign_key_check");
  if (dangling.executeStep())
    throw SQLite::Exception("rows of " + dangling.getColumn(0).getString() + " refer to rows that are missing",
                            SQLITE_CORRUPT);
  transaction.commit();
}

}  // namespace btr
