#include "core/store/file_locks.h"

#include <fcntl.h>
#include <pthread.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace btr {
namespace {

// SQLite counts the locks of all its connections to one file in this process and asks for one of the process' own, by
// any of their descriptors; it relies on them not keeping each other out. So each file gets one description of ours,
// which nobody else knows, and all locks of the file are taken on it. As with POSIX locks they end when SQLite has
// closed its last descriptor of the file, or with the process.
class DescribedLocks {
 public:
  int lock(int descriptor, int command, struct flock* wanted) {
    const std::scoped_lock alone(mutex_);
    const File* file = fileOf(descriptor);
    if (file == nullptr || file->own < 0) return ::fcntl(descriptor, command, wanted);
    struct flock request = *wanted;
    request.l_pid = 0;
    const int result = ::fcntl(file->own,
                               command == F_GETLK   ? F_OFD_GETLK
                               : command == F_SETLK ? F_OFD_SETLK
                                                    : F_OFD_SETLKW,
                               &request);
    if (command == F_GETLK) *wanted = request;
    return result;
  }
  int close(int descriptor) {
    const std::scoped_lock alone(mutex_);
    forget(descriptor);
    return ::close(descriptor);
  }
  void beforeFork() {
    mutex_.lock();
    if (!files_.empty() && ::pipe2(childIsDone_, O_CLOEXEC) != 0) childIsDone_[0] = childIsDone_[1] = -1;
  }
  // fork() returns only when the child has closed what it inherited (or has ended, or there is none): a parent killed
  // right after it would otherwise leave its locks with a child that has not run yet.
  void inParent() {
    if (childIsDone_[0] >= 0) {
      ::close(childIsDone_[1]);
      char none = 0;
      while (::read(childIsDone_[0], &none, 1) < 0 && errno == EINTR) {
      }
      ::close(childIsDone_[0]);
      childIsDone_[0] = childIsDone_[1] = -1;
    }
    mutex_.unlock();
  }
  // A child must not hold its parent's locks beyond the parent's end.
  void inChild() {
    for (const auto& [id, file] : files_)
      if (file.own >= 0) ::close(file.own);
    files_.clear();
    users_.clear();
    if (childIsDone_[0] >= 0) {
      ::close(childIsDone_[0]);
      ::close(childIsDone_[1]);
      childIsDone_[0] = childIsDone_[1] = -1;
    }
    mutex_.unlock();
  }

 private:
  using FileId = std::pair<dev_t, ino_t>;
  struct File {
    int own = -1;   ///< our description of it; −1: there is none, POSIX locks are taken
    int users = 0;  ///< of users_
  };

  const File* fileOf(int descriptor) {
    struct stat status {};
    if (fstat(descriptor, &status) != 0) return nullptr;
    const FileId id{status.st_dev, status.st_ino};
    // While we hold it open no other file can get its number.
    if (const auto known = users_.find(descriptor); known != users_.end() && known->second != id) forget(descriptor);
    const auto [place, isNew] = files_.try_emplace(id);
    File& file = place->second;
    if (isNew) file.own = describe(descriptor);
    if (users_.try_emplace(descriptor, id).second) ++file.users;
    return &file;
  }
  static int describe(int descriptor) {
    const std::string name = "/proc/self/fd/" + std::to_string(descriptor);
    int own = ::open(name.c_str(), O_RDWR | O_CLOEXEC);
    if (own < 0) own = ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
    if (own < 0) return -1;
    struct flock probe {};
    probe.l_type = F_RDLCK;
    probe.l_whence = SEEK_SET;
    probe.l_len = 1;
    if (::fcntl(own, F_OFD_GETLK, &probe) == 0) return own;
    ::close(own);  // a kernel or file system without them
    return -1;
  }
  void forget(int descriptor) {
    const auto user = users_.find(descriptor);
    if (user == users_.end()) return;
    const auto file = files_.find(user->second);
    users_.erase(user);
    if (--file->second.users > 0) return;
    if (file->second.own >= 0) ::close(file->second.own);
    files_.erase(file);
  }

  std::mutex mutex_;
  std::map<FileId, File> files_;
  std::map<int, FileId> users_;    ///< SQLite's descriptors that asked for locks
  int childIsDone_[2] = {-1, -1};  ///< a pipe while fork() runs; its end of file tells the parent
};

// Lives as long as the process: SQLite may close files at its very end.
DescribedLocks& locks() {
  static auto* const all = new DescribedLocks;
  return *all;
}

extern "C" {

int controlFile(int descriptor, int command, ...) {
  va_list rest;
  va_start(rest, command);
  int result = 0;
  if (command == F_SETLK || command == F_SETLKW || command == F_GETLK)
    result = locks().lock(descriptor, command, va_arg(rest, struct flock*));
  else if (command == F_GETFD || command == F_GETFL)
    result = ::fcntl(descriptor, command);
  else
    result = ::fcntl(descriptor, command, va_arg(rest, int));  // SQLite sets descriptors' flags
  va_end(rest);
  return result;
}

int closeFile(int descriptor) { return locks().close(descriptor); }

}  // extern "C"

void replace() {
  locks();
  sqlite3_vfs* const files = sqlite3_vfs_find(nullptr);
  if (files == nullptr || files->iVersion < 3 || files->xSetSystemCall == nullptr) return;
  files->xSetSystemCall(files, "fcntl", reinterpret_cast<sqlite3_syscall_ptr>(controlFile));
  files->xSetSystemCall(files, "close", reinterpret_cast<sqlite3_syscall_ptr>(closeFile));
  pthread_atfork([] { locks().beforeFork(); }, [] { locks().inParent(); }, [] { locks().inChild(); });
}

}  // namespace

void lockFilesOfSqliteByDescription() {
  static std::once_flag once;
  std::call_once(once, replace);
}

}  // namespace btr
