// What a TCP endpoint is asked for, and its answer.
#ifndef BTR_OPENR_TCPENDPOINTMSG_H
#define BTR_OPENR_TCPENDPOINTMSG_H

#include <EndpointTypes.h>
#include <IPAddress.h>
#include <antEnvMsg.h>

enum TCPEndpointError {
  TCP_SUCCESS = 0,
  TCP_FAIL = 1,
  TCP_CONNECTION_CLOSED = 2,
  TCP_CONNECTION_RESET = 3,
  TCP_CONNECTION_TIMEOUT = 4,
  TCP_CONNECTION_BUSY = 5,
  TCP_ADDRESSINUSE = 6,
  TCP_ADDRESSERROR = 7,
  TCP_PORT_UNREACHABLE = 8,
  TCP_PROTOCOL_UNREACHABLE = 9,
  TCP_HOST_UNREACHABLE = 10,
  TCP_NETWORK_UNREACHABLE = 11,
  TCP_MESSAGE_TOO_LONG = 12,
  TCP_TTL_EXCEEDED = 13,
  TCP_TIME_EXCEEDED = 14,
  TCP_WOULDBLOCK = 15,
  TCP_BUFFER_INVALID = 16,
  TCP_OPERATION_INVALID = 17,
  TCP_OPERATION_UNKNOWN = 18,
};

enum TCPEndpointOperation {
  TCPEndpoint_Operation_Bind = 1,
  TCPEndpoint_Operation_Listen = 2,
  TCPEndpoint_Operation_Connect = 3,
  TCPEndpoint_Operation_Send = 4,
  TCPEndpoint_Operation_Receive = 5,
  TCPEndpoint_Operation_Close = 6,
  TCPEndpoint_Operation_SetBlockingMode = 7,
  TCPEndpoint_Operation_ReadyForRead = 8,
  TCPEndpoint_Operation_ReadyForWrite = 9,
  TCPEndpoint_Operation_BacklogListen = 10,
  TCPEndpoint_Operation_Accept = 11,
  TCPEndpoint_Operation_BacklogQueues = 12,
  TCPEndpoint_Operation_Address = 13,
};

class TCPEndpointBaseMsg : public antEnvMsg {
 public:
  TCPEndpointError error;
  TCPEndpointBaseMsg() : error(TCP_SUCCESS) {}
  TCPEndpointBaseMsg(antModuleRef& _module, TCPEndpointOperation _operation)
      : antEnvMsg(_module, _operation), error(TCP_SUCCESS) {}
  antError Reply(TCPEndpointError _error) {
    error = _error;
    return antEnvMsg::Reply();
  }
};

class TCPEndpointBacklogQueueMsg : public TCPEndpointBaseMsg {
 public:
  int16 backlog;
  TCPEndpointBacklogQueueMsg() : backlog(0) {}
  TCPEndpointBacklogQueueMsg(antModuleRef& _module, int16 _backlog)
      : TCPEndpointBaseMsg(_module, TCPEndpoint_Operation_BacklogQueues), backlog(_backlog) {}
};

class TCPEndpointBindMsg : public TCPEndpointBaseMsg {
 public:
  IPAddress lAddress;
  Port lPort;
  TCPEndpointBindMsg() : lPort(0) {}
  TCPEndpointBindMsg(antModuleRef& _module, IPAddress _lAddress, Port _lPort)
      : TCPEndpointBaseMsg(_module, TCPEndpoint_Operation_Bind), lAddress(_lAddress), lPort(_lPort) {}
};

class TCPEndpointListenMsg : public TCPEndpointBaseMsg {
 public:
  IPAddress lAddress;
  Port lPort;
  IPAddress fAddress;
  Port fPort;
  TCPEndpointListenMsg() : lPort(0), fPort(0) {}
  TCPEndpointListenMsg(antModuleRef& _module, IPAddress _lAddress = 0, Port _lPort = 0, IPAddress _fAddress = 0,
                       Port _fPort = 0)
      : TCPEndpointBaseMsg(_module, TCPEndpoint_Operation_Listen),
        lAddress(_lAddress),
        lPort(_lPort),
        fAddress(_fAddress),
        fPort(_fPort) {}
};

class TCPEndpointBacklogListenMsg : public TCPEndpointBaseMsg {
 public:
  IPAddress lAddress;
  Port lPort;
  IPAddress fAddress;
  Port fPort;
  TCPEndpointBacklogListenMsg() : lPort(0), fPort(0) {}
  TCPEndpointBacklogListenMsg(antModuleRef& _module, IPAddress _lAddress = 0, Port _lPort = 0, IPAddress _fAddress = 0,
                              Port _fPort = 0)
      : TCPEndpointBaseMsg(_module, TCPEndpoint_Operation_BacklogListen),
        lAddress(_lAddress),
        lPort(_lPort),
        fAddress(_fAddress),
        fPort(_fPort) {}
};

