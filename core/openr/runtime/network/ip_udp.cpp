// What a UDP endpoint is asked for.
#include <UDPEndpointMsg.h>
#include <arpa/inet.h>
#include <errno.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>

#include "core/openr/runtime/network/ip_sockets.h"
#include "core/openr/runtime/network/ip_stack.h"

namespace btr::openr {
namespace {

/// To all robots of the net: 255.255.255.255, the last address of a net, or a group that hosts join.
bool toEverybody(const IPAddress& address) {
  constexpr uint32 lastOfNet = 0xff;
  return address.InBroadcast() != 0 || address.InMulticast() != 0 || (address.Address() & lastOfNet) == lastOfNet;
}

}  // namespace

bool IpStack::sendDatagram(UDPEndpointSendMsg& send, Endpoint& endpoint) {
  const auto answer = [&send](UDPEndpointError error) {
    send.error = error;
    return true;
  };
  if (!mayUse(send.buffer, send.size)) return answer(UDP_BUFFER_INVALID);
  if (endpoint.socket < 0 && bindDatagram(endpoint, 0) < 0) return answer(UDP_FAIL);
  const bool toPeer = endpoint.connected && send.port == 0;
  if (!toPeer && send.port == 0) return answer(UDP_ADDRESSERROR);
  const bool everybody = !toPeer && toEverybody(send.address);
  const sockaddr_in address = everybody ? everybodyAt(twinOf(send.port)) : loopbackAt(actualOf(send.port, false));
  const ssize_t count =
      ::sendto(endpoint.socket, send.buffer, static_cast<std::size_t>(send.size), MSG_NOSIGNAL,
               toPeer ? nullptr : reinterpret_cast<const sockaddr*>(&address), toPeer ? 0 : sizeof(address));
  if (count < 0 && wouldWait(errno)) return false;
  if (count < 0 && errno == EFAULT) return answer(UDP_BUFFER_INVALID);
  if (count < 0) return answer(errno == EMSGSIZE ? UDP_MESSAGE_TOO_LONG : UDP_HOST_UNREACHABLE);
  if (everybody) rememberOwnWord(send);
  return answer(UDP_SUCCESS);
}

/// This computer gives a datagram to everybody to its sender, too.
void IpStack::rememberOwnWord(const UDPEndpointSendMsg& send) {
  constexpr std::size_t most = 64;
  for (const auto& [id, endpoint] : endpoints_)
    if (endpoint.ear >= 0 && endpoint.bound == send.port)
      ownWords_.emplace_back(
          send.port, std::string(reinterpret_cast<const char*>(send.buffer), static_cast<std::size_t>(send.size)));
  while (ownWords_.size() > most) ownWords_.pop_front();
}

/// Whether this robot said so itself; it is not told a second time.
bool IpStack::isOwnWord(Port port, const byte* begin, std::size_t size) {
  const std::string word(reinterpret_cast<const char*>(begin), size);
  const auto at = std::find(ownWords_.begin(), ownWords_.end(), std::pair(port, word));
  if (at == ownWords_.end()) return false;
  ownWords_.erase(at);
  return true;
}

bool IpStack::receiveDatagram(UDPEndpointReceiveMsg& receive, Endpoint& endpoint) {
  const auto answer = [&receive](UDPEndpointError error) {
    receive.error = error;
    return true;
  };
  if (!mayUse(receive.buffer, receive.size)) return answer(UDP_BUFFER_INVALID);
  if (endpoint.socket < 0) return answer(UDP_CONNECTION_CLOSED);
  const auto sentHere = [this](Port actual) {
    return std::find_if(datagramPorts_.begin(), datagramPorts_.end(),
                        [actual](const auto& port) { return port.second == actual; });
  };
  for (const int socket : {endpoint.socket, endpoint.ear}) {
    if (socket < 0) continue;
    sockaddr_in from{};
    ssize_t count = -1;
    auto own = datagramPorts_.end();
    do {
      socklen_t size = sizeof(from);
      count = ::recvfrom(socket, receive.buffer, static_cast<std::size_t>(receive.size), 0,
                         reinterpret_cast<sockaddr*>(&from), &size);
      own = count < 0 ? datagramPorts_.end() : sentHere(ntohs(from.sin_port));
    } while (count >= 0 && socket == endpoint.ear && own != datagramPorts_.end() &&
             isOwnWord(endpoint.bound, receive.buffer, static_cast<std::size_t>(count)));
    if (count < 0 && (wouldWait(errno) || errno == ECONNREFUSED)) continue;
    if (count < 0) return answer(errno == EFAULT ? UDP_BUFFER_INVALID : UDP_FAIL);
    receive.address = IPAddress(ntohl(from.sin_addr.s_addr));
    receive.port = own == datagramPorts_.end() ? ntohs(from.sin_port) : own->first;
    receive.size = static_cast<int>(count);
    return answer(UDP_SUCCESS);
  }
  return false;
}

bool IpStack::udp(Operation& operation, Endpoint& endpoint) {
  auto* base = static_cast<UDPEndpointBaseMsg*>(operation.message);
  const auto answer = [base](UDPEndpointError error) {
    base->error = error;
    return true;
  };
  switch (operation.message->dstOperation) {
    case UDPEndpoint_Operation_Bind: {
      auto* bind = static_cast<UDPEndpointBindMsg*>(base);
      closeEndpoint(endpoint);
      return answer(bindDatagram(endpoint, bind->port) < 0 ? UDP_ADDRESSINUSE : UDP_SUCCESS);
    }
    case UDPEndpoint_Operation_Connect: {
      auto* connect = static_cast<UDPEndpointConnectMsg*>(base);
      if (endpoint.socket < 0 && bindDatagram(endpoint, 0) < 0) return answer(UDP_FAIL);
      const sockaddr_in address = loopbackAt(actualOf(connect->port, false));
      const bool done = ::connect(endpoint.socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
      endpoint.connected = done;
      return answer(done ? UDP_SUCCESS : UDP_HOST_UNREACHABLE);
    }
    case UDPEndpoint_Operation_ResetConnect: {
      sockaddr_in none{};
      none.sin_family = AF_UNSPEC;
      if (endpoint.socket >= 0) ::connect(endpoint.socket, reinterpret_cast<const sockaddr*>(&none), sizeof(none));
      endpoint.connected = false;
      return answer(UDP_SUCCESS);
    }
    case UDPEndpoint_Operation_Send:
      return sendDatagram(*static_cast<UDPEndpointSendMsg*>(base), endpoint);
    case UDPEndpoint_Operation_Receive:
      return receiveDatagram(*static_cast<UDPEndpointReceiveMsg*>(base), endpoint);
    case UDPEndpoint_Operation_Close:
      closeEndpoint(endpoint);
      return answer(UDP_SUCCESS);
    case UDPEndpoint_Operation_ReadyForRead:
      static_cast<UDPEndpointReadyForReadMsg*>(base)->ready =
          endpoint.socket >= 0 &&
          (readyFor(endpoint.socket, POLLIN) || (endpoint.ear >= 0 && readyFor(endpoint.ear, POLLIN)));
      return answer(endpoint.socket >= 0 ? UDP_SUCCESS : UDP_CONNECTION_CLOSED);
    case UDPEndpoint_Operation_ReadyForWrite:
      static_cast<UDPEndpointReadyForWriteMsg*>(base)->ready = endpoint.socket >= 0;
      return answer(endpoint.socket >= 0 ? UDP_SUCCESS : UDP_CONNECTION_CLOSED);
    case UDPEndpoint_Operation_Address: {
      auto* address = static_cast<UDPEndpointAddressMsg*>(base);
      address->lAddress = address->fAddress = IPAddress(loopbackAddress);
      address->lPort = endpoint.bound;
      return answer(UDP_SUCCESS);
    }
    case UDPEndpoint_Operation_SetMulticastLoop:
    case UDPEndpoint_Operation_SetMulticastTTL:
    case UDPEndpoint_Operation_AddMembership:
    case UDPEndpoint_Operation_DropMembership:
    case UDPEndpoint_Operation_SetBlockingMode:
      return answer(UDP_SUCCESS);
    default:
      return answer(UDP_OPERATION_UNKNOWN);
  }
}

}  // namespace btr::openr
