#pragma once
#include <string>

#include "core/store/records.h"

namespace btr {

/// Held by the one process that works on a run or a grid: a lock on the file "DATABASE.run-N.lock" beside the
/// database itself, whatever links it was named through. The system lets go of it when the process ends in whatever
/// way, so a killed run can be resumed at once.
class RunLock {
 public:
  /// Throws InputError if another process holds it or the file cannot be made. `what` is "run" or "grid".
  RunLock(const std::string& databasePath, Id run, const std::string& what = "run");
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  /// True if some process holds it now.
  static bool isHeld(const std::string& databasePath, Id run, const std::string& what = "run");

 private:
  std::string path_;
  int file_ = -1;
};

}  // namespace btr
