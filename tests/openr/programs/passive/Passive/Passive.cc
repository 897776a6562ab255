// A server that is told over one connection to use another, which was made before.
#include "Passive.h"

#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

const Port orders = 45021, data = 45020;

Passive::Passive() : bytes(0) {}

OStatus Passive::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  return oSUCCESS;
}

antModuleRef Passive::Endpoint() {
  antEnvCreateEndpointMsg create(EndpointType_TCP, 2048);
  create.Call(stack, sizeof(create));
  return create.moduleRef;
}

OStatus Passive::DoStart(const OSystemEvent& event) {
  stack = antStackRef("IPStack");
  antEnvCreateSharedBufferMsg shared(1024);
  shared.Call(stack, sizeof(shared));
  buffer = shared.buffer;
  buffer.Map();
  bytes = (byte*)buffer.GetAddress();
  server = Endpoint();
  client = Endpoint();
  serverData = Endpoint();
  clientData = Endpoint();
  TCPEndpointListenMsg listen(server, IP_ADDR_ANY, orders);
  listen.Send(stack, myOID_, Extra_Entry[entryListenCont], sizeof(listen));
  TCPEndpointConnectMsg connect(client, IP_ADDR_ANY, IP_PORT_ANY, IPAddress("127.0.0.1"), orders);
  connect.Send(stack, myOID_, Extra_Entry[entryConnectCont], sizeof(connect));
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

void Passive::ConnectCont(ANTENVMSG msg) { antEnvMsg::Receive(msg); }

void Passive::ListenCont(ANTENVMSG msg) {
  TCPEndpointListenMsg* told = (TCPEndpointListenMsg*)antEnvMsg::Receive(msg);
  OSYSPRINT(("connected %d\n", told->error));
  TCPEndpointReceiveMsg receive(server, bytes, 1, 100);
  receive.Send(stack, myOID_, Extra_Entry[entryReceiveCont], sizeof(receive));
  TCPEndpointListenMsg listen(serverData, IP_ADDR_ANY, data);
  listen.Send(stack, myOID_, Extra_Entry[entryDataListenCont], sizeof(listen));
  TCPEndpointConnectMsg connect(clientData, IP_ADDR_ANY, IP_PORT_ANY, IPAddress("127.0.0.1"), data);
  connect.Send(stack, myOID_, Extra_Entry[entryDataConnectCont], sizeof(connect));
}

void Passive::DataConnectCont(ANTENVMSG msg) {
  antEnvMsg::Receive(msg);
  memcpy(bytes + 512, "LIST", 4);
  TCPEndpointSendMsg send(client, bytes + 512, 4);
  send.Send(stack, myOID_, Extra_Entry[entrySendCont], sizeof(send));
}

void Passive::SendCont(ANTENVMSG msg) { antEnvMsg::Receive(msg); }

void Passive::DataListenCont(ANTENVMSG msg) {
  TCPEndpointListenMsg* told = (TCPEndpointListenMsg*)antEnvMsg::Receive(msg);
  OSYSPRINT(("data connection %d\n", told->error));
}

void Passive::ReceiveCont(ANTENVMSG msg) {
  TCPEndpointReceiveMsg* told = (TCPEndpointReceiveMsg*)antEnvMsg::Receive(msg);
  OSYSPRINT(("order %d: %.4s\n", told->error, told->buffer));
  TCPEndpointSendMsg send(serverData, bytes, 4);
  send.Call(stack, sizeof(send));
  OSYSPRINT(("sent %d\n", send.error));
}

OStatus Passive::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Passive::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}
