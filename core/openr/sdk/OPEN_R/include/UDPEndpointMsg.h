// What a UDP endpoint is asked for, and its answer.
#ifndef BTR_OPENR_UDPENDPOINTMSG_H
#define BTR_OPENR_UDPENDPOINTMSG_H

#include <EndpointTypes.h>
#include <IPAddress.h>
#include <antEnvMsg.h>

enum UDPEndpointError {
  UDP_SUCCESS = 0,
  UDP_FAIL = 1,
  UDP_CONNECTION_CLOSED = 2,
  UDP_CONNECTION_BUSY = 3,
  UDP_ADDRESSINUSE = 4,
  UDP_ADDRESSERROR = 5,
  UDP_PORT_UNREACHABLE = 6,
  UDP_PROTOCOL_UNREACHABLE = 7,
  UDP_HOST_UNREACHABLE = 8,
  UDP_NETWORK_UNREACHABLE = 9,
  UDP_MESSAGE_TOO_LONG = 10,
  UDP_TTL_EXCEEDED = 11,
  UDP_TIME_EXCEEDED = 12,
  UDP_BUFFER_INVALID = 13,
  UDP_OPERATION_INVALID = 14,
  UDP_OPERATION_UNKNOWN = 15,
  UDP_WOULDBLOCK = 16,
};

enum UDPEndpointOperation {
  UDPEndpoint_Operation_Bind = 0,
  UDPEndpoint_Operation_Connect = 1,
  UDPEndpoint_Operation_Send = 2,
  UDPEndpoint_Operation_Receive = 3,
  UDPEndpoint_Operation_Close = 4,
  UDPEndpoint_Operation_SetMulticastLoop = 5,
  UDPEndpoint_Operation_SetMulticastTTL = 6,
  UDPEndpoint_Operation_AddMembership = 7,
  UDPEndpoint_Operation_DropMembership = 8,
  UDPEndpoint_Operation_SetBlockingMode = 9,
  UDPEndpoint_Operation_ReadyForRead = 10,
  UDPEndpoint_Operation_ReadyForWrite = 11,
  UDPEndpoint_Operation_Address = 12,
  UDPEndpoint_Operation_ResetConnect = 13,
};

class UDPEndpointBaseMsg : public antEnvMsg {
 public:
  UDPEndpointError error;
  UDPEndpointBaseMsg() : error(UDP_SUCCESS) {}
  UDPEndpointBaseMsg(antModuleRef& _module, UDPEndpointOperation _operation)
      : antEnvMsg(_module, _operation), error(UDP_SUCCESS) {}
  antError Reply(UDPEndpointError _error) {
    error = _error;
    return antEnvMsg::Reply();
  }
};

class UDPEndpointBindMsg : public UDPEndpointBaseMsg {
 public:
  IPAddress address;
  Port port;
  UDPEndpointBindMsg() : port(0) {}
  UDPEndpointBindMsg(antModuleRef& _module, IPAddress _address, Port _port)
      : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_Bind), address(_address), port(_port) {}
};

class UDPEndpointConnectMsg : public UDPEndpointBaseMsg {
 public:
  IPAddress address;
  Port port;
  UDPEndpointConnectMsg() : port(0) {}
  UDPEndpointConnectMsg(antModuleRef& _module, IPAddress _address, Port _port)
      : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_Connect), address(_address), port(_port) {}
};

class UDPEndpointSendMsg : public UDPEndpointBaseMsg {
 public:
  IPAddress address;
  Port port;
  byte* buffer;
  int size;
  UDPEndpointSendMsg() : port(0), buffer(0), size(0) {}
  UDPEndpointSendMsg(antModuleRef& _module, byte* _buffer, int _size)
      : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_Send), port(0), buffer(_buffer), size(_size) {}
  UDPEndpointSendMsg(antModuleRef& _module, IPAddress _address, Port _port, byte* _buffer, int _size)
      : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_Send),
        address(_address),
        port(_port),
        buffer(_buffer),
        size(_size) {}
};

