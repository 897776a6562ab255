#include "core/openr/link_stream.h"

#include <errno.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>

namespace btr::openr {
namespace {

/// False once it is too late. Else the socket may be ready.
bool waitFor(int socket, short what, Deadline until) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now()).count();
  if (left <= 0) return false;
  constexpr long longest_ms = 1000000;
  pollfd one{socket, what, 0};
  poll(&one, 1, static_cast<int>(std::min<long>(left, longest_ms)));
  return true;
}

bool wouldWait() { return errno == EAGAIN || errno == EWOULDBLOCK; }

Passed receiveAll(int socket, std::uint8_t* to, std::size_t size, Deadline until) {
  const int flags = until == forEver ? 0 : MSG_DONTWAIT;
  while (size > 0) {
    const ssize_t count = recv(socket, to, size, flags);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && wouldWait()) {
      if (!waitFor(socket, POLLIN, until)) return Passed::late;
      continue;
    }
    if (count <= 0) return Passed::gone;
    to += count;
    size -= static_cast<std::size_t>(count);
  }
  return Passed::whole;
}

Passed sendAll(int socket, const std::uint8_t* from, std::size_t size, Deadline until) {
  const int flags = until == forEver ? MSG_NOSIGNAL : MSG_NOSIGNAL | MSG_DONTWAIT;
  while (size > 0) {
    const ssize_t count = send(socket, from, size, flags);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && wouldWait()) {
      if (!waitFor(socket, POLLOUT, until)) return Passed::late;
      continue;
    }
    if (count <= 0) return Passed::gone;
    from += count;
    size -= static_cast<std::size_t>(count);
  }
  return Passed::whole;
}

}  // namespace

Passed receiveMessage(int socket, std::vector<std::uint8_t>& bytes, Deadline until) {
  std::uint8_t head[4];
  if (const Passed passed = receiveAll(socket, head, sizeof(head), until); passed != Passed::whole) return passed;
  const std::size_t size =
      head[0] | (std::size_t{head[1]} << 8) | (std::size_t{head[2]} << 16) | (std::size_t{head[3]} << 24);
  if (size > longestMessage) return Passed::gone;
  bytes.resize(size);
  return receiveAll(socket, bytes.data(), size, until);
}

Passed sendMessage(int socket, const std::vector<std::uint8_t>& bytes, Deadline until) {
  if (bytes.size() > longestMessage) return Passed::gone;
  std::uint8_t head[4];
  for (int i = 0; i < 4; ++i) head[i] = static_cast<std::uint8_t>(bytes.size() >> (8 * i));
  if (const Passed passed = sendAll(socket, head, sizeof(head), until); passed != Passed::whole) return passed;
  return sendAll(socket, bytes.data(), bytes.size(), until);
}

}  // namespace btr::openr
