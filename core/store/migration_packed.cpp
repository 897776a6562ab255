// Rows that take less room: bits as bits, hashes as bytes, parameters that follow from their chromosome left out, texts
// and tables compressed, and of the states of learners only the latest. Tables are made anew, filled and renamed, as
// https://www.sqlite.org/lang_altertable.html#otheralter says.
#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Statement.h>
#include <sqlite3.h>

#include <exception>
#include <map>
#include <new>

#include "core/store/gene_bounds.h"
#include "core/store/migration_steps.h"
#include "core/store/packing.h"

namespace btr {
namespace {

using GenesByRun = std::map<std::int64_t, std::vector<GeneBounds>>;

std::string bytesAt(sqlite3_value* value) {
  const void* bytes = sqlite3_value_blob(value);
  return bytes == nullptr ? "" : std::string(static_cast<const char*>(bytes), sqlite3_value_bytes(value));
}

void answer(sqlite3_context* context, const Cell& cell) {
  switch (cell.type) {
    case Cell::Type::null:
      return sqlite3_result_null(context);
    case Cell::Type::integer:
      return sqlite3_result_int64(context, cell.number);
    case Cell::Type::text:
      return sqlite3_result_text64(context, cell.bytes.data(), cell.bytes.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
    case Cell::Type::blob:
      return sqlite3_result_blob64(context, cell.bytes.data(), cell.bytes.size(), SQLITE_TRANSIENT);
  }
}

// SQLite calls these: no exception may leave them.
template <class Work>
void guarded(sqlite3_context* context, const Work& work) {
  try {
    answer(context, work());
  } catch (const std::bad_alloc&) {
    sqlite3_result_error_nomem(context);
  } catch (const std::exception& error) {
    sqlite3_result_error(context, error.what(), -1);
  }
}

void bits(sqlite3_context* context, int, sqlite3_value** values) {
  guarded(context, [&] { return packedBits(bytesAt(values[0])); });
}
void hash(sqlite3_context* context, int, sqlite3_value** values) {
  guarded(context, [&] { return packedHash(bytesAt(values[0])); });
}
void deflate(sqlite3_context* context, int, sqlite3_value** values) {
  guarded(context, [&] { return Cell{Cell::Type::blob, 0, deflated(bytesAt(values[0]))}; });
}
void parameters(sqlite3_context* context, int, sqlite3_value** values) {
  guarded(context, [&] {
    const auto& genes = *static_cast<const GenesByRun*>(sqlite3_user_data(context));
    const auto of = genes.find(sqlite3_value_int64(values[0]));
    const std::string stored = bytesAt(values[2]);
    if (of == genes.end()) return Cell{Cell::Type::blob, 0, stored};
    return packedParameters(doublesOf(stored), bytesAt(values[1]), of->second);
  });
}

/// The functions above under names that SQL knows, as long as this lives.
class Functions {
 public:
  Functions(SQLite::Database& database, GenesByRun& genes) : database_(database) {
    add("packed_bits", 1, nullptr, bits);
    add("packed_hash", 1, nullptr, hash);
    add("packed_bytes", 1, nullptr, deflate);
    add("packed_parameters", 3, &genes, parameters);
  }
  ~Functions() {
    for (const auto& [name, count] : added_)
      sqlite3_create_function_v2(database_.getHandle(), name, count, SQLITE_UTF8, nullptr, nullptr, nullptr, nullptr,
                                 nullptr);
  }
  Functions(const Functions&) = delete;
  Functions& operator=(const Functions&) = delete;

 private:
  void add(const char* name, int count, void* data, void (*function)(sqlite3_context*, int, sqlite3_value**)) {
    database_.check(sqlite3_create_function_v2(database_.getHandle(), name, count, SQLITE_UTF8 | SQLITE_DETERMINISTIC,
                                               data, function, nullptr, nullptr, nullptr));
    added_.emplace_back(name, count);
  }
  SQLite::Database& database_;
  std::vector<std::pair<const char*, int>> added_;
};

GenesByRun findGenes(SQLite::Database& database) {
  std::vector<std::int64_t> runs;
  for (SQLite::Statement run(database, "SELECT id FROM run"); run.executeStep();)
    runs.push_back(run.getColumn(0).getInt64());
  GenesByRun found;
  SQLite::Statement row(database, "SELECT chromosome, parameters FROM individual WHERE run_id = ?");
  for (const std::int64_t run : runs) {
    GeneBoundsFinder finder;
    row.reset();
    row.bind(1, run);
    while (row.executeStep()) finder.show(row.getColumn(0).getString(), doublesOf(row.getColumn(1).getString()));
    if (std::vector<GeneBounds> genes = finder.bounds(); !genes.empty()) found[run] = std::move(genes);
  }
  row.reset();
  return found;
}

void storeGenes(SQLite::Database& database, const GenesByRun& genes) {
  SQLite::Statement row(database, "INSERT INTO run_genes (run_id, minimum, maximum, whole) VALUES (?, ?, ?, ?)");
  for (const auto& [run, bounds] : genes) {
    std::vector<double> minimum, maximum, whole;
    for (const GeneBounds& gene : bounds) {
      minimum.push_back(gene.minimum);
      maximum.push_back(gene.maximum);
      whole.push_back(gene.whole ? 1 : 0);
    }
    row.reset();
    row.bind(1, run);
    int column = 1;
    for (const auto* numbers : {&minimum, &maximum, &whole}) {
      const std::string bytes = bytesOf(*numbers);
      row.bind(++column, static_cast<const void*>(bytes.data()), static_cast<int>(bytes.size()));
    }
    row.exec();
  }
}

constexpr const char* newTables = R"(
CREATE TABLE run_genes (
  run_id INTEGER PRIMARY KEY REFERENCES run(id),
  minimum BLOB NOT NULL,
  maximum BLOB NOT NULL,
  whole BLOB NOT NULL
) STRICT;
CREATE TABLE new_individual (
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
  trace_sha256 ANY NOT NULL,
  chromosome ANY NOT NULL,
  parameters ANY NOT NULL,
  iteration INTEGER NOT NULL DEFAULT 0 CHECK (iteration >= 0),
  UNIQUE (run_id, generation, slot),
  FOREIGN KEY (run_id, generation) REFERENCES generation(run_id, number)
) STRICT;
CREATE TABLE new_learner_state (
  run_id INTEGER PRIMARY KEY,
  number INTEGER NOT NULL,
  random_state TEXT NOT NULL,
  learner_state TEXT NOT NULL,
  FOREIGN KEY (run_id, number) REFERENCES generation(run_id, number)
) STRICT;
CREATE TABLE adaptation_state (
  run_id INTEGER PRIMARY KEY,
  stage INTEGER NOT NULL,
  number INTEGER NOT NULL,
  random_state TEXT NOT NULL,
  learner_state TEXT NOT NULL,
  FOREIGN KEY (run_id, stage, number) REFERENCES adaptation(run_id, stage, number)
) STRICT;
CREATE TABLE new_adaptation (
  run_id INTEGER NOT NULL REFERENCES run(id),
  stage INTEGER NOT NULL CHECK (stage >= 1),
  number INTEGER NOT NULL CHECK (number >= 1),
  best_error REAL NOT NULL,
  mean_error REAL NOT NULL,
  evidence_sha256 TEXT NOT NULL DEFAULT '',
  PRIMARY KEY (run_id, stage, number)
) STRICT;
CREATE TABLE new_adaptation_candidate (
  run_id INTEGER NOT NULL,
  stage INTEGER NOT NULL,
  number INTEGER NOT NULL,
  slot INTEGER NOT NULL,
  error REAL NOT NULL,
  chromosome ANY NOT NULL,
  parameters BLOB NOT NULL,
  PRIMARY KEY (run_id, stage, number, slot),
  FOREIGN KEY (run_id, stage, number) REFERENCES adaptation(run_id, stage, number)
) STRICT, WITHOUT ROWID;
CREATE TABLE new_recording_data (
  recording_id INTEGER PRIMARY KEY REFERENCES recording(id),
  size_bytes INTEGER NOT NULL CHECK (size_bytes >= 0),
  csv BLOB NOT NULL
) STRICT;
CREATE TABLE new_stored_file (
  sha256 TEXT PRIMARY KEY,
  size_bytes INTEGER NOT NULL CHECK (size_bytes >= 0),
  content BLOB NOT NULL
) STRICT;
)";

constexpr const char* copies = R"(
INSERT INTO new_individual (id, run_id, generation, slot, simulator_id, fitness, outcome, detail, same_as, trial_seed,
    trace_sha256, chromosome, parameters, iteration)
  SELECT id, run_id, generation, slot, simulator_id, fitness, outcome, detail, same_as, trial_seed,
    packed_hash(trace_sha256), packed_bits(chromosome), packed_parameters(run_id, chromosome, parameters), iteration
  FROM individual ORDER BY id;
INSERT INTO new_learner_state (run_id, number, random_state, learner_state)
  SELECT run_id, number, random_state, learner_state FROM learner_state l
  WHERE number = (SELECT max(number) FROM learner_state WHERE run_id = l.run_id);
INSERT INTO adaptation_state (run_id, stage, number, random_state, learner_state)
  SELECT run_id, stage, number, random_state, learner_state FROM adaptation a
  WHERE (stage, number) = (SELECT stage, number FROM adaptation WHERE run_id = a.run_id
                           ORDER BY stage DESC, number DESC LIMIT 1);
INSERT INTO new_adaptation (run_id, stage, number, best_error, mean_error, evidence_sha256)
  SELECT run_id, stage, number, best_error, mean_error, evidence_sha256 FROM adaptation;
INSERT INTO new_adaptation_candidate (run_id, stage, number, slot, error, chromosome, parameters)
  SELECT run_id, stage, number, slot, error, packed_bits(chromosome), parameters FROM adaptation_candidate;
INSERT INTO new_recording_data (recording_id, size_bytes, csv)
  SELECT recording_id, length(csv), packed_bytes(csv) FROM recording_data;
INSERT INTO new_stored_file (sha256, size_bytes, content)
  SELECT sha256, length(content), packed_bytes(content) FROM stored_file;
)";

void replace(SQLite::Database& database, const std::string& table) {
  database.exec("DROP TABLE " + table + "; ALTER TABLE new_" + table + " RENAME TO " + table);
}

}  // namespace

