#include <SQLiteCpp/Database.h>

#include "core/store/migration_steps.h"

namespace btr {

// A cell's run is an ordinary run; what makes it a cell stands here.
void gridsOfExperiments(SQLite::Database& database) {
  database.exec(R"(
CREATE TABLE grid (
  id INTEGER PRIMARY KEY,
  experiment_id INTEGER NOT NULL REFERENCES experiment(id),
  name TEXT NOT NULL,
  method TEXT NOT NULL CHECK (method IN ('independent', 'contamination', 'similarity')),
  seed INTEGER NOT NULL,
  spec_json TEXT NOT NULL,
  spec_sha256 TEXT NOT NULL,
  created_at TEXT NOT NULL,
  UNIQUE (spec_sha256, method, seed)
) STRICT;
CREATE TABLE grid_cell (
  grid_id INTEGER NOT NULL REFERENCES grid(id),
  number INTEGER NOT NULL CHECK (number >= 1),
  distance_m REAL NOT NULL,
  bearing_rad REAL NOT NULL,
  direction_rad REAL NOT NULL,
  mirror_of INTEGER,
  PRIMARY KEY (grid_id, number),
  FOREIGN KEY (grid_id, mirror_of) REFERENCES grid_cell(grid_id, number)
) STRICT, WITHOUT ROWID;
CREATE TABLE grid_run (
  grid_id INTEGER NOT NULL,
  cell INTEGER NOT NULL,
  run_id INTEGER NOT NULL UNIQUE REFERENCES run(id),
  begun_at INTEGER,
  begun_at_individual INTEGER REFERENCES individual(id),
  PRIMARY KEY (grid_id, cell),
  FOREIGN KEY (grid_id, cell) REFERENCES grid_cell(grid_id, number),
  FOREIGN KEY (grid_id, begun_at) REFERENCES grid_cell(grid_id, number)
) STRICT, WITHOUT ROWID;
CREATE TABLE grid_best (
  grid_id INTEGER NOT NULL,
  cell INTEGER NOT NULL,
  generation INTEGER NOT NULL CHECK (generation >= 1),
  individual_id INTEGER NOT NULL REFERENCES individual(id),
  similarity REAL NOT NULL,
  PRIMARY KEY (grid_id, cell, generation),
  FOREIGN KEY (grid_id, cell) REFERENCES grid_run(grid_id, cell)
) STRICT, WITHOUT ROWID;
CREATE TABLE grid_solution (
  grid_id INTEGER NOT NULL,
  cell INTEGER NOT NULL,
  individual_id INTEGER NOT NULL REFERENCES individual(id),
  own_individual_id INTEGER REFERENCES individual(id),
  failed INTEGER NOT NULL CHECK (failed IN (0, 1)),
  taken_from INTEGER,
  taken_individual_id INTEGER REFERENCES individual(id),
  PRIMARY KEY (grid_id, cell),
  FOREIGN KEY (grid_id, cell) REFERENCES grid_run(grid_id, cell),
  FOREIGN KEY (grid_id, taken_from) REFERENCES grid_cell(grid_id, number)
) STRICT, WITHOUT ROWID;
CREATE TABLE grid_point (
  grid_id INTEGER NOT NULL REFERENCES grid(id),
  number INTEGER NOT NULL CHECK (number >= 1),
  distance_m REAL NOT NULL,
  bearing_rad REAL NOT NULL,
  direction_rad REAL NOT NULL,
  fitness REAL NOT NULL,
  outcome TEXT NOT NULL,
  figures_json TEXT NOT NULL,
  parameters BLOB NOT NULL,
  PRIMARY KEY (grid_id, number)
) STRICT, WITHOUT ROWID;
)");
  for (const char* table : {"grid", "grid_cell", "grid_run", "grid_best", "grid_solution", "grid_point"})
    for (const char* event : {"UPDATE", "DELETE"}) keep(database, table, event, "");
}

}  // namespace btr
