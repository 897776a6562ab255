#include "core/store/storage.h"

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Statement.h>

#include "core/store/connection.h"

namespace btr {

std::map<std::string, std::int64_t> storedBytes(const std::string& path) {
  try {
    std::map<std::string, std::int64_t> bytes;
    const SQLite::Database database(path, SQLite::OPEN_READONLY);
    SQLite::Statement row(database,
                          "SELECT coalesce(m.tbl_name, 'sqlite_schema'), sum(s.pgsize) FROM dbstat s LEFT JOIN "
                          "sqlite_schema m ON m.name = s.name GROUP BY 1");
    while (row.executeStep()) bytes[row.getColumn(0).getString()] = row.getColumn(1).getInt64();
    return bytes;
  } catch (const SQLite::Exception& problem) {
    throw InputError(explain(path, nullptr, problem.getExtendedErrorCode(), problem.what()));
  }
}

}  // namespace btr
