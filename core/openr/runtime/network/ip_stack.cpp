#include "core/openr/runtime/network/ip_stack.h"

#include <TCPEndpointMsg.h>
#include <UDPEndpointMsg.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "core/openr/runtime/network/ip_sockets.h"

namespace btr::openr {

IpStack::IpStack(System& system) : system_(system), settings_(system.stick) {}

IpStack::~IpStack() { closeAll(); }

void IpStack::closeAll() {
  for (auto& [id, endpoint] : endpoints_) closeEndpoint(endpoint);
  for (auto& [port, listener] : listeners_) ::close(listener.socket);
  listeners_.clear();
  operations_.clear();
}

void IpStack::closeEndpoint(Endpoint& endpoint) {
  if (endpoint.socket >= 0) ::close(endpoint.socket);
  if (endpoint.ear >= 0) ::close(endpoint.ear);
  endpoint.socket = endpoint.ear = -1;
  endpoint.connected = false;
  if (endpoint.type == EndpointType_UDP) datagramPorts_.erase(endpoint.bound);
}

void IpStack::tell(const char* kind, Port port, Port actual) {
  system_.say("IPStack", std::string(kind) + " port " + std::to_string(port) +
                             " of the robot is 127.0.0.1:" + std::to_string(actual) +
                             (actual == twinOf(port) ? "" : ", as " + std::to_string(twinOf(port)) + " is in use"));
}

bool IpStack::mayUse(const void* address, int size) {
  if (size < 0 || address == nullptr) return false;
  const byte* begin = static_cast<const byte*>(address);
  for (const auto& [first, length] : buffers_)
    if (begin >= first && begin < first + length) return begin + size <= first + length;
  if (!toldOwnMemory_)
    system_.say("IPStack",
                "a program sends or receives in memory of its own; antEnvCreateSharedBufferMsg makes the "
                "buffers that are meant for that");
  toldOwnMemory_ = true;
  return true;
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
  allowBroadcasts(endpoint.socket);
  endpoint.bound = port == 0 ? actual : port;
  datagramPorts_[endpoint.bound] = actual;
  if (port == 0) return endpoint.socket;
  endpoint.ear = broadcastEar(twinOf(port));
  if (told_.insert({port, actual}).second) tell("UDP", port, actual);  // some programs bind it anew for each datagram
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
  return twinOf(port);
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
      const bool known = create->protocol == EndpointType_TCP || create->protocol == EndpointType_UDP ||
                         create->protocol == EndpointType_DNS;
      create->error = known ? ANT_SUCCESS : ANT_ENDPOINT_NOFACTORY;
      if (!known) return true;
      endpoints_[nextEndpoint_].type = create->protocol;
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
    case antEnv_Operation_InitSetParam: {
      auto* set = static_cast<antEnvInitSetParamMsg*>(message);
      settings_.set(set->key,
                    set->paramType == antEnv_InitParam_Int32 ? std::to_string(set->value.i32) : set->value.str);
      set->error = ANT_SUCCESS;
      return true;
    }
    case antEnv_Operation_InitGetParam: {
      auto* get = static_cast<antEnvInitGetParamMsg*>(message);
      const std::string key = get->key;
      // Whatever the stick says, the robot is found at this computer's own address.
      const std::string value =
          key == "ETHER_IP" ? IPAddress(loopbackAddress).GetAsString(get->value.str) : settings_.value(key);
      get->error = key == "ETHER_IP" || settings_.has(key) ? ANT_SUCCESS : ANT_REGISTRY_NO_KEY;
      get->paramType = antEnv_InitParam_String;
      std::snprintf(get->value.str, sizeof(get->value.str), "%s", value.c_str());
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
    dns(message, at->second);
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
  Operation operation{message, std::move(done), id};
  if (isTcp ? tcp(operation, at->second) : udp(operation, at->second)) return operation.done();
  operations_.push_back(std::move(operation));
}

void IpStack::poll(Polled polled) {
  for (auto at = operations_.begin(); at != operations_.end();) {
    const auto endpoint = endpoints_.find(at->endpoint);
    const bool listens = endpoint != endpoints_.end() && endpoint->second.type == EndpointType_TCP &&
                         at->message->dstOperation == TCPEndpoint_Operation_Listen;
    if (polled == Polled::listening && !listens) {
      ++at;
      continue;
    }
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

}  // namespace btr::openr
