#pragma once
#include <sqlite3.h>

#include <stdexcept>

#include "tests/ui/stored_run.h"

namespace btr::ui {

/// A database in rollback mode, which another connection can keep to itself: then not even a reader gets in. (With a
/// write-ahead log readers are always let in.) Such a file is opened only for reading.
class LockedDatabase {
 public:
  /// Two runs of three generations.
  LockedDatabase() {
    {
      StoredRun stored;
      const Id experiment = stored.addExperiment();
      for (const std::uint64_t seed : {1, 2})
        stored.addGenerations(ids_.emplace_back(stored.addRun(experiment, seed)), 3);
      stored.database.backUp(qpath().toStdString(), false);
    }
    if (sqlite3_open(qPrintable(qpath()), &connection_) != SQLITE_OK) throw std::runtime_error("cannot be opened");
    run("PRAGMA journal_mode = DELETE");
  }
  LockedDatabase(const LockedDatabase&) = delete;
  LockedDatabase& operator=(const LockedDatabase&) = delete;
  ~LockedDatabase() { sqlite3_close(connection_); }

  QString qpath() const { return folder_.filePath("test.db"); }
  std::size_t runs() const { return ids_.size(); }
  Id firstRun() const { return ids_.front(); }
  Id secondRun() const { return ids_.back(); }
  void lock() { run("BEGIN EXCLUSIVE"); }
  void unlock() { run("ROLLBACK"); }

 private:
  void run(const char* sql) {
    if (sqlite3_exec(connection_, sql, nullptr, nullptr, nullptr) != SQLITE_OK)
      throw std::runtime_error(sqlite3_errmsg(connection_));
  }
  QTemporaryDir folder_;
  std::vector<Id> ids_;
  sqlite3* connection_ = nullptr;
};

}  // namespace btr::ui
