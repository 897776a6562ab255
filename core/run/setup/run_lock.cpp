#include "core/run/setup/run_lock.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "core/spec/error.h"

namespace btr {
namespace {

// Beside the file itself: through a link to the database one finds the same lock.
std::string lockPath(const std::string& databasePath, Id run, const std::string& what) {
  std::error_code error;
  const std::filesystem::path real = std::filesystem::weakly_canonical(databasePath, error);
  return (error ? databasePath : real.string()) + "." + what + "-" + std::to_string(run) + ".lock";
}

// One process claims the first byte, and the second one once it is at work.
constexpr off_t claimed = 0, atWork = 1;

// Locks of the open file, not of the process: they can be asked for without taking them, and they end with their
// holder.
struct flock lockOf(off_t byte) {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = byte;
  lock.l_len = 1;
  return lock;
}

bool take(int file, off_t byte) {
  struct flock lock = lockOf(byte);
  return fcntl(file, F_OFD_SETLK, &lock) == 0;
}

}  // namespace

RunLock::RunLock(Claim, const std::string& path) : file_(open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
  if (file_ < 0) throw InputError(path + ": cannot be made: " + std::strerror(errno));
  claimed_ = take(file_, claimed);
}

RunLock::RunLock(const std::string& databasePath, Id run, const std::string& what, const std::function<void()>& first)
    : RunLock(Claim{}, lockPath(databasePath, run, what)) {
  if (isClaimed() && first) first();
  if (!isClaimed() || !take(file_, atWork))
    throw InputError(what + " " + std::to_string(run) + " of " + databasePath +
                     ": another process works on it; wait for it or stop it first");
}

// The file stays: removing it would let two processes lock two files of the same name.
RunLock::~RunLock() { close(file_); }

bool RunLock::ifNobodyWorks(const std::string& databasePath, Id run, const std::function<void()>& action) {
  const RunLock claim(Claim{}, lockPath(databasePath, run, "run"));
  if (claim.isClaimed()) action();
  return claim.isClaimed();
}

bool RunLock::isHeld(const std::string& databasePath, Id run, const std::string& what) {
  const int file = open(lockPath(databasePath, run, what).c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return false;
  struct flock lock = lockOf(atWork);
  const bool held = fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  close(file);
  return held;
}

}  // namespace btr
