/* Time since the robot was switched on. */
#ifndef BTR_OPENR_SYSTEM_TIME_H
#define BTR_OPENR_SYSTEM_TIME_H

#include <Types.h>

struct structSystemTime {
  longword seconds;
  longword useconds;
};

#ifdef __cplusplus

class SystemTime : public structSystemTime {
 public:
  SystemTime() {
    seconds = 0;
    useconds = 0;
  }
  SystemTime(longword s, longword us) {
    seconds = s;
    useconds = us;
  }
};

inline SystemTime operator+(const SystemTime& a, const SystemTime& b) {
  const longword us = a.useconds + b.useconds;
  return SystemTime(a.seconds + b.seconds + us / 1000000, us % 1000000);
}
inline SystemTime operator-(const SystemTime& a, const SystemTime& b) {
  const bool borrow = a.useconds < b.useconds;
  return SystemTime(a.seconds - b.seconds - (borrow ? 1 : 0), a.useconds + (borrow ? 1000000 : 0) - b.useconds);
}
inline bool operator==(const SystemTime& a, const SystemTime& b) {
  return a.seconds == b.seconds && a.useconds == b.useconds;
}
inline bool operator!=(const SystemTime& a, const SystemTime& b) { return !(a == b); }
inline bool operator<(const SystemTime& a, const SystemTime& b) {
  return a.seconds < b.seconds || (a.seconds == b.seconds && a.useconds < b.useconds);
}
inline bool operator>(const SystemTime& a, const SystemTime& b) { return b < a; }
inline bool operator<=(const SystemTime& a, const SystemTime& b) { return !(b < a); }
inline bool operator>=(const SystemTime& a, const SystemTime& b) { return !(a < b); }

#else
typedef struct structSystemTime SystemTime;
#endif

#endif
