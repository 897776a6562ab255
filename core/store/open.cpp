#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Statement.h>
#include <fcntl.h>
#include <signal.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/spec/error.h"
#include "core/store/connection.h"
#include "core/store/database.h"
#include "core/store/file_locks.h"
#include "core/store/finished_file.h"
#include "core/store/migrations.h"
#include "core/store/soundness.h"

namespace btr {
namespace {

namespace fs = std::filesystem;
using Handle = std::unique_ptr<SQLite::Database>;

/// The 100 bytes that begin every SQLite file (https://www.sqlite.org/fileformat2.html#the_database_header).
struct Header {
  std::int64_t fileSize = 0;
  bool isSqlite = false;
  std::int64_t application = 0;
  std::int64_t version = 0;
};

// Read through SQLite's own handle: closing another descriptor of the file would drop the locks that this process
// holds. Neither journal nor write-ahead log is touched by this.
Header readHeader(const std::string& path, SQLite::Database& database) {
  sqlite3_file* file = nullptr;
  sqlite3_file_control(database.getHandle(), "main", SQLITE_FCNTL_FILE_POINTER, &file);
  Header header;
  sqlite3_int64 size = 0;
  if (file == nullptr || file->pMethods == nullptr || file->pMethods->xFileSize(file, &size) != SQLITE_OK)
    throw InputError(path + ": cannot be read");
  header.fileSize = size;
  unsigned char bytes[100] = {};
  if (size < 100) return header;
  if (file->pMethods->xRead(file, bytes, sizeof bytes, 0) != SQLITE_OK) throw InputError(path + ": cannot be read");
  header.isSqlite = std::memcmp(bytes, "SQLite format 3", 16) == 0;
  const auto number = [&](int at) {
    return std::int64_t{bytes[at]} << 24 | bytes[at + 1] << 16 | bytes[at + 2] << 8 | bytes[at + 3];
  };
  header.version = number(60);
  header.application = number(68);
  return header;
}

void refuseForeign(const std::string& path, const Header& header) {
  if (header.fileSize == 0)
    throw InputError(path + ": is empty, not an UCHILSIM database; delete it or choose another name");
  if (!header.isSqlite) throw InputError(path + ": is not a database (no SQLite file); choose a file made by UCHILSIM");
  if (header.application != applicationId)
    throw InputError(path + ": is the SQLite database of another program (application id " +
                     std::to_string(header.application) + "); choose a file made by UCHILSIM");
}

void refuseNewer(const std::string& path, std::int64_t version) {
  const auto newest = static_cast<std::int64_t>(migrations().size());
  if (version > newest)
    throw InputError(path + ": was written by a newer UCHILSIM (schema " + std::to_string(version) +
                     ", this program knows " + std::to_string(newest) + "); update the program");
}

// Names what stands at the path without opening it.
void checkPlace(const std::string& path, bool mayBeAbsent) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    if (!mayBeAbsent) throw InputError(path + ": there is no such file");
    const fs::path folder = fs::path(path).parent_path();
    if (!fs::is_directory(folder, error)) throw InputError(path + ": there is no folder " + folder.string());
    return;
  }
  if (status.type() == fs::file_type::directory) throw InputError(path + ": is a folder; a database file is needed");
  if (status.type() == fs::file_type::none) throw InputError(path + ": cannot be read (" + error.message() + ")");
  if (status.type() != fs::file_type::regular)
    throw InputError(path + ": is not a regular file; a database file is needed");
}

Handle openFile(const std::string& path, int flags, int patience_ms) {
  lockFilesOfSqliteByDescription();
  std::error_code error;
  const bool hasLog = fs::exists(path + "-wal", error);
  Handle database;
  try {
    database = std::make_unique<SQLite::Database>(path, flags, patience_ms);
  } catch (const SQLite::Exception& problem) {
    const bool unreadable = access(path.c_str(), R_OK) != 0;
    throw InputError(path + ": cannot be opened (" + (unreadable ? std::strerror(errno) : problem.what()) +
                     "); file and folder must be readable, for changes also writable");
  }
  // Until the file is accepted, closing it must not move a write-ahead log that somebody left into it.
  if (hasLog) sqlite3_db_config(database->getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  return database;
}

void configure(SQLite::Database& database) {
  database.exec(
      "PRAGMA foreign_keys = ON; PRAGMA synchronous = FULL; PRAGMA trusted_schema = OFF; PRAGMA cell_size_check = ON");
}

// A path as an SQLite URI that says: nobody changes this file.
std::string immutableUri(const std::string& path) {
  static constexpr char digits[] = "0123456789ABCDEF";
  std::string uri = "file:";
  for (const unsigned char byte : path) {
    if (std::isalnum(byte) || std::strchr("/._-~", byte)) {
      uri += static_cast<char>(byte);
    } else {
      uri += {'%', digits[byte >> 4], digits[byte & 15]};
    }
  }
  return uri + "?immutable=1";
}

// In a folder that cannot be written, SQLite has no place for the shared memory that it coordinates readers and writers
// with. Where no log is left nobody writes, and the file can be read as it is.
Handle readableWhereNothingCanBeWritten(const std::string& path, Handle database, int patience_ms) {
  if (database->tryExec("SELECT count(*) FROM sqlite_master") == SQLITE_OK) return database;
  const int code = database->getErrorCode();
  std::error_code error;
  if ((code != SQLITE_CANTOPEN && code != SQLITE_READONLY) || fs::exists(path + "-wal", error)) return database;
  database.reset();
  return openFile(immutableUri(path), SQLite::OPEN_READONLY | SQLite::OPEN_URI, patience_ms);
}

// What processes left that were killed while they made a database of this name.
void removeStaleDrafts(const std::string& path) {
  const std::string begin = fs::path(path).filename().string() + ".new-";
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(path).parent_path(), error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(begin)) continue;
    const pid_t maker = std::atoi(name.c_str() + begin.size());
    if (maker > 0 && kill(maker, 0) != 0 && errno == ESRCH) fs::remove(entry.path(), error);
  }
}

