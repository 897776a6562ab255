#include "core/remote/frame.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>

#include "core/remote/clock.h"

namespace btr::remote {
namespace {

bool receiveAll(int socket, char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t n = recv(socket, data, size, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    data += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

/// True once there is something to read or nobody to write it.
bool waitFor(int socket, double wait_s, const std::function<bool()>& cancelled) {
  constexpr double look_s = 0.1;
  const double until = now_s() + wait_s;
  while (true) {
    double left = wait_s < 0 ? look_s : std::max(0.0, until - now_s());
    if (cancelled) left = std::min(left, look_s);
    pollfd one{socket, POLLIN, 0};
    const int ready = poll(&one, 1, wait_s < 0 && !cancelled ? -1 : static_cast<int>(1000 * left + 0.999));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return true;
    if (cancelled && cancelled()) return false;
    if (wait_s >= 0 && now_s() >= until) return false;
  }
}

}  // namespace

bool sendFrame(int socket, const std::string& bytes) {
  const auto size = static_cast<std::uint32_t>(bytes.size());
  std::string all(sizeof size, '\0');
  std::memcpy(all.data(), &size, sizeof size);
  all += bytes;
  const char* data = all.data();
  std::size_t left = all.size();
  while (left > 0) {
    const ssize_t n = send(socket, data, left, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    data += n;
    left -= static_cast<std::size_t>(n);
  }
  return true;
}

Got receiveFrame(int socket, std::string& bytes, double wait_s, const std::function<bool()>& cancelled) {
  if (!waitFor(socket, wait_s, cancelled)) return Got::nothing;
  std::uint32_t size = 0;
  if (!receiveAll(socket, reinterpret_cast<char*>(&size), sizeof size) || size > largestFrame) return Got::hungUp;
  bytes.resize(size);
  return receiveAll(socket, bytes.data(), size) ? Got::frame : Got::hungUp;
}

}  // namespace btr::remote
