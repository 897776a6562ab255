// Two objects that throw a ball to each other without end.
#include "Right.h"

#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

Right::Right() {}

OStatus Right::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  return oSUCCESS;
}

OStatus Right::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Right::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Right::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void Right::Notify(const ONotifyEvent& event) {
  int next = *(const int*)event.Data(0) + 1;
  observer[event.ObsIndex()]->AssertReady(event.SenderID());
  subject[sbjOut]->SetData(&next, sizeof(next));
  subject[sbjOut]->NotifyObservers();
  if (next == 10000) OSYSPRINT(("ten thousand throws\n"));
}
