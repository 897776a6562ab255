// A message after 100 ms, others every 40 ms until the fourth, and one that is cancelled.
#include "Timer.h"

#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

static int now_ms() {
  SystemTime time;
  GetSystemTime(&time);
  return time.seconds * 1000 + time.useconds / 1000;
}

OStatus Timer::DoInit(const OSystemEvent& event) { return oSUCCESS; }
OStatus Timer::DoStart(const OSystemEvent& event) {
  int answer = 42;
  EventID once = EventID();
  TimeEventInfoWithRelativeTime soon(TimeEventInfo::NonPeriodic, RelativeTime(0, 100));
  sError error = SetTimeEvent(&soon, myOID_, Extra_Entry[entryOnce], &answer, sizeof(answer), &once);
  TimeEventInfoWithRelativeTime often(RelativeTime(0, 40), RelativeTime(0, 40));
  sError other = SetTimeEvent(&often, myOID_, Extra_Entry[entryAgain], 0, 0, &again);
  SetTimeEvent(&soon, myOID_, Extra_Entry[entryOnce], 0, 0, &never);
  OSYSPRINT(("set %d %d cancelled %d", error, other, CancelTimeEvent(never)));
  OSYSPRINT((" and once more %d\n", CancelTimeEvent(never) == sNOT_FOUND));
  TimeEventInfoWithRelativeTime bad(TimeEventInfo::Periodic, RelativeTime(0, 0));
  OSYSPRINT(("no period %d\n", SetTimeEvent(&bad, myOID_, Extra_Entry[entryAgain], 0, 0, &never) != sSUCCESS));
  return oSUCCESS;
}
OStatus Timer::DoStop(const OSystemEvent& event) { return oSUCCESS; }
OStatus Timer::DoDestroy(const OSystemEvent& event) { return oSUCCESS; }

void Timer::Once(void* msg) { OSYSPRINT(("once %d at %d\n", *(int*)msg, now_ms())); }

void Timer::Again(void* msg) {
  OSYSPRINT(("again %d at %d\n", ++times, now_ms()));
  if (times == 4) OSYSPRINT(("over %d\n", CancelTimeEvent(again)));
}
