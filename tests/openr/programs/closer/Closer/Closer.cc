#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/OUnits.h>
#include <OPENR/core_macro.h>
#include "Closer.h"
#include "entry.h"
Closer::Closer() {}
OStatus Closer::DoInit(const OSystemEvent& event) {
 NEW_ALL_SUBJECT_AND_OBSERVER; REGISTER_ALL_ENTRY; SET_ALL_READY_AND_NOTIFY_ENTRY;
 return oSUCCESS; }
OStatus Closer::DoStart(const OSystemEvent& event) {
 stack = antStackRef("IPStack"); rounds = 0;
 antEnvCreateEndpointMsg m(EndpointType_TCP, 4096); m.Call(stack, sizeof(m)); e = m.moduleRef;
 antEnvCreateEndpointMsg k(EndpointType_TCP, 4096); k.Call(stack, sizeof(k)); c = k.moduleRef;
 TCPEndpointBindMsg b(e, IP_ADDR_ANY, 45678); b.Call(stack, sizeof(b)); OSYSPRINT(("bind %d\n", b.error));
 Listen(0);
 TCPEndpointCloseMsg x(e); x.Send(stack, myOID_, Extra_Entry[entryCloseCont], sizeof(x));
 ENABLE_ALL_SUBJECT; ASSERT_READY_TO_ALL_OBSERVER;
 return oSUCCESS; }
OStatus Closer::DoStop(const OSystemEvent& event) {
 DISABLE_ALL_SUBJECT; DEASSERT_READY_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus Closer::DoDestroy(const OSystemEvent& event) { DELETE_ALL_SUBJECT_AND_OBSERVER; return oSUCCESS; }
void Closer::Listen(Port p) { TCPEndpointListenMsg l(e, IP_ADDR_ANY, p); l.Send(stack, myOID_, Extra_Entry[entryListenCont], sizeof(l)); }
void Closer::ListenCont(ANTENVMSG msg) { TCPEndpointListenMsg* m = (TCPEndpointListenMsg*)antEnvMsg::Receive(msg); OSYSPRINT(("listen %d port %d\n", m->error, m->lPort)); if (rounds++ == 0) { Listen(0); TCPEndpointConnectMsg t(c, IP_ADDR_ANY, IP_PORT_ANY, IPAddress(127,0,0,1), 45678); t.Send(stack, myOID_, Extra_Entry[entryConnectCont], sizeof(t)); } }
void Closer::CloseCont(ANTENVMSG msg) { OSYSPRINT(("closed %d\n", ((TCPEndpointCloseMsg*)antEnvMsg::Receive(msg))->error)); }
void Closer::ConnectCont(ANTENVMSG msg) { OSYSPRINT(("connected %d\n", ((TCPEndpointConnectMsg*)antEnvMsg::Receive(msg))->error)); }
