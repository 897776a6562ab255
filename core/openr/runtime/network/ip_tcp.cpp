// What a TCP endpoint is asked for.
#include <TCPEndpointMsg.h>
#include <errno.h>
#include <poll.h>
#include <sys/socket.h>

#include <cstdint>

#include "core/openr/runtime/network/ip_sockets.h"
#include "core/openr/runtime/network/ip_stack.h"

namespace btr::openr {
namespace {

/// Robots of a game are switched on at one moment, but their programs here begin one after another: until then a port
/// at which nobody listens yet is tried again with each frame.
constexpr std::int64_t allHaveBegun_us = 64'000;

}  // namespace

void IpStack::beginConnect(Endpoint& endpoint, Port actual) {
  endpoint.socket = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const sockaddr_in address = loopbackAt(actual);
  if (endpoint.socket >= 0) ::connect(endpoint.socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address));
}

bool IpStack::tcp(Operation& operation, Endpoint& endpoint) {
  auto* base = static_cast<TCPEndpointBaseMsg*>(operation.message);
  const auto answer = [base](TCPEndpointError error) {
    base->error = error;
    return true;
  };
  switch (operation.message->dstOperation) {
    case TCPEndpoint_Operation_Listen:
    case TCPEndpoint_Operation_BacklogListen: {
      auto* listen = static_cast<TCPEndpointListenMsg*>(base);
      if (endpoint.connected) return answer(TCP_CONNECTION_BUSY);
      if (!operation.begun) operation.closes = endpoint.closes;
      operation.begun = true;
      if (operation.closes != endpoint.closes) return answer(TCP_CONNECTION_CLOSED);
      // Without a port of its own it is the bound one's.
      if (listen->lPort == 0) listen->lPort = endpoint.bound;
      Listener* at = listener(listen->lPort);
      if (at == nullptr) return answer(TCP_ADDRESSINUSE);
      const int accepted = ::accept4(at->socket, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
      if (accepted < 0) return false;
      endpoint.socket = accepted;
      endpoint.connected = true;
      listen->lAddress = listen->fAddress = IPAddress(loopbackAddress);
      listen->fPort = portOf(accepted, true);
      return answer(TCP_SUCCESS);
    }
    case TCPEndpoint_Operation_Connect: {
      auto* connect = static_cast<TCPEndpointConnectMsg*>(base);
      if (!operation.begun) {
        if (endpoint.connected) return answer(TCP_CONNECTION_BUSY);
        operation.begun = true;
        beginConnect(endpoint, actualOf(connect->fPort, true));
      }
      if (endpoint.socket < 0) return answer(TCP_CONNECTION_CLOSED);
      if (!readyFor(endpoint.socket, POLLOUT)) return false;
      int error = 0;
      socklen_t size = sizeof(error);
      getsockopt(endpoint.socket, SOL_SOCKET, SO_ERROR, &error, &size);
      if (error != 0) {
        closeEndpoint(endpoint);
        // Nobody at the twin: at the port itself, which a server of the computer's may have.
        const bool again = connect->fPort < firstFreePort && operation.sent == 0;
        operation.sent = 1;
        if (!again && system_.time_us() < allHaveBegun_us) {
          operation.begun = false;
          operation.sent = 0;
          return false;
        }
        if (!again) return answer(TCP_PORT_UNREACHABLE);
        beginConnect(endpoint, connect->fPort);
        return false;
      }
      endpoint.connected = true;
      connect->lAddress = IPAddress(loopbackAddress);
      connect->lPort = portOf(endpoint.socket, false);
      return answer(TCP_SUCCESS);
    }
    case TCPEndpoint_Operation_Send: {
      auto* send = static_cast<TCPEndpointSendMsg*>(base);
      if (!mayUse(send->buffer, send->size)) return answer(TCP_BUFFER_INVALID);
      if (!endpoint.connected) return answer(TCP_CONNECTION_CLOSED);
      while (operation.sent < send->size) {
        const ssize_t count = ::send(endpoint.socket, send->buffer + operation.sent,
                                     static_cast<std::size_t>(send->size - operation.sent), MSG_NOSIGNAL);
        if (count < 0 && wouldWait(errno)) return false;
        if (count <= 0) return answer(count < 0 && errno == EFAULT ? TCP_BUFFER_INVALID : TCP_CONNECTION_CLOSED);
        operation.sent += static_cast<int>(count);
      }
      return answer(TCP_SUCCESS);
    }
    case TCPEndpoint_Operation_Receive: {
      auto* receive = static_cast<TCPEndpointReceiveMsg*>(base);
      if (!operation.begun && !mayUse(receive->buffer, receive->sizeMax)) return answer(TCP_BUFFER_INVALID);
      operation.begun = true;
      if (!endpoint.connected) return answer(TCP_CONNECTION_CLOSED);
      TCPEndpointError error = TCP_SUCCESS;
      while (operation.received < receive->sizeMax) {
        const ssize_t count = ::recv(endpoint.socket, receive->buffer + operation.received,
                                     static_cast<std::size_t>(receive->sizeMax - operation.received), 0);
        if (count > 0) {
          operation.received += static_cast<int>(count);
          continue;
        }
        if (count < 0 && errno == EFAULT) return answer(TCP_BUFFER_INVALID);
        if (count == 0 || !wouldWait(errno)) error = count == 0 ? TCP_CONNECTION_CLOSED : TCP_CONNECTION_RESET;
        break;
      }
      const bool enough = operation.received > 0 && operation.received >= receive->sizeMin;
      if (!enough && error == TCP_SUCCESS && receive->sizeMax > 0) return false;
      // Who connected before these bytes were sent is told before them: a server of files answers on that connection.
      poll(Polled::listening);
      receive->sizeMin = receive->sizeMax = operation.received;
      return answer(enough ? TCP_SUCCESS : error);
    }
    case TCPEndpoint_Operation_Close:
      ++endpoint.closes;  // what waits on it ends
      closeEndpoint(endpoint);
      return answer(TCP_SUCCESS);
    case TCPEndpoint_Operation_ReadyForRead:
      static_cast<TCPEndpointReadyForReadMsg*>(base)->ready = endpoint.connected && readyFor(endpoint.socket, POLLIN);
      return answer(endpoint.connected ? TCP_SUCCESS : TCP_CONNECTION_CLOSED);
    case TCPEndpoint_Operation_ReadyForWrite:
      static_cast<TCPEndpointReadyForWriteMsg*>(base)->ready = endpoint.connected && readyFor(endpoint.socket, POLLOUT);
      return answer(endpoint.connected ? TCP_SUCCESS : TCP_CONNECTION_CLOSED);
    case TCPEndpoint_Operation_Address: {
      auto* address = static_cast<TCPEndpointAddressMsg*>(base);
      if (!endpoint.connected) return answer(TCP_CONNECTION_CLOSED);
      address->lAddress = address->fAddress = IPAddress(loopbackAddress);
      address->lPort = portOf(endpoint.socket, false);
      address->fPort = portOf(endpoint.socket, true);
      return answer(TCP_SUCCESS);
    }
    case TCPEndpoint_Operation_Bind:
      endpoint.bound = static_cast<TCPEndpointBindMsg*>(base)->lPort;
      return answer(TCP_SUCCESS);
    case TCPEndpoint_Operation_SetBlockingMode:
    case TCPEndpoint_Operation_BacklogQueues:
      return answer(TCP_SUCCESS);
    default:
      return answer(TCP_OPERATION_UNKNOWN);
  }
}

}  // namespace btr::openr
