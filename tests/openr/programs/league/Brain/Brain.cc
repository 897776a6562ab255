#include "Brain.h"
#include <OPENR/core_macro.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <stdio.h>
#include <vector>
#include <algorithm>
#include "entry.h"
class Pan : public Module { public: void step(int i) { k = i; } const char* name() const { return "pan"; } int k; };
Brain::Brain() : n(0) {}
OStatus Brain::DoInit(const OSystemEvent&) {
  NEW_ALL_SUBJECT_AND_OBSERVER
  REGISTER_ALL_ENTRY
  SET_ALL_READY_AND_NOTIFY_ENTRY
  modules["pan"] = new Pan;
  bool b = Config::instance().load("/MS/OPEN-R/APP/DATA/PARAMS.CFG");
  printf("loaded %d speed %g\n", b, Config::instance().get("speed"));
  OPENR::SetMotorPower(opowerON);
  return oSUCCESS;
}
OStatus Brain::DoStart(const OSystemEvent&) { ENABLE_ALL_SUBJECT ASSERT_READY_TO_ALL_OBSERVER return oSUCCESS; }
OStatus Brain::DoStop(const OSystemEvent&) { DISABLE_ALL_SUBJECT DEASSERT_READY_TO_ALL_OBSERVER return oSUCCESS; }
OStatus Brain::DoDestroy(const OSystemEvent&) { DELETE_ALL_SUBJECT_AND_OBSERVER return oSUCCESS; }
OStatus Brain::Controlled(const OControlEvent& e) { printf("control %d %s add %d\n", e.SbjIndex(), e.SubName(), e.IsAddObserver()); return oSUCCESS; }
void Brain::OrdersReady(const OReadyEvent& e) { printf("orders ready %d\n", e.IsAssert()); }
void Brain::GotSensor(const ONotifyEvent& e) {
  OSensorFrameVectorData* v = (OSensorFrameVectorData*)e.Data(0);
  for (int i = 0; i < v->vectorInfo.numData; i++) if (v->info[i].type == odataJOINT_VALUE) break;
  modules["pan"]->step(n);
  if (n++ % 20 == 0 && subject[sbjOrders]->IsReady()) {
    Order o; o.id = n; o.pan = 0.3f; o.when = now_s(); strcpy(o.text, "look");
    subject[sbjOrders]->SetData(&o, sizeof(o));
    subject[sbjOrders]->NotifyObservers();
  }
  observer[e.ObsIndex()]->AssertReady();
}
