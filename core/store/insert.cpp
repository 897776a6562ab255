#include "core/store/insert.h"

#include <cmath>

#include "core/spec/error.h"

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

const std::string Individuals::columns =
    "SELECT id, run_id, generation, slot, simulator_id, chromosome, parameters, fitness, outcome, detail, same_as, "
    "trial_seed, trace_sha256, iteration FROM individual ";

std::optional<IndividualRecord> Individuals::next() {
  if (!row_.next()) return std::nullopt;
  IndividualRecord i;
  Cell chromosome, parameters, hash;
  row_.get(i.id, i.run, i.generation, i.slot, i.simulator, chromosome, parameters, i.fitness, i.outcome, i.detail,
           i.sameAs, i.trialSeed, hash, i.iteration);
  try {
    i.chromosome = bitsOf(chromosome);
    // Bounds of genes are read only where something follows from them.
    static const std::vector<GeneBounds> none;
    const bool needsGenes = parameters.type == Cell::Type::integer;
    i.parameters = parametersOf(parameters, i.chromosome, needsGenes ? genes_.of(i.run) : none);
  } catch (const InputError& error) {
    connection_.refuse("individual " + std::to_string(i.id) + ": " + error.what());
  }
  i.traceSha256 = hashOf(hash);
  return i;
}

std::vector<IndividualRecord> Individuals::all() {
  std::vector<IndividualRecord> list;
  while (std::optional<IndividualRecord> individual = next()) list.push_back(std::move(*individual));
  return list;
}

IndividualRow::IndividualRow(const Connection& connection)
    : insert_(connection,
              "INSERT INTO individual (run_id, generation, slot, simulator_id, chromosome, parameters, fitness, "
              "outcome, detail, same_as, trial_seed, trace_sha256, iteration) "
              "VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      id_(connection, "SELECT last_insert_rowid()"),
      genes_(connection) {}

Id IndividualRow::insert(const IndividualRecord& i) {
  for (const double parameter : i.parameters)
    if (std::isnan(parameter)) genes_.connection().refuse("a parameter is NaN; NaN cannot be stored");
  insert_.run(i.run, i.generation, i.slot, i.simulator, packedBits(i.chromosome),
              packedParameters(i.parameters, i.chromosome, genes_.of(i.run)), i.fitness, i.outcome, i.detail,
              Reference{i.sameAs}, i.trialSeed, packedHash(i.traceSha256), i.iteration);
  const Id id = *id_.value<Id>();
  id_.reset();
  return id;
}

}  // namespace btr
