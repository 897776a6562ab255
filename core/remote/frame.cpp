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

/// Until when, and who may end it before.
class Patience {
 public:
  Patience(double wait_s, const std::function<bool()>& cancelled)
      : forEver_(wait_s < 0), until_(now_s() + wait_s), cancelled_(cancelled) {}

  /// True once the socket can be read or written, or nobody is at its other end.
  bool waitFor(int socket, short what) const {
    constexpr double look_s = 0.1, longest_s = 1e6;
    while (true) {
      double left = forEver_ ? longest_s : std::clamp(until_ - now_s(), 0.0, longest_s);
      if (cancelled_) left = std::min(left, look_s);
      pollfd one{socket, what, 0};
      const int ready = poll(&one, 1, static_cast<int>(1000 * left + 0.999));
      if (ready > 0 || (ready < 0 && errno != EINTR)) return true;
      if (cancelled_ && cancelled_()) return false;
      if (!forEver_ && now_s() >= until_) return false;
    }
  }

 private:
  const bool forEver_;
  const double until_;
  const std::function<bool()>& cancelled_;
};

Sent sendAll(int socket, const char* data, std::size_t size, const Patience& patience) {
  while (size > 0) {
    const ssize_t n = send(socket, data, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
      if (!patience.waitFor(socket, POLLOUT)) return Sent::nothing;
      continue;
    }
    if (n <= 0) return Sent::hungUp;
    data += n;
    size -= static_cast<std::size_t>(n);
  }
  return Sent::whole;
}

Got receiveAll(int socket, char* data, std::size_t size, const Patience& patience) {
  while (size > 0) {
    const ssize_t n = recv(socket, data, size, MSG_DONTWAIT);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) {
      if (!patience.waitFor(socket, POLLIN)) return Got::nothing;
      continue;
    }
    if (n <= 0) return Got::hungUp;
    data += n;
    size -= static_cast<std::size_t>(n);
  }
  return Got::frame;
}

}  // namespace

Sent sendBytes(int socket, const std::string& bytes, double wait_s, const std::function<bool()>& cancelled) {
  return sendAll(socket, bytes.data(), bytes.size(), Patience(wait_s, cancelled));
}

Sent sendFrame(int socket, const std::string& bytes, double wait_s, const std::function<bool()>& cancelled) {
  const auto size = static_cast<std::uint32_t>(bytes.size());
  std::string all(sizeof size, '\0');
  std::memcpy(all.data(), &size, sizeof size);
  return sendBytes(socket, all + bytes, wait_s, cancelled);
}

Got receiveFrame(int socket, std::string& bytes, double wait_s, const std::function<bool()>& cancelled, double rest_s) {
  if (!Patience(wait_s, cancelled).waitFor(socket, POLLIN)) return Got::nothing;
  const Patience rest(rest_s, cancelled);
  std::uint32_t size = 0;
  const Got head = receiveAll(socket, reinterpret_cast<char*>(&size), sizeof size, rest);
  if (head != Got::frame) return head;
  if (size > largestFrame) return Got::hungUp;
  bytes.resize(size);
  return receiveAll(socket, bytes.data(), size, rest);
}

}  // namespace btr::remote
