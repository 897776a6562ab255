// Begins to think with the first notice of the power, and shares its state with the object that moves.
#include "Thinker.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OPENRMessages.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

#include <new>

Thinker::Thinker() : region(0), state(0) {}

OStatus Thinker::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  OPowerStatus wanted;
  wanted.Set(orsbALL, obsbALL, opsoREMAINING_CAPACITY_NOTIFY_EVERY_CHANGE, opsoTEMPERATURE_NOTIFY_EVERY_CHANGE,
             opsoTIME_DIF_NOTIFY_EVERY_CHANGE, opsoVOLUME_NOTIFY_EVERY_CHANGE);
  OPENR::ObservePowerStatus(wanted, OServiceEntry(myOID_, Extra_Entry[entryPower]));
  region = new RCRegion(sizeof(State));
  state = new (region->Base()) State;
  return oSUCCESS;
}

OStatus Thinker::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Thinker::DoStop(const OSystemEvent& event) {
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Thinker::DoDestroy(const OSystemEvent& event) { return oSUCCESS; }

void Thinker::ReadyShared(const OReadyEvent& event) {
  static bool first = true;
  if (!first) return;
  first = false;
  subject[sbjShared]->SetData(region);
  subject[sbjShared]->NotifyObservers();
}

void Thinker::Power(void* message) {
  const OPowerStatus& status = ((OPowerStatusMessage*)message)->powerStatus;
  OSYSPRINT(("power: motors %d\n", (status.robotStatus & orsbMOTOR_POWER) != 0));
}

void Thinker::Tick(const ONotifyEvent& event) {
  static int ticks = 0;
  if (++ticks == 2) OSYSPRINT(("legs are %d, references %d\n", state->legs, region->NumberOfReference()));
  observer[event.ObsIndex()]->AssertReady();
}
