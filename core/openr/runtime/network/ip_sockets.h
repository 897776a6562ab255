#pragma once
#include <EndpointTypes.h>
#include <netinet/in.h>

namespace btr::openr {

// The computer's sockets behind the robot's endpoints: all of them on its loopback, none of them waiting.

constexpr Port portShift = 10000;  ///< of ports that only the computer's owner may open
constexpr Port firstFreePort = 1024;
constexpr uint32 loopbackAddress = INADDR_LOOPBACK;

sockaddr_in loopbackAt(Port port);
/// Of this side, or of the other.
Port portOf(int socket, bool peer);
/// A socket bound to the port's twin; -1 if there is none.
int boundSocket(int kind, Port port, Port& actual);
/// Whether poll() says so, at once.
bool readyFor(int socket, short what);
/// Whether it would have had to wait.
bool wouldWait(int error);

}  // namespace btr::openr
