#include "core/store/connection.h"

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Transaction.h>
#include <sqlite3.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/spec/error.h"

namespace btr {
namespace {

// Why the operating system refused: asked of the connection, then of its file and its log.
int systemErrorOf(SQLite::Database* database) {
  if (database == nullptr) return 0;
  sqlite3* handle = database->getHandle();
  if (const int error = sqlite3_system_errno(handle); error != 0) return error;
  for (const int which : {SQLITE_FCNTL_JOURNAL_POINTER, SQLITE_FCNTL_FILE_POINTER}) {
    sqlite3_file* file = nullptr;
    int error = 0;
    if (sqlite3_file_control(handle, "main", which, &file) == SQLITE_OK && file != nullptr &&
        file->pMethods != nullptr && file->pMethods->xFileControl(file, SQLITE_FCNTL_LAST_ERRNO, &error) == SQLITE_OK &&
        error != 0)
      return error;
  }
  return 0;
}

bool isDiskFull(SQLite::Database* database, int extendedCode) {
  const int error = systemErrorOf(database);
  const bool noSpace = error == ENOSPC || error == EDQUOT || error == EFBIG;
  return (extendedCode & 0xff) == SQLITE_FULL ||
         ((extendedCode & 0xff) == SQLITE_IOERR && (noSpace || extendedCode == SQLITE_IOERR_SHMSIZE));
}

// Nothing is wrong with the file or the step: later it may succeed.
bool isPassing(SQLite::Database* database, int extendedCode) {
  const int code = extendedCode & 0xff;
  return code == SQLITE_BUSY || code == SQLITE_LOCKED || isDiskFull(database, extendedCode);
}

}  // namespace

Connection::Connection(std::string path, std::unique_ptr<SQLite::Database> database, int patience_ms)
    : path_(std::move(path)), database_(std::move(database)), patience_ms_(patience_ms) {}

Connection::~Connection() = default;

void Connection::refuse(const std::string& message) const { throw InputError(path_ + ": " + message); }

std::int64_t Connection::dataVersion() const {
  // data_version counts the commits of others, total_changes our own rows: neither ever falls.
  std::int64_t others = 0;
  try {
    others = database_->execAndGet("PRAGMA data_version").getInt64();
  } catch (const SQLite::Exception& error) {
    throw InputError(explain(path_, database_.get(), error.getExtendedErrorCode(), error.what()));
  }
  return (others << 32) + sqlite3_total_changes64(database_->getHandle());
}

// SQLite asks these two in the thread of the call: while a query runs, and while another process keeps the lock.
void Connection::endWhen(const std::atomic<bool>& stop) {
  constexpr int instructionsBetween = 10'000, pause_ms = 10;
  stop_ = &stop;
  sqlite3_progress_handler(
      database_->getHandle(), instructionsBetween,
      [](void* self) { return static_cast<Connection*>(self)->stop_->load() ? 1 : 0; }, this);
  sqlite3_busy_handler(
      database_->getHandle(),
      [](void* self, int pauses) {
        const auto* connection = static_cast<Connection*>(self);
        if (connection->stop_->load() || pauses * pause_ms >= connection->patience_ms_) return 0;
        sqlite3_sleep(pause_ms);
        return 1;
      },
      this);
}

void Connection::transact(const std::function<void()>& work, bool writes) const {
  std::optional<SQLite::Transaction> transaction;
  try {
    // A writer takes its lock first: two writers then wait for each other instead of failing half-way.
    transaction.emplace(*database_,
                        writes ? SQLite::TransactionBehavior::IMMEDIATE : SQLite::TransactionBehavior::DEFERRED);
    work();
    transaction->commit();
  } catch (const SQLite::Exception& error) {
    // Explained while the transaction is still there: rolling it back would overwrite the cause.
    const int code = error.getExtendedErrorCode();
    const std::string why = explain(path_, database_.get(), code, error.what());
    if (isPassing(database_.get(), code)) throw NotStored(why);
    throw InputError(why);
  }
}

std::string explain(const std::string& path, SQLite::Database* database, int extendedCode, const std::string& message) {
  const int systemError = systemErrorOf(database);
  const std::string begin = path + ": ";
  if (isDiskFull(database, extendedCode))
    return begin + "disk full: nothing of this step was stored, what was stored before is sound; make room and go on";
  switch (extendedCode & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return begin + "another process keeps the database locked; try again when it is done";
    case SQLITE_INTERRUPT:
      return begin + "reading was ended before it was done";
    case SQLITE_IOERR:
      return begin + "cannot be read or written (" + (systemError ? std::strerror(systemError) : message) + ")";
    case SQLITE_READONLY:
      return begin + "cannot be changed: file or folder is read-only, or it was opened for reading only";
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return begin + "is damaged (" + message + "); use a copy of it that is sound";
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return begin + "cannot be opened (" + (systemError ? std::strerror(systemError) : message) +
             "); file and folder must be readable, for changes also writable";
    case SQLITE_TOOBIG:
      return begin + "a text or file of more than 1000000000 bytes cannot be stored";
    default:
      return begin + message;
  }
}

}  // namespace btr
