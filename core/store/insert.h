#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/store/connection.h"
#include "core/store/database.h"
#include "core/store/packing.h"

// What the subjects of core/store share when they store something. All run within Connection::write.
namespace btr {

/// Runs an INSERT and returns the id of the new row.
template <class... Values>
Id insert(const Connection& connection, const char* sql, const Values&... values) {
  Query(connection, sql).run(values...);
  return *Query(connection, "SELECT last_insert_rowid()").value<Id>();
}

/// "PATH: run 17 is not in the database".
[[noreturn]] void refuseUnknown(const Connection& connection, const std::string& what, Id id);
/// Refuses an id that the table does not have.
void requireRow(const Connection& connection, const std::string& table, Id id);
/// Refuses an id that the table does not have among the rows of this run.
void requireRowOfRun(const Connection& connection, const std::string& table, Id run, Id id);
/// The run's completed stages and generations; refuses an unknown run.
struct RunCounters {
  int stage = 0;
  int generation = 0;
};
RunCounters countersOf(const Connection& connection, Id run);

/// The time that was given, or now.
inline std::string orNow(const std::string& time) { return time.empty() ? utcNow() : time; }

/// The version and its numbers; its number is the next of its run.
Id insertSimulator(const Connection& connection, const SimulatorRecord& simulator);

Id insertExperiment(const Connection& connection, const ExperimentRecord& experiment);
/// A run with its files and first simulator version; its id.
Id insertRun(const Connection& connection, const RunRecord& run, const SimulatorRecord& first);
/// The next generation of its run with its individuals; refuses another number. Ids are written back.
void insertGeneration(const Connection& connection, GenerationRecord& generation);

/// Writes rows of the table of individuals.
class IndividualRow {
 public:
  explicit IndividualRow(const Connection& connection);
  Id insert(const IndividualRecord& individual);  ///< returns the new row's id

 private:
  Query insert_, id_;
  GenesOfRuns genes_;
};

/// Reads them: "SELECT … FROM individual " with what follows in `rest`.
class Individuals {
 public:
  template <class... Values>
  Individuals(const Connection& connection, const std::string& rest, const Values&... values)
      : connection_(connection), row_(connection, (columns + rest).c_str(), values...), genes_(connection) {}
  std::optional<IndividualRecord> next();
  std::vector<IndividualRecord> all();

 private:
  static const std::string columns;
  const Connection& connection_;
  Query row_;
  GenesOfRuns genes_;
};

}  // namespace btr
