#include "Widths.h"

#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

OStatus Widths::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  return oSUCCESS;
}
OStatus Widths::DoStart(const OSystemEvent& event) {
  char text[80];
  Percept percept;
  overloads(text, percept);
  OSYSPRINT(("overloads %s\n", text));
  OSYSPRINT(("percept %lu %ld %ld %.1f\n", percept.time, percept.x, percept.y, percept.confidence));
  return oSUCCESS;
}
OStatus Widths::DoStop(const OSystemEvent& event) { return oSUCCESS; }
OStatus Widths::DoDestroy(const OSystemEvent& event) { return oSUCCESS; }
