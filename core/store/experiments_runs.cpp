#include "core/spec/error.h"
#include "core/spec/utf8.h"
#include "core/store/connection.h"
#include "core/store/database.h"
#include "core/store/insert.h"

namespace btr {
namespace {

constexpr const char* experimentColumns = "SELECT id, name, spec_json, created_at, note FROM experiment ";

ExperimentRecord experimentOf(const Query& row) {
  ExperimentRecord e;
  row.get(e.id, e.name, e.specJson, e.createdAt, e.note);
  return e;
}

constexpr const char* runColumns =
    "SELECT id, experiment_id, seed, spec_json, spec_sha256, scene_json, state, stage, generation, reality, "
    "program_version, started_at, updated_at, note, message, progress_json, stop_requested "
    "FROM run JOIN run_state ON run_id = id ";

RunRecord runOf(const Query& row) {
  RunRecord r;
  std::string state;
  row.get(r.id, r.experiment, r.seed, r.specJson, r.specSha256, r.sceneJson, state, r.stage, r.generation, r.reality,
          r.programVersion, r.startedAt, r.updatedAt, r.note, r.message, r.progressJson, r.stopRequested);
  r.state = runStateFromText(state);
  return r;
}

std::string sql(const char* columns, const char* rest) { return std::string(columns) + rest; }

// Runs an UPDATE of one row of run_state; a row that is not there is an error.
template <class... Values>
void update(const Connection& connection, Id run, const char* assignments, const Values&... values) {
  connection.write([&] {
    Query change(connection,
                 ("UPDATE run_state SET updated_at = ?1, " + std::string(assignments) + " WHERE run_id = ?2").c_str());
    if (change.run(utcNow(), run, values...) == 0) refuseUnknown(connection, "run", run);
  });
}

}  // namespace

Id insertExperiment(const Connection& connection, const ExperimentRecord& e) {
  return insert(connection, "INSERT INTO experiment (name, spec_json, created_at, note) VALUES (?, ?, ?, ?)", e.name,
                e.specJson, orNow(e.createdAt), e.note);
}

Id Database::addExperiment(const ExperimentRecord& e) {
  return connection_->write([&] { return insertExperiment(*connection_, e); });
}

std::vector<ExperimentRecord> Database::experiments() const {
  return connection_->read([&] {
    std::vector<ExperimentRecord> all;
    for (Query row(*connection_, sql(experimentColumns, "ORDER BY id").c_str()); row.next();)
      all.push_back(experimentOf(row));
    return all;
  });
}

std::optional<Id> Database::findExperiment(const std::string& specJson) const {
  return connection_->read([&] {
    return Query(*connection_, "SELECT id FROM experiment WHERE spec_json = ? ORDER BY id DESC LIMIT 1", specJson)
        .value<Id>();
  });
}

ExperimentRecord Database::experiment(Id id) const {
  return connection_->read([&] {
    Query row(*connection_, sql(experimentColumns, "WHERE id = ?").c_str(), id);
    if (!row.next()) refuseUnknown(*connection_, "experiment", id);
    return experimentOf(row);
  });
}

void Database::setExperimentNote(Id id, const std::string& note) {
  connection_->write([&] {
    if (Query(*connection_, "UPDATE experiment SET note = ? WHERE id = ?").run(note, id) == 0)
      refuseUnknown(*connection_, "experiment", id);
  });
}

Id insertRun(const Connection& connection, const RunRecord& r, const SimulatorRecord& first) {
  requireRow(connection, "experiment", r.experiment);
  requireUtf8(r.reality, connection.path() + " run's reality");
  if (r.reality.empty())
    throw InputError(connection.path() + " run's reality", "no name", "that of who enters fitness");
  const std::string startedAt = orNow(r.startedAt);
  const Id run = insert(connection,
                        "INSERT INTO run (experiment_id, seed, spec_json, spec_sha256, scene_json, reality, "
                        "program_version, started_at) VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                        r.experiment, r.seed, r.specJson, r.specSha256, r.sceneJson, r.reality,
                        r.programVersion.empty() ? programVersion() : r.programVersion, startedAt);
  insert(connection,
         "INSERT INTO run_state (run_id, state, stage, generation, stop_requested, updated_at, message, progress_json, "
         "note) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
         run, toText(r.state), r.stage, r.generation, r.stopRequested, r.updatedAt.empty() ? startedAt : r.updatedAt,
         r.message, r.progressJson, r.note);
  if (!r.genes.empty()) {
    std::vector<double> minimum, maximum, whole;
    for (const GeneBounds& gene : r.genes) {
      minimum.push_back(gene.minimum);
      maximum.push_back(gene.maximum);
      whole.push_back(gene.whole ? 1 : 0);
    }
    Query(connection, "INSERT INTO run_genes (run_id, minimum, maximum, whole) VALUES (?, ?, ?, ?)")
        .run(run, minimum, maximum, whole);
  }
  // A file's content is stored once, however many runs use it.
  Query content(connection, "INSERT OR IGNORE INTO stored_file (sha256, size_bytes, content) VALUES (?, ?, ?)");
  Query file(connection, "INSERT INTO run_file (run_id, position, name, sha256) VALUES (?, ?, ?, ?)");
  int position = 0;
  for (const StoredFile& f : r.files) {
    const std::string hash = sha256(f.content);
    if (!f.sha256.empty() && f.sha256 != hash)
      throw InputError(connection.path() + " file " + f.name, "the hash " + f.sha256, "that of its content, " + hash);
    content.run(hash, static_cast<std::int64_t>(f.content.size()), Blob{deflated(f.content)});
    file.run(run, position++, f.name, hash);
  }
  SimulatorRecord start = first;
  start.run = run;
  if (start.madeBy.empty()) start.madeBy = "start";
  insertSimulator(connection, start);
  return run;
}

Id Database::addRun(const RunRecord& run, const SimulatorRecord& first) {
  return connection_->write([&] { return insertRun(*connection_, run, first); });
}

Id Database::addRun(const ExperimentRecord& experiment, RunRecord run, const SimulatorRecord& first) {
  return connection_->write([&] {
    run.experiment = insertExperiment(*connection_, experiment);
    return insertRun(*connection_, run, first);
  });
}

std::vector<RunRecord> Database::runs(Id experiment) const {
  return connection_->read([&] {
    std::vector<RunRecord> all;
    const char* rest = experiment == 0 ? "ORDER BY id" : "WHERE experiment_id = ?1 ORDER BY id";
    Query row(*connection_, sql(runColumns, rest).c_str());
    if (experiment != 0) row.bindAll(experiment);
    while (row.next()) all.push_back(runOf(row));
    return all;
  });
}

RunRecord Database::run(Id id) const {
  return connection_->read([&] {
    Query row(*connection_, sql(runColumns, "WHERE id = ?").c_str(), id);
    if (!row.next()) refuseUnknown(*connection_, "run", id);
    RunRecord r = runOf(row);
    r.genes = GenesOfRuns(*connection_).of(id);
    Query file(*connection_,
               "SELECT name, sha256, size_bytes, content FROM run_file JOIN stored_file USING (sha256) WHERE run_id = "
               "? ORDER BY position",
               id);
    while (file.next()) {
      StoredFile& f = r.files.emplace_back();
      std::int64_t size = 0;
      std::string packed;
      file.get(f.name, f.sha256, size, packed);
      f.content = connection_->unpacked([&] { return inflated(packed, size); });
      if (sha256(f.content) != f.sha256) connection_->refuse("is damaged: the stored file " + f.name + " has changed");
    }
    return r;
  });
}

std::optional<Id> Database::findRun(const std::string& specSha256, std::uint64_t seed) const {
  return connection_->read([&] {
    return Query(*connection_,
                 "SELECT id FROM run WHERE spec_sha256 = ? AND seed = ? AND id NOT IN (SELECT run_id FROM grid_run) "
                 "ORDER BY id DESC LIMIT 1",
                 specSha256, seed)
        .value<Id>();
  });
}

std::optional<Id> Database::latestRun() const {
  return connection_->read(
      [&] { return Query(*connection_, "SELECT id FROM run ORDER BY id DESC LIMIT 1").value<Id>(); });
}

void Database::setRunState(Id run, RunState state, const std::string& message) {
  update(*connection_, run, "state = ?3, message = ?4", toText(state), message);
}
void Database::setRunNote(Id run, const std::string& note) { update(*connection_, run, "note = ?3", note); }
void Database::setProgress(Id run, const std::string& json) { update(*connection_, run, "progress_json = ?3", json); }
void Database::requestStop(Id run, bool stop) { update(*connection_, run, "stop_requested = ?3", stop); }

}  // namespace btr
