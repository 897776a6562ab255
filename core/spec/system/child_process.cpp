#include "core/spec/system/child_process.h"

#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

namespace btr {

bool endsWithin(pid_t process, int patience_ms) {
  const int watched = static_cast<int>(syscall(SYS_pidfd_open, process, 0));
  if (watched < 0) return false;
  pollfd one{watched, POLLIN, 0};
  const bool ended = poll(&one, 1, patience_ms) > 0;
  close(watched);
  return ended;
}

bool readAll(int file, char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = read(file, data, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    data += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace btr
