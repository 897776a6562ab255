#pragma once
#include <EndpointTypes.h>
#include <netinet/in.h>

namespace btr::openr {

// The computer's sockets behind the robot's endpoints: all of them on its loopback, none of them waiting.

constexpr Port portShift = 10000;  ///< of ports that only the computer's owner may open
constexpr Port firstFreePort = 1024;
constexpr uint32 loopbackAddress = INADDR_LOOPBACK;

sockaddr_in loopbackAt(Port port);
/// Where a datagram for everybody goes: to each socket that broadcastEar() made for `port`, in whatever process.
sockaddr_in everybodyAt(Port port);
/// A socket that hears what is sent to everybody at `port`, beside others that do; -1 if there is none.
int broadcastEar(Port port);
/// Allows a datagram socket to send to everybody.
void allowBroadcasts(int socket);
/// A robot's port on this computer, if it is free.
Port twinOf(Port port);
/// Of this side, or of the other.
Port portOf(int socket, bool peer);
/// A socket bound to the port's twin; -1 if there is none.
int boundSocket(int kind, Port port, Port& actual);
/// Whether poll() says so, at once.
bool readyFor(int socket, short what);
/// Whether it would have had to wait.
bool wouldWait(int error);

}  // namespace btr::openr
