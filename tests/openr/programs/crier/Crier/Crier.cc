// Tells all robots of the net its number again and again, and says what it hears.
#include "Crier.h"

#include <EndpointTypes.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>
#include <UDPEndpointMsg.h>
#include <stdio.h>
#include <string.h>

#include <fstream>

static const Port port = 21733;

Crier::Crier() : number(0), frames(0) {}

OStatus Crier::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  std::ifstream in("/MS/NUMBER.TXT");
  in >> number;
  stack = antStackRef("IPStack");
  antEnvCreateSharedBufferMsg first(64), second(64);
  first.Call(stack, sizeof(first));
  second.Call(stack, sizeof(second));
  toSend = first.buffer;
  received = second.buffer;
  toSend.Map();
  received.Map();
  return oSUCCESS;
}

OStatus Crier::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  antEnvCreateEndpointMsg create(EndpointType_UDP, 256);
  create.Call(stack, sizeof(create));
  endpoint = create.moduleRef;
  for (int again = 0; again < 2; again++) {
    UDPEndpointBindMsg bind(endpoint, IP_ADDR_ANY, port);
    bind.Call(stack, sizeof(bind));
    OSYSPRINT(("bind %d\n", bind.error));
  }
  listen();
  return oSUCCESS;
}

OStatus Crier::DoStop(const OSystemEvent& event) {
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Crier::DoDestroy(const OSystemEvent& event) { return oSUCCESS; }

void Crier::listen() {
  UDPEndpointReceiveMsg receive(endpoint, (byte*)received.GetAddress(), received.GetSize());
  receive.Send(stack, myOID_, Extra_Entry[entryHeard], sizeof(receive));
}

void Crier::Heard(ANTENVMSG msg) {
  UDPEndpointReceiveMsg* message = (UDPEndpointReceiveMsg*)antEnvMsg::Receive(msg);
  if (message->error != UDP_SUCCESS) return;
  OSYSPRINT(("%d hears %.*s\n", number, message->size, (char*)message->buffer));
  listen();
}

void Crier::Tick(const ONotifyEvent& event) {
  // To every host, to those of a net, and to a group.
  static const IPAddress everybody[] = {IP_ADDR_BROADCAST, IPAddress(10, 0, 1, 255), IPAddress("224.0.0.5")};
  if (frames < 3) {
    char* text = (char*)toSend.GetAddress();
    sprintf(text, "robot %d, word %d", number, frames);
    UDPEndpointSendMsg send(endpoint, everybody[frames], port, (byte*)text, strlen(text));
    send.Call(stack, sizeof(send));
    OSYSPRINT(("said %d\n", send.error));
  }
  frames++;
  observer[event.ObsIndex()]->AssertReady();
}
