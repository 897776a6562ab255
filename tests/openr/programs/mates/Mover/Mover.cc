// Switches the motors on and writes to the state that it is given.
#include "Mover.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

Mover::Mover() : region(0) {}

OStatus Mover::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  OPENR::SetMotorPower(opowerON);
  return oSUCCESS;
}

OStatus Mover::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Mover::DoStop(const OSystemEvent& event) {
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Mover::DoDestroy(const OSystemEvent& event) { return oSUCCESS; }

void Mover::GotShared(const ONotifyEvent& event) {
  region = event.RCData(0);
  region->AddReference();
  State* state = reinterpret_cast<State*>(region->Base());
  Named* named = state;
  OSYSPRINT(("sum %d\n", named->sum()));
  state->legs = 40;
  OSYSPRINT(("sum %d\n", named->sum()));
  observer[event.ObsIndex()]->AssertReady();
}
