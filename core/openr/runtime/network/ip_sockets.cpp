#include "core/openr/runtime/network/ip_sockets.h"

#include <arpa/inet.h>
#include <errno.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace btr::openr {
namespace {

constexpr uint32 loopbackBroadcast = 0x7fffffff;  // 127.255.255.255

sockaddr_in addressOf(uint32 host, Port port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(host);
  address.sin_port = htons(port);
  return address;
}

}  // namespace

sockaddr_in loopbackAt(Port port) { return addressOf(INADDR_LOOPBACK, port); }

sockaddr_in everybodyAt(Port port) { return addressOf(loopbackBroadcast, port); }

int broadcastEar(Port port) {
  const int made = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (made < 0) return -1;
  const int yes = 1;
  setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  const sockaddr_in address = everybodyAt(port);
  if (::bind(made, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) return made;
  ::close(made);
  return -1;
}

void allowBroadcasts(int socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_BROADCAST, &yes, sizeof(yes));
}

Port twinOf(Port port) { return port < firstFreePort ? static_cast<Port>(port + portShift) : port; }

Port portOf(int socket, bool peer) {
  sockaddr_in address{};
  socklen_t size = sizeof(address);
  const int status = peer ? getpeername(socket, reinterpret_cast<sockaddr*>(&address), &size)
                          : getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  return status == 0 ? ntohs(address.sin_port) : Port{0};
}

int boundSocket(int kind, Port port, Port& actual) {
  const Port wanted = port == 0 ? Port{0} : twinOf(port);
  for (const Port each : {wanted, Port{0}}) {
    const int made = ::socket(AF_INET, kind | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (made < 0) return -1;
    const int yes = 1;
    if (kind == SOCK_STREAM) setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    const sockaddr_in address = loopbackAt(each);
    if (::bind(made, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0 &&
        (kind != SOCK_STREAM || ::listen(made, 16) == 0)) {
      actual = portOf(made, false);
      return made;
    }
    ::close(made);
  }
  return -1;
}

bool readyFor(int socket, short what) {
  pollfd one{socket, what, 0};
  return ::poll(&one, 1, 0) > 0;
}

bool wouldWait(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINPROGRESS || error == EINTR; }

}  // namespace btr::openr
