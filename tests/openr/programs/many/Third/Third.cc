#include "Third.h"
#include <OPENR/OPENRAPI.h>
#include <OPENR/core_macro.h>
#include <string.h>
OStatus Third::DoInit(const OSystemEvent&) { NEW_ALL_SUBJECT_AND_OBSERVER; REGISTER_ALL_ENTRY; SET_ALL_READY_AND_NOTIFY_ENTRY;
 n = 0;  return oSUCCESS; }
OStatus Third::DoStart(const OSystemEvent& e) {  ENABLE_ALL_SUBJECT; ASSERT_READY_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus Third::DoStop(const OSystemEvent&) { DISABLE_ALL_SUBJECT; DEASSERT_READY_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus Third::DoDestroy(const OSystemEvent&) { DELETE_ALL_SUBJECT_AND_OBSERVER; return oSUCCESS; }

void Third::Got(const ONotifyEvent& e) { OSYSPRINT(("got %d:", e.NumOfData())); for (int i = 0; i < e.NumOfData(); i++) OSYSPRINT((" %s(%d)", (const char*)e.Data(i), e.RCData(i)->NumberOfReference())); OSYSPRINT(("\n")); if (strcmp("Third", "Fast") == 0 || n++ != 1) observer[e.ObsIndex()]->AssertReady(e.SenderID()); }
void Third::Reg(const ONotifyEvent& e) { OSYSPRINT(("reg %s refs %d size %d\n", e.RCData(0)->Base(), e.RCData(0)->NumberOfReference(), e.RCData(0)->Size())); observer[obsReg]->AssertReady(); }