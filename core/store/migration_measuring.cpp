#include <SQLiteCpp/Database.h>

#include "core/store/migration_steps.h"

namespace btr {

// Why each individual is measured: its place among the best, or how far candidate simulators disagree about it (0 and
// nothing for tasks that were stored before). The gap on held-out individuals gets its error and count. L2 may have
// been ended by a person.
void reasonsForMeasuring(SQLite::Database& database) {
  database.exec(R"(
ALTER TABLE measurement_task ADD COLUMN rank INTEGER NOT NULL DEFAULT 0 CHECK (rank >= 0);
ALTER TABLE measurement_task ADD COLUMN disagreement REAL CHECK (disagreement >= 0);
ALTER TABLE measurement_task ADD COLUMN candidates INTEGER NOT NULL DEFAULT 0 CHECK (candidates >= 0);
ALTER TABLE gap ADD COLUMN held_out_standard_error REAL NOT NULL DEFAULT 0;
ALTER TABLE gap ADD COLUMN held_out_individuals INTEGER NOT NULL DEFAULT 0;
CREATE TABLE reality_end (
  run_id INTEGER NOT NULL REFERENCES run(id),
  stage INTEGER NOT NULL CHECK (stage >= 1),
  who TEXT NOT NULL,
  asked_at TEXT NOT NULL,
  PRIMARY KEY (run_id, stage)
) STRICT;
)");
  for (const char* event : {"UPDATE", "DELETE"}) keep(database, "reality_end", event, "");
}

// A value may be corrected in the middle of L3: errors of other values are not to be compared.
void evidenceOfAdaptations(SQLite::Database& database) {
  database.exec("ALTER TABLE adaptation ADD COLUMN evidence_sha256 TEXT NOT NULL DEFAULT ''");
}

}  // namespace btr
