// Goes on while another object waits for the console.
#include "Ticker.h"

#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

Ticker::Ticker() {}

OStatus Ticker::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;

  return oSUCCESS;
}

OStatus Ticker::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;

  return oSUCCESS;
}

OStatus Ticker::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Ticker::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void Ticker::Notify(const ONotifyEvent& event) {
  static int count = 0;
  if (count++ < 5) OSYSPRINT(("tick %d\n", count));
  observer[event.ObsIndex()]->AssertReady();
}
