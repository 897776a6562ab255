#pragma once
#include <span>

namespace SQLite {
class Database;
}

namespace btr {

/// One step of the schema. The n-th step of the list turns version n − 1 into version n; a step that was released is
/// never changed, a new one is added behind it.
struct Migration {
  const char* why;
  void (*apply)(SQLite::Database&);
};

/// All steps of this program; their count is the version that it writes (PRAGMA user_version).
std::span<const Migration> migrations();

/// "UCHS" in PRAGMA application_id marks a file as ours.
inline constexpr int applicationId = 0x55434853;

/// Brings the database to the last of `steps` in one transaction. Does nothing when it is there already.
void migrate(SQLite::Database& database, std::span<const Migration> steps);

}  // namespace btr
