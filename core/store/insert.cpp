#include "core/store/insert.h"

namespace btr {

void refuseUnknown(const Connection& connection, const std::string& what, Id id) {
  connection.refuse(what + " " + std::to_string(id) + " is not in the database");
}

void requireRow(const Connection& connection, const std::string& table, Id id) {
  if (!Query(connection, ("SELECT 1 FROM " + table + " WHERE id = ?").c_str(), id).next())
    refuseUnknown(connection, table, id);
}

void requireRowOfRun(const Connection& connection, const std::string& table, Id run, Id id) {
  Query row(connection, ("SELECT run_id FROM " + table + " WHERE id = ?").c_str(), id);
  const std::optional<Id> owner = row.value<Id>();
  if (!owner) refuseUnknown(connection, table, id);
  if (*owner != run)
    connection.refuse(table + " " + std::to_string(id) + " belongs to run " + std::to_string(*owner) + ", not to run " +
                      std::to_string(run));
}

RunCounters countersOf(const Connection& connection, Id run) {
  Query row(connection, "SELECT stage, generation FROM run_state WHERE run_id = ?", run);
  if (!row.next()) refuseUnknown(connection, "run", run);
  RunCounters counters;
  row.get(counters.stage, counters.generation);
  return counters;
}

const char* const IndividualRow::select =
    "SELECT id, run_id, generation, slot, simulator_id, chromosome, parameters, fitness, outcome, detail, same_as, "
    "trial_seed, trace_sha256, iteration FROM individual ";

IndividualRecord IndividualRow::read(const Query& row) {
  IndividualRecord i;
  row.get(i.id, i.run, i.generation, i.slot, i.simulator, i.chromosome, i.parameters, i.fitness, i.outcome, i.detail,
          i.sameAs, i.trialSeed, i.traceSha256, i.iteration);
  return i;
}

IndividualRow::IndividualRow(const Connection& connection)
    : insert_(connection,
              "INSERT INTO individual (run_id, generation, slot, simulator_id, chromosome, parameters, fitness, "
              "outcome, detail, same_as, trial_seed, trace_sha256, iteration) "
              "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      id_(connection, "SELECT last_insert_rowid()") {}

Id IndividualRow::insert(const IndividualRecord& i) {
  insert_.run(i.run, i.generation, i.slot, i.simulator, i.chromosome, i.parameters, i.fitness, i.outcome, i.detail,
              Reference{i.sameAs}, i.trialSeed, i.traceSha256, i.iteration);
  const Id id = *id_.value<Id>();
  id_.reset();
  return id;
}

}  // namespace btr
