// Of a team whose Makefiles write down where the kit is, and install to a memory stick of theirs.
#include "Barker.h"

#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

Barker::Barker() {}

OStatus Barker::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  return oSUCCESS;
}

OStatus Barker::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  subject[sbjBark]->SetData("woof", 5);
  subject[sbjBark]->NotifyObservers();
  return oSUCCESS;
}

OStatus Barker::DoStop(const OSystemEvent& event) { return oSUCCESS; }

OStatus Barker::DoDestroy(const OSystemEvent& event) { return oSUCCESS; }

void Barker::Notify(const ONotifyEvent& event) { OSYSPRINT(("%s\n", (const char*)event.Data(0))); }
