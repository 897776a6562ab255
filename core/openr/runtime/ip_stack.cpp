#include "core/openr/runtime/ip_stack.h"

#include <DNSEndpointMsg.h>
#include <TCPEndpointMsg.h>
#include <UDPEndpointMsg.h>
#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

#include "core/openr/runtime/services.h"

namespace btr::openr {
namespace {

constexpr Port shift = 10000;  ///< of ports that only the computer's owner may open
constexpr Port firstFree = 1024;
const uint32 loopback = INADDR_LOOPBACK;

sockaddr_in addressOf(Port port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  return address;
}

Port portOf(int socket, bool peer) {
  sockaddr_in address{};
  socklen_t size = sizeof(address);
  const int status = peer ? getpeername(socket, reinterpret_cast<sockaddr*>(&address), &size)
                          : getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  return status == 0 ? ntohs(address.sin_port) : Port{0};
}

/// A socket bound to the port's twin on the loopback; -1 if there is none.
int boundSocket(int kind, Port port, Port& actual) {
  const Port wanted = port == 0 ? Port{0} : (port < firstFree ? static_cast<Port>(port + shift) : port);
  for (const Port each : {wanted, Port{0}}) {
    const int made = ::socket(AF_INET, kind | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (made < 0) return -1;
    const int yes = 1;
    if (kind == SOCK_STREAM) setsockopt(made, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
    const sockaddr_in address = addressOf(each);
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

}  // namespace

IpStack::IpStack(System& system) : system_(system) {}

IpStack::~IpStack() { closeAll(); }

void IpStack::closeAll() {
  for (auto& [id, endpoint] : endpoints_) closeEndpoint(endpoint);
  for (auto& [port, listener] : listeners_) ::close(listener.socket);
  listeners_.clear();
  operations_.clear();
}

void IpStack::closeEndpoint(Endpoint& endpoint) {
  if (endpoint.socket >= 0) ::close(endpoint.socket);
  endpoint.socket = -1;
  endpoint.connected = false;
  if (endpoint.type == EndpointType_UDP) datagramPorts_.erase(endpoint.bound);
}

void IpStack::tell(const char* kind, Port port, Port actual) {
  system_.say("IPStack", std::string(kind) + " port " + std::to_string(port) +
                             " of the robot is 127.0.0.1:" + std::to_string(actual));
}

bool IpStack::isShared(const void* address, int size) const {
  if (size < 0) return false;
  const byte* begin = static_cast<const byte*>(address);
  return std::any_of(buffers_.begin(), buffers_.end(), [&](const auto& buffer) {
    return begin >= buffer.first && begin + size <= buffer.first + buffer.second;
  });
}

IpStack::Listener* IpStack::listener(Port port) {
  const auto at = listeners_.find(port);
  if (at != listeners_.end()) return &at->second;
  Listener made;
  made.socket = boundSocket(SOCK_STREAM, port, made.actual);
  if (made.socket < 0) return nullptr;
  tell("TCP", port, made.actual);
  return &(listeners_[port] = made);
}

int IpStack::bindDatagram(Endpoint& endpoint, Port port) {
  Port actual = 0;
  endpoint.socket = boundSocket(SOCK_DGRAM, port, actual);
  if (endpoint.socket < 0) return -1;
  endpoint.bound = port == 0 ? actual : port;
  datagramPorts_[endpoint.bound] = actual;
  if (port != 0) tell("UDP", port, actual);
  return endpoint.socket;
}

/// Where others find port `port`: this robot's own, else by the rule.
Port IpStack::actualOf(Port port, bool tcp) const {
  if (tcp) {
    const auto at = listeners_.find(port);
    if (at != listeners_.end()) return at->second.actual;
  } else {
    const auto at = datagramPorts_.find(port);
    if (at != datagramPorts_.end()) return at->second;
  }
  return port < firstFree ? static_cast<Port>(port + shift) : port;
}

bool IpStack::stackOperation(antEnvMsg* message) {
  switch (message->dstOperation) {
    case antEnv_Operation_CreateSharedBuffer: {
      auto* create = static_cast<antEnvCreateSharedBufferMsg*>(message);
      void* memory = create->size > 0 && create->size <= (64 << 20)
                         ? std::calloc(1, static_cast<std::size_t>(create->size))
                         : nullptr;
      create->error = memory == nullptr ? ANT_NOMEMORY : ANT_SUCCESS;
      if (memory == nullptr) return true;
      buffers_[static_cast<byte*>(memory)] = create->size;
      create->buffer = antSharedBuffer(memory, create->size, static_cast<uint32>(buffers_.size()));
      return true;
    }
    case antEnv_Operation_DestroySharedBuffer: {
      auto* destroy = static_cast<antEnvDestroySharedBufferMsg*>(message);
      const auto at = buffers_.find(static_cast<byte*>(destroy->buffer.GetAddress()));
      destroy->error = at == buffers_.end() ? ANT_INVALIDPTR : ANT_SUCCESS;
      if (at != buffers_.end()) buffers_.erase(at);  // its memory stays: an operation may still use it
      return true;
    }
    case antEnv_Operation_CreateEndpoint: {
      auto* create = static_cast<antEnvCreateEndpointMsg*>(message);
      const bool known =
          create->type == EndpointType_TCP || create->type == EndpointType_UDP || create->type == EndpointType_DNS;
      create->error = known ? ANT_SUCCESS : ANT_ENDPOINT_NOFACTORY;
      if (!known) return true;
      endpoints_[nextEndpoint_].type = create->type;
      create->moduleRef = antModuleRef(nullptr, nextEndpoint_++);
      return true;
    }
    case antEnv_Operation_DestroyEndpoint: {
      auto* destroy = static_cast<antEnvDestroyEndpointMsg*>(message);
      const auto at = endpoints_.find(destroy->moduleRef.GetIndex());
      destroy->error = at == endpoints_.end() ? ANT_INVALIDMODULEID : ANT_SUCCESS;
      if (at == endpoints_.end()) return true;
      closeEndpoint(at->second);
      endpoints_.erase(at);
      return true;
    }
    default:
      return false;
  }
}

bool IpStack::busy(const Endpoint&, uint32 id, int operation) const {
  return std::any_of(operations_.begin(), operations_.end(), [&](const Operation& other) {
    return other.endpoint == id && other.message->dstOperation == operation;
  });
}

void IpStack::submit(antEnvMsg* message, std::function<void()> done) {
  if (stackOperation(message)) return done();
  const uint32 id = message->dstModule.GetIndex();
  const auto at = endpoints_.find(id);
  if (at == endpoints_.end()) {
    static_cast<TCPEndpointBaseMsg*>(message)->error = TCP_FAIL;  // the first answer of every kind of endpoint
    return done();
  }
  if (at->second.type == EndpointType_DNS) {
    dns(message);
    return done();
  }
  const bool isTcp = at->second.type == EndpointType_TCP;
  if (busy(at->second, id, message->dstOperation)) {
    if (isTcp)
      static_cast<TCPEndpointBaseMsg*>(message)->error = TCP_CONNECTION_BUSY;
    else
      static_cast<UDPEndpointBaseMsg*>(message)->error = UDP_CONNECTION_BUSY;
    return done();
  }
  Operation operation{message, std::move(done), id, 0, 0, false};
  if (isTcp ? tcp(operation, at->second) : udp(operation, at->second)) return operation.done();
  operations_.push_back(std::move(operation));
}

void IpStack::poll() {
  for (auto at = operations_.begin(); at != operations_.end();) {
    const auto endpoint = endpoints_.find(at->endpoint);
    bool over = true;
    if (endpoint == endpoints_.end())
      static_cast<TCPEndpointBaseMsg*>(at->message)->error = TCP_FAIL;
    else
      over = endpoint->second.type == EndpointType_TCP ? tcp(*at, endpoint->second) : udp(*at, endpoint->second);
    if (!over) {
      ++at;
      continue;
    }
    const auto done = std::move(at->done);
    at = operations_.erase(at);
    done();
  }
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
      Listener* at = listener(listen->lPort);
      if (at == nullptr) return answer(TCP_ADDRESSINUSE);
      const int accepted = ::accept4(at->socket, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
      if (accepted < 0) return false;
      endpoint.socket = accepted;
      endpoint.connected = true;
      listen->lAddress = listen->fAddress = IPAddress(loopback);
      listen->fPort = portOf(accepted, true);
      return answer(TCP_SUCCESS);
    }
    case TCPEndpoint_Operation_Connect: {
      auto* connect = static_cast<TCPEndpointConnectMsg*>(base);
      if (!operation.begun) {
        if (endpoint.connected) return answer(TCP_CONNECTION_BUSY);
        endpoint.socket = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
        const sockaddr_in address = addressOf(actualOf(connect->fPort, true));
        operation.begun = true;
        if (::connect(endpoint.socket, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0 &&
            !wouldWait(errno)) {
          closeEndpoint(endpoint);
          return answer(TCP_PORT_UNREACHABLE);
        }
      }
      if (endpoint.socket < 0) return answer(TCP_CONNECTION_CLOSED);
      if (!readyFor(endpoint.socket, POLLOUT)) return false;
      int error = 0;
      socklen_t size = sizeof(error);
      getsockopt(endpoint.socket, SOL_SOCKET, SO_ERROR, &error, &size);
      if (error != 0) {
        closeEndpoint(endpoint);
        return answer(TCP_PORT_UNREACHABLE);
      }
      endpoint.connected = true;
      connect->lAddress = IPAddress(loopback);
      connect->lPort = portOf(endpoint.socket, false);
      return answer(TCP_SUCCESS);
    }
    case TCPEndpoint_Operation_Send: {
      auto* send = static_cast<TCPEndpointSendMsg*>(base);
      if (!isShared(send->buffer, send->size)) return answer(TCP_BUFFER_INVALID);
      if (!endpoint.connected) return answer(TCP_CONNECTION_CLOSED);
      while (operation.sent < send->size) {
        const ssize_t count = ::send(endpoint.socket, send->buffer + operation.sent,
                                     static_cast<std::size_t>(send->size - operation.sent), MSG_NOSIGNAL);
        if (count < 0 && wouldWait(errno)) return false;
        if (count <= 0) return answer(TCP_CONNECTION_CLOSED);
        operation.sent += static_cast<int>(count);
      }
      return answer(TCP_SUCCESS);
    }
    case TCPEndpoint_Operation_Receive: {
      auto* receive = static_cast<TCPEndpointReceiveMsg*>(base);
      if (!operation.begun && !isShared(receive->buffer, receive->sizeMax)) return answer(TCP_BUFFER_INVALID);
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
        if (count == 0 || !wouldWait(errno)) error = count == 0 ? TCP_CONNECTION_CLOSED : TCP_CONNECTION_RESET;
        break;
      }
      const bool enough = operation.received > 0 && operation.received >= receive->sizeMin;
      if (!enough && error == TCP_SUCCESS && receive->sizeMax > 0) return false;
      receive->sizeMin = receive->sizeMax = operation.received;
      return answer(enough ? TCP_SUCCESS : error);
    }
    case TCPEndpoint_Operation_Close:
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
      address->lAddress = address->fAddress = IPAddress(loopback);
      address->lPort = portOf(endpoint.socket, false);
      address->fPort = portOf(endpoint.socket, true);
      return answer(TCP_SUCCESS);
    }
    case TCPEndpoint_Operation_Bind:
    case TCPEndpoint_Operation_SetBlockingMode:
    case TCPEndpoint_Operation_BacklogQueues:
      return answer(TCP_SUCCESS);
    default:
      return answer(TCP_OPERATION_UNKNOWN);
  }
}

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
      const sockaddr_in address = addressOf(actualOf(connect->port, false));
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
      const sockaddr_in address = addressOf(actualOf(send->port, false));
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
      address->lAddress = address->fAddress = IPAddress(loopback);
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

void IpStack::dns(antEnvMsg* message) {
  auto* base = static_cast<DNSEndpointBaseMsg*>(message);
  base->error = DNS_SUCCESS;
  if (message->dstOperation == DNSEndpoint_Operation_GetHostByName) {
    auto* query = static_cast<DNSEndpointGetHostByNameMsg*>(base);
    in_addr address{};
    if (std::strcmp(query->name, "localhost") == 0)
      query->address = IPAddress(loopback);
    else if (inet_pton(AF_INET, query->name, &address) == 1)
      query->address = IPAddress(ntohl(address.s_addr));
    else
      base->error = DNS_HOST_NOT_FOUND;
    query->addresses[0] = query->address;
    query->numAddresses = base->error == DNS_SUCCESS ? 1 : 0;
  } else if (message->dstOperation == DNSEndpoint_Operation_GetHostByAddr) {
    auto* query = static_cast<DNSEndpointGetHostByAddrMsg*>(base);
    if (query->address.InLoop())
      std::strcpy(query->name, "localhost");
    else
      base->error = DNS_HOST_NOT_FOUND;
  }
}

}  // namespace btr::openr

// ---- what programs call -----------------------------------------------------------------------------------------

using btr::openr::System;

antStackRef::antStackRef(const char* name_) : disp_(nullptr) {
  if (name_ != nullptr && std::strcmp(name_, "IPStack") == 0) oid.Set(reinterpret_cast<void*>(0x1));
}

antError antEnvMsg::Send(antStackRef _target, OID& _sender, int32 _selector, int _msgSize) {
  if (!_target.IsValid() || _msgSize < static_cast<int>(sizeof(antEnvMsg)) || _msgSize > 65536) return ANT_FAIL;
  constexpr std::size_t least = 2048;  // room for every kind of answer
  const std::size_t size = static_cast<std::size_t>(_msgSize);
  std::shared_ptr<void> copy(std::calloc(1, std::max(least, size)), std::free);
  std::memcpy(copy.get(), static_cast<const void*>(this), size);
  auto* message = static_cast<antEnvMsg*>(copy.get());
  message->sender = _sender;
  message->msgSize = _msgSize;
  message->invocationType = ANTENVMSG_SEND;
  const OServiceEntry entry(_sender, static_cast<Selector>(_selector));
  System& system = System::instance();
  system.services().ip().submit(message, [&system, copy, entry] { system.send(entry, copy); });
  return ANT_SUCCESS;
}

antError antEnvMsg::Call(antStackRef _dest, int _msgSize) {
  if (!_dest.IsValid()) return ANT_FAIL;
  msgSize = _msgSize;
  invocationType = ANTENVMSG_CALL;
  auto over = std::make_shared<bool>(false);
  System& system = System::instance();
  system.services().ip().submit(this, [over] { *over = true; });
  return system.waitUntil([over] { return *over; }) ? ANT_SUCCESS : ANT_FAIL;
}

IPAddress::IPAddress(const char* str) : address_(0) {
  in_addr address{};
  if (str != nullptr && inet_pton(AF_INET, str, &address) == 1) address_ = ntohl(address.s_addr);
}

char* IPAddress::GetAsString(char* text) const {
  std::sprintf(text, "%u.%u.%u.%u", address_ >> 24, (address_ >> 16) & 255, (address_ >> 8) & 255, address_ & 255);
  return text;
}

OSTREAM& IPAddress::print(OSTREAM& os) const {
  char text[16];
  return os << GetAsString(text);
}
