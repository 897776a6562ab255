#include "core/cluster/foreman_pipe.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>

#include "core/spec/system/child_process.h"

namespace btr {

std::optional<Parts> ForemanPipe::read() const {
  std::uint64_t size = 0;
  if (!readAll(in, reinterpret_cast<char*>(&size), sizeof size)) return std::nullopt;
  std::string bytes(size, '\0');
  if (!readAll(in, bytes.data(), size)) return std::nullopt;
  return unpack(bytes);
}

void ForemanPipe::write(const Parts& parts) const {
  const std::string bytes = pack(parts);
  const std::uint64_t size = bytes.size();
  std::string all(reinterpret_cast<const char*>(&size), sizeof size);
  all += bytes;
  for (std::size_t done = 0; done < all.size();) {
    const ssize_t n = ::write(out, all.data() + done, all.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) _exit(0);
    done += static_cast<std::size_t>(n);
  }
}

ForemanPipe takeStandardStreams() {
  ForemanPipe pipe{fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 10), fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 10)};
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  dup2(nothing, STDIN_FILENO);
  close(nothing);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  return pipe;
}

Parts joined(Parts head, const Parts& rest) {
  head.insert(head.end(), rest.begin(), rest.end());
  return head;
}

}  // namespace btr
