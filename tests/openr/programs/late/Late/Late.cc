// Connects at its start to a port at which it listens only after the first vector of sensors.
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>
#include "Late.h"
#include "entry.h"
OStatus Late::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  return oSUCCESS;
}
antModuleRef Late::Endpoint() {
  antEnvCreateEndpointMsg create(EndpointType_TCP, 1024);
  create.Call(stack, sizeof(create));
  return create.moduleRef;
}
OStatus Late::DoStart(const OSystemEvent& event) {
  stack = antStackRef("IPStack");
  client = Endpoint();
  server = Endpoint();
  TCPEndpointConnectMsg connect(client, IP_ADDR_ANY, IP_PORT_ANY, IPAddress(10, 0, 1, 100), 45681);
  connect.Send(stack, myOID_, Extra_Entry[entryConnected], sizeof(connect));
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}
OStatus Late::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}
OStatus Late::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}
void Late::Sensed(const ONotifyEvent& event) {
  if (!listens) {
    listens = true;
    OSYSPRINT(("listens\n"));
    TCPEndpointListenMsg listen(server, IP_ADDR_ANY, 45681);
    listen.Send(stack, myOID_, Extra_Entry[entryHeard], sizeof(listen));
  }
  observer[event.ObsIndex()]->AssertReady();
}
void Late::Connected(ANTENVMSG msg) {
  TCPEndpointConnectMsg* connect = (TCPEndpointConnectMsg*)antEnvMsg::Receive(msg);
  OSYSPRINT(("connected %d\n", connect->error));
}
void Late::Heard(ANTENVMSG msg) {
  TCPEndpointListenMsg* listen = (TCPEndpointListenMsg*)antEnvMsg::Receive(msg);
  OSYSPRINT(("somebody came %d\n", listen->error));
}
