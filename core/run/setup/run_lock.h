#pragma once
#include <functional>
#include <string>

#include "core/store/records.h"

namespace btr {

/// Held by the one process that works on a run or a grid: a lock on the file "DATABASE.run-N.lock" beside the
/// database itself, whatever links it was named through. The system lets go of it when the process ends in whatever
/// way, so a killed run can be resumed at once.
class RunLock {
 public:
  /// Throws InputError if another process holds it or the file cannot be made. `what` is "run" or "grid". `first` is
  /// done once nobody else can begin and before isHeld() says so: what others ask of a process at work comes behind it.
  RunLock(const std::string& databasePath, Id run, const std::string& what = "run",
          const std::function<void()>& first = {});
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  /// Does `action` while nobody can begin to work. False, and nothing is done, if somebody does already.
  static bool ifNobodyWorks(const std::string& databasePath, Id run, const std::function<void()>& action);
  /// True if some process holds it now.
  static bool isHeld(const std::string& databasePath, Id run, const std::string& what = "run");

 private:
  /// Claims it, without being at work yet; not isClaimed() if another process has.
  struct Claim {};
  RunLock(Claim, const std::string& path);
  bool isClaimed() const { return claimed_; }

  int file_ = -1;
  bool claimed_ = false;
};

}  // namespace btr
