#include "Motion.h"
#include <OPENR/core_macro.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/OUnits.h>
#include <math.h>
#include "entry.h"
static const char* const LOC[3] = { "PRM:/r1/c1-Joint2:11", "PRM:/r1/c1/c2-Joint2:12", "PRM:/r9/c1-Joint2:99" };
Motion::Motion() {}
OStatus Motion::DoInit(const OSystemEvent&) {
  NEW_ALL_SUBJECT_AND_OBSERVER; REGISTER_ALL_ENTRY; SET_ALL_READY_AND_NOTIFY_ENTRY;
  for (int i = 0; i < 3; i++) { OStatus r = OPENR::OpenPrimitive(LOC[i], &ids[i]); if (r != oSUCCESS) OSYSLOG1((osyslogERROR, "OpenPrimitive %s %d", LOC[i], r)); }
  OPENR::EnableJointGain(oprimitiveID_UNDEF);
  for (i = 0; i < NVEC; i++) {
    MemoryRegionID id; OCommandVectorData* d;
    OPENR::NewCommandVectorData(3, &id, &d);
    regions[i] = new RCRegion(d->vectorInfo.memRegionID, d->vectorInfo.offset, (void*)d, d->vectorInfo.totalSize);
    d->SetNumData(3);
    for (int j = 0; j < 3; j++) d->GetInfo(j)->Set(odataJOINT_COMMAND2, ids[j], ocommandMAX_FRAMES);
  }
  return oSUCCESS;
}
OStatus Motion::DoStart(const OSystemEvent&) { ENABLE_ALL_SUBJECT; ASSERT_READY_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus Motion::DoStop(const OSystemEvent&) { DISABLE_ALL_SUBJECT; DEASSERT_READY_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus Motion::DoDestroy(const OSystemEvent&) { DELETE_ALL_SUBJECT_AND_OBSERVER; return oSUCCESS; }
OStatus Motion::Connected(const OConnectEvent& e) { OSYSPRINT(("connect %d %s %d\n", e.ObsIndex(), e.SubName(), e.IsConnect())); return oSUCCESS; }
void Motion::MoveReady(const OReadyEvent&) {}
void Motion::GotOrder(const ONotifyEvent& e) {
  const Order* o = (const Order*)e.Data(0);
  OSYSPRINT(("order %ld %s %d of %d\n", o->id, o->text, e.NumOfData(), e.RCData(0)->Size()));
  send(o->pan);
  observer[obsOrders]->AssertReady();
}
void Motion::send(float pan) {
  for (int i = 0; i < NVEC; i++) if (regions[i]->NumberOfReference() == 1) break;
  if (i == NVEC) return;
  OCommandVectorData* d = (OCommandVectorData*)regions[i]->Base();
  for (int j = 0; j < 3; j++) { OJointCommandValue2* v = (OJointCommandValue2*)d->GetData(j)->value; for (int k = 0; k < ocommandMAX_FRAMES; k++) v[k].value = micro(j == 1 ? pan : 0); }
  subject[sbjMove]->SetData(regions[i]);
  subject[sbjMove]->NotifyObservers();
}
