// Switches the motors on and writes to the state that it is given.
#include "Doer.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

Doer::Doer() : region(0) {}

OStatus Doer::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  OPENR::SetMotorPower(opowerON);
  return oSUCCESS;
}

OStatus Doer::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Doer::DoStop(const OSystemEvent& event) {
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Doer::DoDestroy(const OSystemEvent& event) { return oSUCCESS; }

void Doer::GotShared(const ONotifyEvent& event) {
  region = event.RCData(0);
  region->AddReference();
  State* state = reinterpret_cast<State*>(region->Base());
  Named* named = state;
  OSYSPRINT(("sum %d\n", named->sum()));
  state->legs = 40;
  OSYSPRINT(("sum %d\n", named->sum()));
  observer[event.ObsIndex()]->AssertReady();
}
