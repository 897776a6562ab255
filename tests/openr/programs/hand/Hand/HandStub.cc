#include <MCOOP.h>
#include <ObjectEntryTable.h>
#include <apsys.h>
#include <OPENR/stub_macro.h>
#include "Hand.h"
Hand Self;
extern "C" void InitStub(OReasonMessage* m) { Self.Init(OSystemEvent(m->reason, m->param, m->paramSize)); Return(); }
extern "C" void StartStub(OReasonMessage* m) { Self.Start(OSystemEvent(m->reason, m->param, m->paramSize)); Return(); }
extern "C" void StopStub(OReasonMessage* m) { Self.Stop(OSystemEvent(m->reason, m->param, m->paramSize)); Return(); }
extern "C" void DestroyStub(OReasonMessage* m) { Self.Destroy(OSystemEvent(m->reason, m->param, m->paramSize)); Return(); }
extern "C" void ConnectStub(OConnectMessage* m) { Self.observer->ConnectHandler(m); Exit(); }
extern "C" void NotifyStub(ONotifyMessage* m) { ONotifyEvent e; e.SetIndex(0); Self.observer->NotifyHandler(*m, &e); Self.Sensor(e); Exit(); }
GEN_ENTRY(InitEntry, InitStub)
GEN_ENTRY(StartEntry, StartStub)
GEN_ENTRY(StopEntry, StopStub)
GEN_ENTRY(DestroyEntry, DestroyStub)
GEN_ENTRY(ConnectEntry, ConnectStub)
GEN_ENTRY(NotifyEntry, NotifyStub)
ObjectEntry ObjectEntryTable[] = { { oentryINIT, (Entry)InitEntry }, { oentrySTART, (Entry)StartEntry }, { oentrySTOP, (Entry)StopEntry }, { oentryDESTROY, (Entry)DestroyEntry }, { 4, (Entry)ConnectEntry }, { 5, (Entry)NotifyEntry }, { UNDEF, (Entry)ENTRY_UNDEF } };
