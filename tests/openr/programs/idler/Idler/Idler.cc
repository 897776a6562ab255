// Waits by looking at the clock until it is late enough, as programs do against a button that chatters.
#include "Idler.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>
#include <sys/time.h>
#include <time.h>
#include "entry.h"

static int Milliseconds() {
  SystemTime now;
  GetSystemTime(&now);
  return now.seconds * 1000 + now.useconds / 1000;
}

OStatus Idler::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  return oSUCCESS;
}

OStatus Idler::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Idler::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Idler::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void Idler::Sensed(const ONotifyEvent& event) {
  if (!done) {
    done = true;
    // Measuring lets no time pass.
    const int begin = Milliseconds();
    for (int i = 0; i < 900; i++) Milliseconds();
    OSYSPRINT(("measured %d ms\n", Milliseconds() - begin));
    OTime now;
    OPENR::GetTime(&now);
    const longword until = now.GetClock() + 2;
    do OPENR::GetTime(&now);
    while (now.GetClock() < until);
    OSYSPRINT(("second 2 of its clock: %d ms\n", Milliseconds() % 1000));
    const int then = Milliseconds();
    while (Milliseconds() < then + 50) {
    }
    OSYSPRINT(("50 ms by the system's time: %d\n", Milliseconds() - then));
    struct timeval first, last;
    gettimeofday(&first, 0);
    do gettimeofday(&last, 0);
    while ((last.tv_sec - first.tv_sec) * 1000000 + last.tv_usec - first.tv_usec < 20000);
    OSYSPRINT(("20 ms of day: %d\n", Milliseconds() - then));
    const clock_t ticks = clock();
    while (clock() < ticks + CLOCKS_PER_SEC / 100) {
    }
    OSYSPRINT(("10 ms of work: %d\n", Milliseconds() - then));
  }
  observer[event.ObsIndex()]->AssertReady();
}
