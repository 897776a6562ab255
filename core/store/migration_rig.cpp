#include <SQLiteCpp/Database.h>

#include "core/store/migration_steps.h"

namespace btr {

// A rig is a row of experiment that has no runs; its simulator versions stand here, whole, as their file has them.
void simulatorsOfRigs(SQLite::Database& database) {
  database.exec(R"(
CREATE TABLE rig_simulator (
  id INTEGER PRIMARY KEY,
  experiment_id INTEGER NOT NULL REFERENCES experiment(id),
  number INTEGER NOT NULL CHECK (number >= 0),
  parent_id INTEGER REFERENCES rig_simulator(id),
  simulator_json TEXT NOT NULL,
  made_by TEXT NOT NULL,
  evidence TEXT NOT NULL,
  created_at TEXT NOT NULL,
  UNIQUE (experiment_id, number)
) STRICT;
)");
  for (const char* event : {"UPDATE", "DELETE"}) keep(database, "rig_simulator", event, "");
}

}  // namespace btr
