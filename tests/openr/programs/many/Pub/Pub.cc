#include "Pub.h"
#include <OPENR/OPENRAPI.h>
#include <OPENR/core_macro.h>
#include <string.h>
OStatus Pub::DoInit(const OSystemEvent&) { NEW_ALL_SUBJECT_AND_OBSERVER; REGISTER_ALL_ENTRY; SET_ALL_READY_AND_NOTIFY_ENTRY;
 n = 0; reg = 0; subject[sbjOut]->SetBufferSize(4); OSYSPRINT(("buf %d unit %d\n", subject[sbjOut]->GetBufferSize(), subject[sbjOut]->GetNotifyUnitSize())); return oSUCCESS; }
OStatus Pub::DoStart(const OSystemEvent& e) {  OSYSPRINT(("reason %d observers %d %d\n", e.Reason(), subject[0]->NumberOfObservers(), subject[1]->NumberOfObservers())); ENABLE_ALL_SUBJECT; ASSERT_READY_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus Pub::DoStop(const OSystemEvent&) { DISABLE_ALL_SUBJECT; DEASSERT_READY_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus Pub::DoDestroy(const OSystemEvent&) { DELETE_ALL_SUBJECT_AND_OBSERVER; return oSUCCESS; }

OStatus Pub::Ctl(const OControlEvent& e) { OSYSPRINT(("ctl %d %s %d\n", e.SbjIndex(), e.SubName(), e.IsAddObserver())); return strstr(e.SubName(), "Third") ? oFAIL : oSUCCESS; }
void Pub::Ready(const OReadyEvent& e) { OSYSPRINT(("ready sbj %d assert %d status %d any %d all %d\n", e.SbjIndex(), e.IsAssert(), subject[0]->ReadyStatus(e.SenderID()), subject[0]->IsAnyReady(), subject[0]->IsAllReady())); }
void Pub::RegReady(const OReadyEvent& e) { OSYSPRINT(("reg ready refs %d\n", reg ? reg->NumberOfReference() : -1)); }
void Pub::Tick(const ONotifyEvent& e) {
  n++;
  if (n <= 6) { char b[20]; sprintf(b, "m%d", n); OSYSPRINT(("set %d", subject[0]->SetData(b, sizeof b))); OSYSPRINT((" notify %d remain %d\n", subject[0]->NotifyObservers(), subject[0]->RemainBuffer())); }
  if (n == 7) { reg = new RCRegion(64); strcpy(reg->Base(), "shared"); subject[1]->SetData(reg); subject[1]->NotifyObservers(); OSYSPRINT(("reg refs %d\n", reg->NumberOfReference())); }
  if (n == 10) { OSYSPRINT(("reg refs later %d\n", reg->NumberOfReference()));
    RCRegion* made = new RCRegion(8); strcpy(made->Base(), "kept"); RCRegion* same = new RCRegion(made->MemID(), made->Offset()); bool one = same->Base() == made->Base(); made->RemoveReference(); OSYSPRINT(("by number %d %d %s %u\n", one, same->MemID() != reg->MemID(), same->Base(), same->Size())); same->RemoveReference();
    ObserverConstIterator i = subject[0]->begin(); char b[20] = "only first"; subject[0]->SetData(*i, b, sizeof b); subject[0]->NotifyObserver(*i); ++i; subject[0]->ClearBuffer(*i); }
  observer[0]->AssertReady();
}