void packedRows(SQLite::Database& database) {
  GenesByRun genes = findGenes(database);
  {
    const Functions functions(database, genes);
    database.exec(newTables);
    storeGenes(database, genes);
    database.exec(copies);
  }
  for (const char* table :
       {"individual", "learner_state", "adaptation", "adaptation_candidate", "recording_data", "stored_file"})
    replace(database, table);
  database.exec(R"(
CREATE INDEX individual_by_fitness ON individual(run_id, fitness DESC, generation, slot);
CREATE INDEX individual_simulated ON individual(simulator_id) WHERE same_as IS NULL;
)");
  for (const char* table : {"adaptation", "adaptation_candidate", "recording_data", "stored_file", "run_genes"})
    for (const char* event : {"UPDATE", "DELETE"}) keep(database, table, event, "");
  for (const char* table : {"individual", "learner_state", "adaptation_state"}) keep(database, table, "DELETE", "");
  keep(database, "individual", "UPDATE",
       "WHEN old.trace_sha256 <> '' OR (old.id, old.run_id, old.generation, old.slot, old.simulator_id, old.fitness, "
       "old.outcome, old.detail, old.same_as, old.trial_seed, old.chromosome, old.parameters, old.iteration) IS NOT "
       "(new.id, new.run_id, new.generation, new.slot, new.simulator_id, new.fitness, new.outcome, new.detail, "
       "new.same_as, new.trial_seed, new.chromosome, new.parameters, new.iteration)");
}

