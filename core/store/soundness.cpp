#include "core/store/soundness.h"

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace btr {
namespace {

constexpr std::int64_t samples = 64;  // of each large table

struct LargeTable {
  const char* name;
  const char* key;  ///< a whole number that its rows stand in order of
};
constexpr std::array largeTables{LargeTable{"individual", "id"}, LargeTable{"trace", "individual_id"},
                                 LargeTable{"recording_data", "recording_id"}, LargeTable{"stored_file", "rowid"},
                                 LargeTable{"adaptation_candidate", "run_id"}};

// The last line says it; those before name the part of the file.
std::string quickCheck(SQLite::Database& database, const std::string& table) {
  SQLite::Statement check(database, table.empty() ? "PRAGMA quick_check(1)" : "PRAGMA quick_check('" + table + "')");
  const std::string finding = check.executeStep() ? check.getColumn(0).getString() : "no answer";
  return finding == "ok" ? "" : finding.substr(finding.rfind('\n') + 1);
}

std::vector<std::string> smallTables(SQLite::Database& database) {
  std::vector<std::string> names;
  SQLite::Statement row(database, "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT LIKE 'sqlite_%'");
  while (row.executeStep()) {
    const std::string name = row.getColumn(0).getString();
    const auto isLarge = [&name](const LargeTable& large) { return name == large.name; };
    if (std::find_if(largeTables.begin(), largeTables.end(), isLarge) == largeTables.end()) names.push_back(name);
  }
  return names;
}

// A row in every part of the table, with all of its columns, read through the pages that lead there. SQLite itself
// says what it cannot read.
void readSamples(SQLite::Database& database, const LargeTable& table) {
  const std::string key = table.key, from = std::string(" FROM ") + table.name;
  SQLite::Statement ends(database,
                         "SELECT (SELECT min(" + key + ")" + from + "), (SELECT max(" + key + ")" + from + ")");
  if (!ends.executeStep() || ends.getColumn(0).isNull()) return;
  const std::int64_t first = ends.getColumn(0).getInt64(), last = ends.getColumn(1).getInt64();
  const std::int64_t count = std::min(samples, last - first + 1);
  SQLite::Statement row(database, "SELECT *" + from + " WHERE " + key + " >= ? ORDER BY " + key + " LIMIT 1");
  for (std::int64_t k = 0; k < count; ++k) {
    row.bind(1, count == 1 ? first : first + (last - first) / (count - 1) * k);
    if (row.executeStep())
      for (int column = 0; column < row.getColumnCount(); ++column) row.getColumn(column).getBytes();
    row.reset();
  }
}

// Individuals are found by run, generation and slot; an index that has lost them would hide them.
std::string lookUpIndividuals(SQLite::Database& database) {
  SQLite::Statement row(database,
                        "SELECT i.id, (SELECT j.id FROM individual j WHERE j.run_id = i.run_id AND j.generation = "
                        "i.generation AND j.slot = i.slot) FROM individual i WHERE i.id >= ? ORDER BY i.id LIMIT 1");
  const std::int64_t last = database.execAndGet("SELECT coalesce(max(id), 0) FROM individual").getInt64();
  for (std::int64_t k = 0; k < samples; ++k) {
    row.bind(1, last / samples * k);
    if (row.executeStep() && row.getColumn(0).getInt64() != row.getColumn(1).getInt64())
      return "individual " + row.getColumn(0).getString() + " is missing from its index";
    row.reset();
  }
  return "";
}

}  // namespace

std::string whyNotSound(SQLite::Database& database, long long wholeUpTo_bytes) {
  const std::int64_t size =
      database.execAndGet("PRAGMA page_count").getInt64() * database.execAndGet("PRAGMA page_size").getInt64();
  if (size <= wholeUpTo_bytes) return quickCheck(database, "");
  for (const std::string& table : smallTables(database))
    if (std::string finding = quickCheck(database, table); !finding.empty()) return finding;
  for (const LargeTable& table : largeTables)
    if (database.tableExists(table.name)) readSamples(database, table);
  return lookUpIndividuals(database);
}

}  // namespace btr
