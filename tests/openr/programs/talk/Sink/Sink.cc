// Told by data "7": asserts again, "8": deasserts, "9": asserts twice. Its parameters are read from a file.
#include "Sink.h"

#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

Sink::Sink() {}

OStatus Sink::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  int skip = 0, min = 1, max = 1;
  FILE* in = fopen("/MS/PARAMS.TXT", "r");
  if (in != 0) {
    fscanf(in, "%d %d %d", &skip, &min, &max);
    fclose(in);
  }
  observer[obsWords]->SetBufCtrlParam(skip, min, max);
  return oSUCCESS;
}

OStatus Sink::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;

  return oSUCCESS;
}

OStatus Sink::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Sink::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

OStatus Sink::Connect(const OConnectEvent& event) {
  OSYSPRINT(("Connect %s %d\n", event.SubName(), event.IsConnect()));
  return oSUCCESS;
}

void Sink::Notify(const ONotifyEvent& event) {
  char all[200] = "got";
  for (int i = 0; i < event.NumOfData(); i++) {
    strcat(all, " ");
    strcat(all, (const char*)event.Data(i));
  }
  OSYSPRINT(("%s, %d notices\n", all, event.NumOfNotify()));
  const char* last = (const char*)event.Data(event.NumOfData() - 1);
  if (strchr(all, '8') != 0)
    observer[event.ObsIndex()]->DeassertReady();
  else if (strcmp(last, "1") == 0)
    observer[event.ObsIndex()]->AssertReady(event.SenderID());
}
