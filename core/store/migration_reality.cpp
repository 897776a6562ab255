#include <SQLiteCpp/Database.h>

#include "core/store/migration_steps.h"

namespace btr {

void keep(SQLite::Database& database, const std::string& table, const std::string& event, const std::string& when) {
  const std::string name = table + "_keeps_" + event.substr(0, 6);
  database.exec("CREATE TRIGGER \"" + name + "\" BEFORE " + event + " ON " + table + " " + when +
                " BEGIN SELECT RAISE(ABORT, 'rows of " + table + " are kept as they were stored'); END");
}

// L2: policies are individuals that no generation bred, and tasks of the stage that they belong to.
void learningInReality(SQLite::Database& database) {
  database.exec(R"(
ALTER TABLE individual ADD COLUMN iteration INTEGER NOT NULL DEFAULT 0 CHECK (iteration >= 0);
ALTER TABLE measurement_task ADD COLUMN iteration INTEGER NOT NULL DEFAULT 0 CHECK (iteration >= 0);
CREATE TABLE reality_begun (
  run_id INTEGER NOT NULL REFERENCES run(id),
  stage INTEGER NOT NULL CHECK (stage >= 1),
  number INTEGER NOT NULL CHECK (number >= 1),
  centre_before BLOB NOT NULL,
  random_state TEXT NOT NULL,
  learner_state TEXT NOT NULL,
  PRIMARY KEY (run_id, stage, number)
) STRICT;
CREATE TABLE reality_policy (
  run_id INTEGER NOT NULL,
  stage INTEGER NOT NULL,
  number INTEGER NOT NULL,
  slot INTEGER NOT NULL CHECK (slot >= 0),
  individual_id INTEGER NOT NULL REFERENCES individual(id),
  PRIMARY KEY (run_id, stage, number, slot),
  FOREIGN KEY (run_id, stage, number) REFERENCES reality_begun(run_id, stage, number)
) STRICT, WITHOUT ROWID;
CREATE TABLE reality_iteration (
  run_id INTEGER NOT NULL,
  stage INTEGER NOT NULL,
  number INTEGER NOT NULL,
  centre_after BLOB NOT NULL,
  random_state TEXT NOT NULL,
  learner_state TEXT NOT NULL,
  finished_at TEXT NOT NULL,
  PRIMARY KEY (run_id, stage, number),
  FOREIGN KEY (run_id, stage, number) REFERENCES reality_begun(run_id, stage, number)
) STRICT;
CREATE TABLE reality_result (
  run_id INTEGER NOT NULL,
  stage INTEGER NOT NULL,
  number INTEGER NOT NULL,
  slot INTEGER NOT NULL,
  fitness REAL,
  standard_error REAL NOT NULL,
  count INTEGER NOT NULL,
  PRIMARY KEY (run_id, stage, number, slot),
  FOREIGN KEY (run_id, stage, number) REFERENCES reality_iteration(run_id, stage, number),
  FOREIGN KEY (run_id, stage, number, slot) REFERENCES reality_policy(run_id, stage, number, slot)
) STRICT, WITHOUT ROWID;
)");
  for (const char* table : {"reality_begun", "reality_policy", "reality_iteration", "reality_result"})
    for (const char* event : {"UPDATE", "DELETE"}) keep(database, table, event, "");
  // The guard of individuals names their columns: it must know the new one too.
  database.exec("DROP TRIGGER individual_keeps_UPDATE");
  keep(database, "individual", "UPDATE",
       "WHEN old.trace_sha256 <> '' OR (old.id, old.run_id, old.generation, old.slot, old.simulator_id, old.fitness, "
       "old.outcome, old.detail, old.same_as, old.trial_seed, old.chromosome, old.parameters, old.iteration) IS NOT "
       "(new.id, new.run_id, new.generation, new.slot, new.simulator_id, new.fitness, new.outcome, new.detail, "
       "new.same_as, new.trial_seed, new.chromosome, new.parameters, new.iteration)");
}

}  // namespace btr