class TCPEndpointAcceptMsg : public TCPEndpointBaseMsg {
 public:
  IPAddress lAddress;
  Port lPort;
  IPAddress fAddress;
  Port fPort;
  int16 queueNr;
  TCPEndpointAcceptMsg() : lPort(0), fPort(0), queueNr(0) {}
  TCPEndpointAcceptMsg(antModuleRef& _module)
      : TCPEndpointBaseMsg(_module, TCPEndpoint_Operation_Accept), lPort(0), fPort(0), queueNr(0) {}
};

class TCPEndpointConnectMsg : public TCPEndpointBaseMsg {
 public:
  IPAddress lAddress;
  Port lPort;
  IPAddress fAddress;
  Port fPort;
  TCPEndpointConnectMsg() : lPort(0), fPort(0) {}
  TCPEndpointConnectMsg(antModuleRef& _module, IPAddress _lAddress, Port _lPort, IPAddress _fAddress, Port _fPort)
      : TCPEndpointBaseMsg(_module, TCPEndpoint_Operation_Connect),
        lAddress(_lAddress),
        lPort(_lPort),
        fAddress(_fAddress),
        fPort(_fPort) {}
};

class TCPEndpointSendMsg : public TCPEndpointBaseMsg {
 public:
  byte* buffer;
  int size;
  int16 queueNr;
  TCPEndpointSendMsg() : buffer(0), size(0), queueNr(0) {}
  TCPEndpointSendMsg(antModuleRef& _module, byte* _buffer, int _size, int16 _queueNr = 0)
      : TCPEndpointBaseMsg(_module, TCPEndpoint_Operation_Send), buffer(_buffer), size(_size), queueNr(_queueNr) {}
};

class TCPEndpointReceiveMsg : public TCPEndpointBaseMsg {
 public:
  byte* buffer;
  int sizeMin;
  int sizeMax;
  int16 queueNr;
  TCPEndpointReceiveMsg() : buffer(0), sizeMin(0), sizeMax(0), queueNr(0) {}
  TCPEndpointReceiveMsg(antModuleRef& _module, byte* _buffer, int _sizeMin, int _sizeMax, int16 _queueNr = 0)
      : TCPEndpointBaseMsg(_module, TCPEndpoint_Operation_Receive),
        buffer(_buffer),
        sizeMin(_sizeMin),
        sizeMax(_sizeMax),
        queueNr(_queueNr) {}
};

class TCPEndpointCloseMsg : public TCPEndpointBaseMsg {
 public:
  bool abort;
  bool linger;
  int lingerTime;
  int16 queueNr;
  TCPEndpointCloseMsg() : abort(false), linger(false), lingerTime(0), queueNr(0) {}
  TCPEndpointCloseMsg(antModuleRef& _module, bool _linger = false, int _lingerTime = 0, bool _abort = false,
                      int16 _queueNr = -100)
      : TCPEndpointBaseMsg(_module, TCPEndpoint_Operation_Close),
        abort(_abort),
        linger(_linger),
        lingerTime(_lingerTime),
        queueNr(_queueNr) {}
};

class TCPEndpointSetBlockingModeMsg : public TCPEndpointBaseMsg {
 public:
  bool blocking;
  int16 queueNr;
  TCPEndpointSetBlockingModeMsg() : blocking(false), queueNr(0) {}
  TCPEndpointSetBlockingModeMsg(antModuleRef& _module, bool _blocking, int16 _queueNr = 0)
      : TCPEndpointBaseMsg(_module, TCPEndpoint_Operation_SetBlockingMode), blocking(_blocking), queueNr(_queueNr) {}
};

class TCPEndpointReadyForReadMsg : public TCPEndpointBaseMsg {
 public:
  boolean ready;
  int16 queueNr;
  TCPEndpointReadyForReadMsg() : ready(false), queueNr(0) {}
  TCPEndpointReadyForReadMsg(antModuleRef& _module, int16 _queueNr = 0)
      : TCPEndpointBaseMsg(_module, TCPEndpoint_Operation_ReadyForRead), ready(false), queueNr(_queueNr) {}
};

class TCPEndpointReadyForWriteMsg : public TCPEndpointBaseMsg {
 public:
  boolean ready;
  int16 queueNr;
  TCPEndpointReadyForWriteMsg() : ready(false), queueNr(0) {}
  TCPEndpointReadyForWriteMsg(antModuleRef& _module, int16 _queueNr = 0)
      : TCPEndpointBaseMsg(_module, TCPEndpoint_Operation_ReadyForWrite), ready(false), queueNr(_queueNr) {}
};

class TCPEndpointAddressMsg : public TCPEndpointBaseMsg {
 public:
  int16 queueNr;
  IPAddress lAddress;
  Port lPort;
  IPAddress fAddress;
  Port fPort;
  TCPEndpointAddressMsg() : queueNr(0), lPort(0), fPort(0) {}
  TCPEndpointAddressMsg(antModuleRef& _module, int16 _queueNr = 0)
      : TCPEndpointBaseMsg(_module, TCPEndpoint_Operation_Address), queueNr(_queueNr), lPort(0), fPort(0) {}
};

#endif