// Real fitness comes from a plugin, and these have any name.
void realitiesOfAnyName(SQLite::Database& database) {
  database.exec(R"(
CREATE TABLE new_run (
  id INTEGER PRIMARY KEY,
  experiment_id INTEGER NOT NULL REFERENCES experiment(id),
  seed INTEGER NOT NULL,
  spec_json TEXT NOT NULL,
  spec_sha256 TEXT NOT NULL,
  scene_json TEXT NOT NULL,
  reality TEXT NOT NULL CHECK (reality <> ''),
  program_version TEXT NOT NULL,
  started_at TEXT NOT NULL
) STRICT;
INSERT INTO new_run (id, experiment_id, seed, spec_json, spec_sha256, scene_json, reality, program_version, started_at)
  SELECT id, experiment_id, seed, spec_json, spec_sha256, scene_json, reality, program_version, started_at FROM run;
CREATE TABLE new_measurement (
  id INTEGER PRIMARY KEY,
  run_id INTEGER NOT NULL REFERENCES run(id),
  individual_id INTEGER NOT NULL REFERENCES individual(id),
  value REAL NOT NULL CHECK (abs(value) < 9e999),
  is_void INTEGER NOT NULL CHECK (is_void IN (0, 1)),
  note TEXT NOT NULL,
  who TEXT NOT NULL,
  source TEXT NOT NULL CHECK (source <> ''),
  entered_at TEXT NOT NULL
) STRICT;
INSERT INTO new_measurement (id, run_id, individual_id, value, is_void, note, who, source, entered_at)
  SELECT id, run_id, individual_id, value, is_void, note, who, source, entered_at FROM measurement;
)");
  for (const char* table : {"run", "measurement"}) replace(database, table);
  database.exec(R"(
CREATE INDEX run_by_spec ON run(spec_sha256, seed);
CREATE INDEX run_by_experiment ON run(experiment_id);
CREATE INDEX measurement_by_run ON measurement(run_id, individual_id);
)");
  keep(database, "run", "UPDATE", "");
  for (const char* table : {"run", "measurement"}) keep(database, table, "DELETE", "");
  keep(database, "measurement", "UPDATE OF id, run_id, individual_id, value, who, source, entered_at", "");
}

}  // namespace btr
