// Two objects that throw a ball to each other without end.
#include "Left.h"

#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

Left::Left() {}

OStatus Left::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  return oSUCCESS;
}

OStatus Left::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  int first = 1;
  subject[sbjOut]->SetData(&first, sizeof(first));
  subject[sbjOut]->NotifyObservers();  return oSUCCESS;
}

OStatus Left::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Left::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void Left::Notify(const ONotifyEvent& event) {
  int next = *(const int*)event.Data(0) + 1;
  observer[event.ObsIndex()]->AssertReady(event.SenderID());
  subject[sbjOut]->SetData(&next, sizeof(next));
  subject[sbjOut]->NotifyObservers();
  if (next == 10000) OSYSPRINT(("ten thousand throws\n"));
}

void Left::Tick(const ONotifyEvent& event) {
  OSYSPRINT(("tick\n"));
  observer[event.ObsIndex()]->AssertReady();
}
