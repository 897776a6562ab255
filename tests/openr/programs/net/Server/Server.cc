// Sends back what it receives, over TCP (two at a time) and UDP.
#include "Server.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

Server::Server() : stack("IPStack") {}

OStatus Server::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;

  return oSUCCESS;
}

OStatus Server::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  for (int i = 0; i < 2; i++) {
    antEnvCreateSharedBufferMsg memory(256);
    memory.Call(stack, sizeof(memory));
    buffers[i] = memory.buffer;
    buffers[i].Map();
    antEnvCreateEndpointMsg create(EndpointType_TCP, 512);
    create.Call(stack, sizeof(create));
    OSYSPRINT(("endpoint %d\n", create.error == ANT_SUCCESS));
    endpoints[i] = create.moduleRef;
    listen(i);
  }
  antEnvCreateSharedBufferMsg memory(256);
  memory.Call(stack, sizeof(memory));
  datagramBuffer = memory.buffer;
  datagramBuffer.Map();
  antEnvCreateEndpointMsg create(EndpointType_UDP, 512);
  create.Call(stack, sizeof(create));
  datagrams = create.moduleRef;
  UDPEndpointBindMsg bind(datagrams, IP_ADDR_ANY, 54322);
  bind.Call(stack, sizeof(bind));
  OSYSPRINT(("bound %d\n", bind.error == UDP_SUCCESS));
  receiveDatagram();
  return oSUCCESS;
}

OStatus Server::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Server::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void Server::listen(int which) {
  TCPEndpointListenMsg message(endpoints[which], IP_ADDR_ANY, 54321, IP_ADDR_ANY, IP_PORT_ANY);
  message.continuation = (void*)which;
  message.Send(stack, myOID_, Extra_Entry[entryListenDone], sizeof(message));
}

void Server::ListenDone(ANTENVMSG msg) {
  TCPEndpointListenMsg* message = (TCPEndpointListenMsg*)antEnvMsg::Receive(msg);
  const int which = (int)message->continuation;
  if (message->error != TCP_SUCCESS) return;
  OSYSPRINT(("accepted\n"));
  TCPEndpointReceiveMsg beyond(endpoints[which], (byte*)buffers[which].GetAddress(), 1, buffers[which].GetSize() + 1);
  beyond.Call(stack, sizeof(beyond));
  TCPEndpointReceiveMsg nowhere(endpoints[which], 0, 1, 16);
  nowhere.Call(stack, sizeof(nowhere));
  TCPEndpointSendMsg unmapped(endpoints[which], (byte*)4096, 16);
  unmapped.Call(stack, sizeof(unmapped));
  OSYSPRINT(("beyond %d, nowhere %d, unmapped %d\n", beyond.error == TCP_BUFFER_INVALID,
             nowhere.error == TCP_BUFFER_INVALID, unmapped.error == TCP_BUFFER_INVALID));
  TCPEndpointReceiveMsg receive(endpoints[which], (byte*)buffers[which].GetAddress(), 1, buffers[which].GetSize());
  receive.continuation = (void*)which;
  receive.Send(stack, myOID_, Extra_Entry[entryReceiveDone], sizeof(receive));
}

void Server::ReceiveDone(ANTENVMSG msg) {
  TCPEndpointReceiveMsg* message = (TCPEndpointReceiveMsg*)antEnvMsg::Receive(msg);
  const int which = (int)message->continuation;
  if (message->error != TCP_SUCCESS) {
    OSYSPRINT(("server: closed %d\n", message->error == TCP_CONNECTION_CLOSED));
    TCPEndpointCloseMsg close(endpoints[which]);
    close.continuation = (void*)which;
    close.Send(stack, myOID_, Extra_Entry[entryCloseDone], sizeof(close));
    return;
  }
  OSYSPRINT(("server: %d bytes\n", message->sizeMin));
  TCPEndpointSendMsg send(endpoints[which], (byte*)buffers[which].GetAddress(), message->sizeMin);
  send.continuation = (void*)which;
  send.Send(stack, myOID_, Extra_Entry[entrySendDone], sizeof(send));
}

void Server::SendDone(ANTENVMSG msg) {
  TCPEndpointSendMsg* message = (TCPEndpointSendMsg*)antEnvMsg::Receive(msg);
  const int which = (int)message->continuation;
  TCPEndpointReceiveMsg receive(endpoints[which], (byte*)buffers[which].GetAddress(), 1, buffers[which].GetSize());
  receive.continuation = message->continuation;
  receive.Send(stack, myOID_, Extra_Entry[entryReceiveDone], sizeof(receive));
}

void Server::CloseDone(ANTENVMSG msg) { listen((int)((TCPEndpointCloseMsg*)antEnvMsg::Receive(msg))->continuation); }

void Server::receiveDatagram() {
  UDPEndpointReceiveMsg receive(datagrams, (byte*)datagramBuffer.GetAddress(), datagramBuffer.GetSize());
  receive.Send(stack, myOID_, Extra_Entry[entryDatagramDone], sizeof(receive));
}

void Server::DatagramDone(ANTENVMSG msg) {
  UDPEndpointReceiveMsg* message = (UDPEndpointReceiveMsg*)antEnvMsg::Receive(msg);
  if (message->error != UDP_SUCCESS) return;
  OSYSPRINT(("server: datagram of %d\n", message->size));
  UDPEndpointSendMsg send(datagrams, message->address, message->port, message->buffer, message->size);
  send.Call(stack, sizeof(send));
  receiveDatagram();
}
