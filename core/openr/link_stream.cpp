#include "core/openr/link_stream.h"

#include <errno.h>
#include <sys/socket.h>

namespace btr::openr {
namespace {

bool receiveAll(int socket, std::uint8_t* to, std::size_t size) {
  while (size > 0) {
    const ssize_t count = recv(socket, to, size, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    to += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

bool sendAll(int socket, const std::uint8_t* from, std::size_t size) {
  while (size > 0) {
    const ssize_t count = send(socket, from, size, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    from += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace

bool receiveMessage(int socket, std::vector<std::uint8_t>& bytes) {
  std::uint8_t head[4];
  if (!receiveAll(socket, head, sizeof(head))) return false;
  const std::size_t size =
      head[0] | (std::size_t{head[1]} << 8) | (std::size_t{head[2]} << 16) | (std::size_t{head[3]} << 24);
  if (size > longestMessage) return false;
  bytes.resize(size);
  return receiveAll(socket, bytes.data(), size);
}

bool sendMessage(int socket, const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() > longestMessage) return false;
  std::uint8_t head[4];
  for (int i = 0; i < 4; ++i) head[i] = static_cast<std::uint8_t>(bytes.size() >> (8 * i));
  return sendAll(socket, head, sizeof(head)) && sendAll(socket, bytes.data(), bytes.size());
}

}  // namespace btr::openr
