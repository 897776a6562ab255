// What a UDP endpoint is asked for.
#include <UDPEndpointMsg.h>
#include <arpa/inet.h>
#include <errno.h>
#include <poll.h>
#include <sys/socket.h>

#include "core/openr/runtime/network/ip_sockets.h"
#include "core/openr/runtime/network/ip_stack.h"

namespace btr::openr {

bool IpStack::udp(Operation& operation, Endpoint& endpoint) {
  auto* base = static_cast<UDPEndpointBaseMsg*>(operation.message);
  const auto answer = [base](UDPEndpointError error) {
    base->error = error;
    return true;
  };
  const auto robotPort = [this](Port actual) {
    for (const auto& [port, its] : datagramPorts_)
      if (its == actual) return port;
    return actual;
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
    case UDPEndpoint_Operation_Send: {
      auto* send = static_cast<UDPEndpointSendMsg*>(base);
      if (!isShared(send->buffer, send->size)) return answer(UDP_BUFFER_INVALID);
      if (endpoint.socket < 0 && bindDatagram(endpoint, 0) < 0) return answer(UDP_FAIL);
      const sockaddr_in address = loopbackAt(actualOf(send->port, false));
      const bool toPeer = endpoint.connected && send->port == 0;
      if (!toPeer && send->port == 0) return answer(UDP_ADDRESSERROR);
      const ssize_t count =
          ::sendto(endpoint.socket, send->buffer, static_cast<std::size_t>(send->size), MSG_NOSIGNAL,
                   toPeer ? nullptr : reinterpret_cast<const sockaddr*>(&address), toPeer ? 0 : sizeof(address));
      if (count < 0 && wouldWait(errno)) return false;
      if (count < 0) return answer(errno == EMSGSIZE ? UDP_MESSAGE_TOO_LONG : UDP_HOST_UNREACHABLE);
      return answer(UDP_SUCCESS);
    }
    case UDPEndpoint_Operation_Receive: {
      auto* receive = static_cast<UDPEndpointReceiveMsg*>(base);
      if (!isShared(receive->buffer, receive->size)) return answer(UDP_BUFFER_INVALID);
      if (endpoint.socket < 0) return answer(UDP_CONNECTION_CLOSED);
      sockaddr_in from{};
      socklen_t size = sizeof(from);
      const ssize_t count = ::recvfrom(endpoint.socket, receive->buffer, static_cast<std::size_t>(receive->size), 0,
                                       reinterpret_cast<sockaddr*>(&from), &size);
      if (count < 0 && (wouldWait(errno) || errno == ECONNREFUSED)) return false;
      if (count < 0) return answer(UDP_FAIL);
      receive->address = IPAddress(ntohl(from.sin_addr.s_addr));
      receive->port = robotPort(ntohs(from.sin_port));
      receive->size = static_cast<int>(count);
      return answer(UDP_SUCCESS);
    }
    case UDPEndpoint_Operation_Close:
      closeEndpoint(endpoint);
      return answer(UDP_SUCCESS);
    case UDPEndpoint_Operation_ReadyForRead:
      static_cast<UDPEndpointReadyForReadMsg*>(base)->ready = endpoint.socket >= 0 && readyFor(endpoint.socket, POLLIN);
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
