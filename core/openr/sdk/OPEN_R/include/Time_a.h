// Times from now on, in milliseconds, and the system's.
#ifndef BTR_OPENR_TIME_A_H
#define BTR_OPENR_TIME_A_H

#include <SystemTime.h>
#include <apsys.h>

struct RelativeTime {
  longword sec;
  longword msec;

  RelativeTime() : sec(0), msec(0) {}
  RelativeTime(longword s) : sec(s), msec(0) {}
  RelativeTime(longword s, longword ms) : sec(s), msec(ms) {}
};

RelativeTime ConvertToRelativeTime(const SystemTime& time);
SystemTime ConvertToSystemTime(const RelativeTime& time);

#endif
