// Built by its Makefile, with a library of its own.
#include "Ruled.h"

#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

#include "../library/answer.h"

Ruled::Ruled() {}

OStatus Ruled::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  OSYSPRINT(("the answer is %d, by rule %d\n", answer(), RULE));
  return oSUCCESS;
}

OStatus Ruled::DoStart(const OSystemEvent& event) { return oSUCCESS; }
OStatus Ruled::DoStop(const OSystemEvent& event) { return oSUCCESS; }
OStatus Ruled::DoDestroy(const OSystemEvent& event) { return oSUCCESS; }
