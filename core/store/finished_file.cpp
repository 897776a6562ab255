#include "core/store/finished_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "core/spec/error.h"

namespace btr {
namespace {

void syncFolder(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (descriptor < 0) return;
  fsync(descriptor);
  ::close(descriptor);
}

// 0, or the system's error.
int giveName(const std::string& draft, const std::string& path, IfThere ifThere) {
  if (ifThere == IfThere::replace) return std::rename(draft.c_str(), path.c_str()) == 0 ? 0 : errno;
  if (link(draft.c_str(), path.c_str()) == 0) return 0;
  const int cause = errno;
  if (cause == EEXIST) return EEXIST;
  // File systems without hard links: the name is taken by renaming, which does not replace a file either.
  if (renameat2(AT_FDCWD, draft.c_str(), AT_FDCWD, path.c_str(), RENAME_NOREPLACE) == 0) return 0;
  return errno == EEXIST ? EEXIST : cause;
}

}  // namespace

void removeDraft(const std::string& draft) {
  std::error_code error;
  for (const char* end : {"", "-wal", "-shm", "-journal"}) std::filesystem::remove(draft + end, error);
}

bool nameFinishedFile(const std::string& draft, const std::string& path, IfThere ifThere) {
  const int error = giveName(draft, path, ifThere);
  removeDraft(draft);
  if (error == EEXIST) return false;
  if (error != 0) throw InputError(path + ": cannot be created (" + std::strerror(error) + ")");
  syncFolder(std::filesystem::path(path).parent_path().string());
  return true;
}

}  // namespace btr
