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

// Locks of the open file, not of the process: they can be asked for without taking them, and they end with their
// holder.
struct flock wholeFile() {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return lock;
}

}  // namespace

RunLock::RunLock(const std::string& databasePath, Id run, const std::string& what)
    : path_(lockPath(databasePath, run, what)) {
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (file_ < 0) throw InputError(path_ + ": cannot be made: " + std::strerror(errno));
  struct flock lock = wholeFile();
  if (fcntl(file_, F_OFD_SETLK, &lock) != 0) {
    close(file_);
    throw InputError(what + " " + std::to_string(run) + " of " + databasePath +
                     ": another process works on it; wait for it or stop it first");
  }
}

// The file stays: removing it would let two processes lock two files of the same name.
RunLock::~RunLock() { close(file_); }

bool RunLock::isHeld(const std::string& databasePath, Id run, const std::string& what) {
  const int file = open(lockPath(databasePath, run, what).c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return false;
  struct flock lock = wholeFile();
  const bool held = fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  close(file);
  return held;
}

}  // namespace btr
