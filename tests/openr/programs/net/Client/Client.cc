#include "Client.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

static const char* const SERVER = "10.0.1.100";

Client::Client() : stack("IPStack") {}

OStatus Client::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;

  return oSUCCESS;
}

OStatus Client::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  antEnvCreateEndpointMsg create(EndpointType_TCP, 512);
  create.Call(stack, sizeof(create));
  endpoint = create.moduleRef;
  TCPEndpointConnectMsg connect(endpoint, IP_ADDR_ANY, IP_PORT_ANY, SERVER, 54321);
  connect.Send(stack, myOID_, Extra_Entry[entryConnected], sizeof(connect));
  return oSUCCESS;
}

OStatus Client::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Client::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void Client::Connected(ANTENVMSG msg) {
  TCPEndpointConnectMsg* message = (TCPEndpointConnectMsg*)antEnvMsg::Receive(msg);
  std::cout << "connected " << (message->error == TCP_SUCCESS) << " to " << IPAddress(SERVER) << std::endl;
  antEnvCreateSharedBufferMsg memory(64);
  memory.Call(stack, sizeof(memory));
  memory.buffer.Map();
  byte* data = (byte*)memory.buffer.GetAddress();
  char own[9];  // no shared buffer: that passes
  strcpy(own, "over TCP");
  TCPEndpointSendMsg send(endpoint, (byte*)own, 9);
  send.Call(stack, sizeof(send));
  memset(data, 0, 64);
  TCPEndpointReceiveMsg receive(endpoint, data, 9, 64);
  receive.Call(stack, sizeof(receive));
  OSYSPRINT(("client: %s, %d bytes\n", data, receive.sizeMax));
  TCPEndpointCloseMsg close(endpoint);
  close.Call(stack, sizeof(close));

  TCPEndpointConnectMsg nobody(endpoint, IP_ADDR_ANY, IP_PORT_ANY, SERVER, 9);
  nobody.Call(stack, sizeof(nobody));
  OSYSPRINT(("nobody %d\n", nobody.error == TCP_PORT_UNREACHABLE));

  antEnvCreateEndpointMsg create(EndpointType_UDP, 512);
  create.Call(stack, sizeof(create));
  strcpy((char*)data, "over UDP");
  UDPEndpointSendMsg datagram(create.moduleRef, IPAddress(10, 0, 1, 100), 54322, data, 9);
  datagram.Call(stack, sizeof(datagram));
  memset(data, 0, 64);
  UDPEndpointReceiveMsg answer(create.moduleRef, data, 64);
  answer.Call(stack, sizeof(answer));
  OSYSPRINT(("client: %s from port %d\n", data, answer.port));
}