class UDPEndpointReceiveMsg : public UDPEndpointBaseMsg {
 public:
  IPAddress address;
  Port port;
  byte* buffer;
  int size;
  UDPEndpointReceiveMsg() : port(0), buffer(0), size(0) {}
  UDPEndpointReceiveMsg(antModuleRef& _module, byte* _buffer, int _size)
      : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_Receive), port(0), buffer(_buffer), size(_size) {}
};

class UDPEndpointCloseMsg : public UDPEndpointBaseMsg {
 public:
  bool linger;
  int lingerTime;
  UDPEndpointCloseMsg() : linger(false), lingerTime(0) {}
  UDPEndpointCloseMsg(antModuleRef& _module, bool _linger = false, int _lingerTime = 0)
      : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_Close), linger(_linger), lingerTime(_lingerTime) {}
};

class UDPEndpointSetBlockingModeMsg : public UDPEndpointBaseMsg {
 public:
  bool blocking;
  UDPEndpointSetBlockingModeMsg() : blocking(false) {}
  UDPEndpointSetBlockingModeMsg(antModuleRef& _module, bool _blocking)
      : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_SetBlockingMode), blocking(_blocking) {}
};

class UDPEndpointReadyForReadMsg : public UDPEndpointBaseMsg {
 public:
  boolean ready;
  UDPEndpointReadyForReadMsg() : ready(false) {}
  UDPEndpointReadyForReadMsg(antModuleRef& _module)
      : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_ReadyForRead), ready(false) {}
};

class UDPEndpointReadyForWriteMsg : public UDPEndpointBaseMsg {
 public:
  boolean ready;
  UDPEndpointReadyForWriteMsg() : ready(false) {}
  UDPEndpointReadyForWriteMsg(antModuleRef& _module)
      : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_ReadyForWrite), ready(false) {}
};

class UDPEndpointAddressMsg : public UDPEndpointBaseMsg {
 public:
  IPAddress lAddress;
  Port lPort;
  IPAddress fAddress;
  Port fPort;
  UDPEndpointAddressMsg() : lPort(0), fPort(0) {}
  UDPEndpointAddressMsg(antModuleRef& _module)
      : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_Address), lPort(0), fPort(0) {}
};

class UDPEndpointResetConnectMsg : public UDPEndpointBaseMsg {
 public:
  UDPEndpointResetConnectMsg() {}
  UDPEndpointResetConnectMsg(antModuleRef& _module) : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_ResetConnect) {}
};

class UDPEndpointSetMulticastLoopMsg : public UDPEndpointBaseMsg {
 public:
  Boolean enable;
  UDPEndpointSetMulticastLoopMsg() : enable(false) {}
  UDPEndpointSetMulticastLoopMsg(antModuleRef& _module, Boolean _enable)
      : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_SetMulticastLoop), enable(_enable) {}
};

class UDPEndpointSetMulticastTTLMsg : public UDPEndpointBaseMsg {
 public:
  byte ttl;
  UDPEndpointSetMulticastTTLMsg() : ttl(0) {}
  UDPEndpointSetMulticastTTLMsg(antModuleRef& _module, byte _ttl)
      : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_SetMulticastTTL), ttl(_ttl) {}
};

class UDPEndpointAddMembershipMsg : public UDPEndpointBaseMsg {
 public:
  IPAddress multiaddr;
  IPAddress interface;
  UDPEndpointAddMembershipMsg() {}
  UDPEndpointAddMembershipMsg(antModuleRef& _module, IPAddress _multiaddr, IPAddress _interface)
      : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_AddMembership),
        multiaddr(_multiaddr),
        interface(_interface) {}
};

class UDPEndpointDropMembershipMsg : public UDPEndpointBaseMsg {
 public:
  IPAddress multiaddr;
  IPAddress interface;
  UDPEndpointDropMembershipMsg() {}
  UDPEndpointDropMembershipMsg(antModuleRef& _module, IPAddress _multiaddr, IPAddress _interface)
      : UDPEndpointBaseMsg(_module, UDPEndpoint_Operation_DropMembership),
        multiaddr(_multiaddr),
        interface(_interface) {}
};

#endif
