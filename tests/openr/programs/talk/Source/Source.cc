// Commands: s sets the next number as data, n notifies, u2 sets units of two, b3 a buffer of three, c clears, q tells
// the state.
#include "Source.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>
#include <ctype.h>

Source::Source() : sent(0), script(0) {}

OStatus Source::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  subject[sbjWords]->SetBufferSize(14);
  return oSUCCESS;
}

OStatus Source::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  script = fopen("/MS/SCRIPT.TXT", "r");
  return oSUCCESS;
}

OStatus Source::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Source::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

OStatus Source::Control(const OControlEvent& event) {
  OSYSPRINT(("Control %s %d\n", event.SubName(), event.IsAddObserver()));
  return oSUCCESS;
}

void Source::Ready(const OReadyEvent& event) {
  OSYSPRINT(("Ready %s\n", event.IsAssert() ? "assert" : "deassert"));
  if (sent == 0) return;
}

void Source::tell(const char* what) {
  OSubject* s = subject[sbjWords];
  ObserverConstIterator first = s->begin();
  OSYSPRINT(("%s: state %d any %d all %d room %d\n", what, s->ReadyStatus(*first), s->IsAnyReady(), s->IsAllReady(),
             (int)s->RemainBuffer()));
}

void Source::work(const char* line) {
  OSubject* s = subject[sbjWords];
  for (const char* c = line; *c; c++) {
    if (*c == 's') {
      char text[8];
      sprintf(text, "%d", ++sent);
      s->SetData(text, sizeof(text));
    } else if (*c == 'n') {
      s->NotifyObservers();
    } else if (*c == 'u' && isdigit(c[1])) {
      s->SetNotifyUnitSize(*++c - '0');
    } else if (*c == 'b' && isdigit(c[1])) {
      s->SetBufferSize(*++c - '0');
    } else if (*c == 'c') {
      s->ClearBuffer();
    } else if (*c == 'q') {
      tell("q");
    }
  }
}

void Source::Tick(const ONotifyEvent& event) {
  char line[64];
  if (script != 0 && fgets(line, sizeof(line), script) != 0) work(line);
  observer[event.ObsIndex()]->AssertReady();
}
