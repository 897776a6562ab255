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

}  // namespace btr
