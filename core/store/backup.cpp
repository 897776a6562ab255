// Copies of a whole database while others work with it, and how sound it is.
#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Statement.h>
#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/spec/error.h"
#include "core/store/connection.h"
#include "core/store/database.h"
#include "core/store/finished_file.h"

namespace btr {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> findingsOf(SQLite::Database& database) {
  std::vector<std::string> findings;
  for (SQLite::Statement row(database, "PRAGMA integrity_check"); row.executeStep();)
    if (const std::string text = row.getColumn(0).getString(); text != "ok") findings.push_back(text);
  for (SQLite::Statement row(database, "PRAGMA foreign_key_check"); row.executeStep();)
    findings.push_back("row " + row.getColumn(1).getString() + " of " + row.getColumn(0).getString() +
                       " refers to a row of " + row.getColumn(2).getString() + " that is missing");
  return findings;
}

// All bytes are on the disk before the copy gets its name.
void syncFile(const std::string& draft, const std::string& path) {
  const int descriptor = ::open(draft.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = descriptor >= 0 && fsync(descriptor) == 0;
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!synced) throw InputError(path + ": cannot be written (" + std::strerror(error) + "); no copy was made");
}

void copyPages(const Connection& from, SQLite::Database& copy, const std::string& to) {
  SQLite::Backup backup(copy, from.database());
  try {
    // All pages in one step are one state of the database; in a write-ahead log writers go on meanwhile.
    const int result = backup.executeStep(-1);
    if (result == SQLITE_BUSY || result == SQLITE_LOCKED)
      from.refuse("another process keeps the database locked; try again when it is done");
  } catch (const SQLite::Exception& problem) {
    // Explained while the backup is there: ending it would overwrite the cause.
    const std::string why = explain(to, &copy, problem.getErrorCode(), problem.what());
    if (why.starts_with(to + ": disk full"))
      throw InputError(to + ": disk full: no copy was made; make room or choose another place");
    throw InputError(why);
  }
}

}  // namespace

std::int64_t Database::backUp(const std::string& to, bool replace) const {
  if (to.empty()) throw InputError("backup: no file is named");
  std::error_code error;
  const fs::path target = fs::absolute(to);
  const std::string path = target.string();
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) throw InputError(to + ": is a folder; the backup needs the name of a file");
  if (fs::exists(status)) {
    if (fs::equivalent(target, connection_->database().getFilename(), error))
      throw InputError(to + ": is the database itself; choose another name for its backup");
    if (!replace) throw InputError(to + ": is there already; choose another name, or --force to replace it");
    if (fs::exists(path + "-wal", error))
      throw InputError(to + ": is in use (there is a log beside it), so it is not replaced; choose another name");
  }
  if (!fs::is_directory(target.parent_path(), error))
    throw InputError(to + ": there is no folder " + target.parent_path().string());

  const std::string draft = path + ".new-" + std::to_string(gettid());
  removeDraft(draft);
  try {
    SQLite::Database copy(draft, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    copyPages(*connection_, copy, to);
    // One file without a log beside it, until it is opened.
    copy.exec("PRAGMA journal_mode = DELETE");
    if (const auto findings = findingsOf(copy); !findings.empty())
      throw InputError(to + ": the copy is not sound (" + findings.front() + "); it was not kept");
  } catch (const SQLite::Exception& problem) {
    removeDraft(draft);
    throw InputError(explain(to, nullptr, problem.getExtendedErrorCode(), problem.what()) + "; no copy was made");
  } catch (...) {
    removeDraft(draft);
    throw;
  }
  try {
    syncFile(draft, to);
  } catch (...) {
    removeDraft(draft);
    throw;
  }
  const auto bytes = static_cast<std::int64_t>(fs::file_size(draft));
  if (!nameFinishedFile(draft, path, replace ? IfThere::replace : IfThere::keep))
    throw InputError(to + ": is there already; choose another name, or --force to replace it");
  return bytes;
}

std::vector<std::string> Database::findings() const {
  return connection_->read([&] { return findingsOf(connection_->database()); });
}

bool Database::moveLogIntoFile(int patience_ms) const {
  sqlite3* handle = connection_->database().getHandle();
  int frames = 0, moved = 0;
  // Without waiting first: a connection that is open but does not read at the moment is in nobody's way.
  int result = sqlite3_wal_checkpoint_v2(handle, "main", SQLITE_CHECKPOINT_PASSIVE, &frames, &moved);
  if (result == SQLITE_OK && moved == frames) return true;
  sqlite3_busy_timeout(handle, patience_ms);
  result = sqlite3_wal_checkpoint_v2(handle, "main", SQLITE_CHECKPOINT_FULL, &frames, &moved);
  sqlite3_busy_timeout(handle, connection_->patience_ms());
  if (result == SQLITE_OK && moved == frames) return true;
  if (result == SQLITE_OK || (result & 0xff) == SQLITE_BUSY || (result & 0xff) == SQLITE_LOCKED) return false;
  throw InputError(explain(path(), &connection_->database(), result, sqlite3_errmsg(handle)));
}

}  // namespace btr
