#include <OPENR/core_macro.h>
#include <iostream.h>
#include <string.h>
#include "Relay.h"
OStatus Relay::DoInit(const OSystemEvent&) { NewComData; SetComData; return oSUCCESS; }
OStatus Relay::DoStart(const OSystemEvent&) { ENABLE_ALL_SUBJECT; ASSERT_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus Relay::DoStop(const OSystemEvent&) { DEASSERT_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus Relay::DoDestroy(const OSystemEvent&) { DeleteComData; return oSUCCESS; }
void Relay::Ready(const OReadyEvent& event) { static int n = 0; cout << "Ready " << (event.IsAssert() ? "ASSERT" : "DEASSERT") << endl; if (n++ < 2) { subject[sbjOut]->SetData("hello", 6); subject[sbjOut]->NotifyObservers(); } }
void Relay::Update(const ONotifyEvent& event) { cout << "got " << (const char*)event.Data(0) << " from " << (event.SenderID().GetSubjectID() == subject[0]->GetID()) << endl; observer[event.ObsIndex()]->AssertReady(); }