// The new file is complete before it gets its name: a process that dies meanwhile leaves no half-made database, and of
// two processes that create the same one, the first wins and the second uses it.
void createFile(const std::string& path, int patience_ms) {
  const fs::path parent = fs::path(path).parent_path();
  if (access(parent.c_str(), W_OK | X_OK) != 0)
    throw InputError(path + ": cannot be created in " + parent.string() + " (" + std::strerror(errno) + ")");
  removeStaleDrafts(path);
  const std::string draft = path + ".new-" + std::to_string(gettid());
  removeDraft(draft);
  try {
    const Handle database = openFile(draft, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, patience_ms);
    try {
      configure(*database);
      migrate(*database, migrations());
      database->exec("PRAGMA journal_mode = WAL");
    } catch (const SQLite::Exception& problem) {
      throw InputError(explain(path, database.get(), problem.getExtendedErrorCode(), problem.what()));
    }
  } catch (const InputError&) {
    removeDraft(draft);
    throw;
  }
  nameFinishedFile(draft, path, IfThere::keep);
}

// A step may have left half of the file empty. Where there is no room to write it anew, or others use it, the empty
// pages stay and are used again: nothing is lost.
void giveBackRoom(SQLite::Database& database) {
  const int pages = database.execAndGet("PRAGMA page_count").getInt();
  const int unused = database.execAndGet("PRAGMA freelist_count").getInt();
  if (unused > pages / 4) database.tryExec("VACUUM");
}

void checkSound(const std::string& path, SQLite::Database& database) {
  if (const std::string finding = whyNotSound(database); !finding.empty())
    throw InputError(path + ": is damaged (" + finding + "); use a copy of it that is sound");
}

}  // namespace

Database Database::open(const std::string& path, Mode mode, int patience_ms) {
  if (path.empty()) throw InputError("database: no file is named");
  // Without links: SQLite keeps log and shared memory beside the file itself.
  std::error_code error;
  const fs::path real = fs::weakly_canonical(fs::absolute(path), error);
  const std::string absolute = (error ? fs::absolute(path) : real).string();
  checkPlace(absolute, mode == Mode::create);
  if (mode == Mode::create && !fs::exists(absolute)) createFile(absolute, patience_ms);

  // A reader opens the file for writing too, where it may, and then forswears it: the last to leave puts log and shared
  // memory away, which SQLite's own read-only connections cannot.
  const bool writes = mode != Mode::readOnly;
  Handle database = openFile(absolute, SQLite::OPEN_READWRITE, patience_ms);
  const Header header = readHeader(path, *database);
  refuseForeign(path, header);
  refuseNewer(path, header.version);
  if (writes && sqlite3_db_readonly(database->getHandle(), "main") == 1)
    throw InputError(path + ": is read-only; make the file writable or open it for reading");
  if (!writes) database = readableWhereNothingCanBeWritten(absolute, std::move(database), patience_ms);
  try {
    configure(*database);
    if (!writes) database->exec("PRAGMA query_only = ON");
    const int version = database->execAndGet("PRAGMA user_version").getInt();
    refuseNewer(path, version);
    checkSound(path, *database);
    const bool older = version < static_cast<int>(migrations().size());
    if (older && !writes)
      throw InputError(path + ": was written by an older UCHILSIM; open it for writing once to update it");
    if (older) {
      migrate(*database, migrations());
      giveBackRoom(*database);
    }
    if (writes) {
      const std::string journal = database->execAndGet("PRAGMA journal_mode = WAL").getString();
      if (journal != "wal")
        throw InputError(path + ": this file system does not allow a write-ahead log; use a local disk");
    }
  } catch (const SQLite::Exception& problem) {
    throw InputError(explain(path, database.get(), problem.getExtendedErrorCode(), problem.what()));
  }
  sqlite3_db_config(database->getHandle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 0, nullptr);
  return Database(std::make_unique<Connection>(path, std::move(database), patience_ms));
}

Database::Database(std::unique_ptr<Connection> connection) : connection_(std::move(connection)) {}
Database::~Database() = default;
Database::Database(Database&&) noexcept = default;
Database& Database::operator=(Database&&) noexcept = default;

const std::string& Database::path() const { return connection_->path(); }
std::int64_t Database::dataVersion() const { return connection_->dataVersion(); }
void Database::endWhen(const std::atomic<bool>& stop) { connection_->endWhen(stop); }

}  // namespace btr
