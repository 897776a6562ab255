#ifndef BTR_OPENR_OTIME_H
#define BTR_OPENR_OTIME_H

#include <OPENR/OPENR.h>
#include <time.h>

#include <iosfwd>

const sbyte otimeTIME_DIF_UNDEF = 0x7f;
const int otimeSTART_YEAR = 2000;  ///< its first second is an OTime's 0

/// Seconds since 2000 in universal time, and how many hours the local time is ahead.
class OTime {
 public:
  OTime() : clock_(0), timeDif_(otimeTIME_DIF_UNDEF) {}
  OTime(time_t clock, sbyte timeDif) : clock_(clock), timeDif_(timeDif) {}
  OTime(const OTime& time) : clock_(time.clock_), timeDif_(time.timeDif_) {}
  OTime& operator=(const OTime& time) {
    clock_ = time.clock_;
    timeDif_ = time.timeDif_;
    return *this;
  }

  OStatus Set(time_t clock, sbyte timeDif) {
    clock_ = clock;
    timeDif_ = timeDif;
    return oSUCCESS;
  }
  OStatus SetClock(time_t clock) {
    clock_ = clock;
    return oSUCCESS;
  }
  OStatus SetLocalTime(time_t localTime) {
    clock_ = localTime - ahead_s();
    return oSUCCESS;
  }
  OStatus SetTimeDif(sbyte timeDif) {
    timeDif_ = timeDif;
    return oSUCCESS;
  }
  time_t GetClock() const { return clock_; }
  time_t GetLocalTime() const { return clock_ + ahead_s(); }
  sbyte GetTimeDif() const { return timeDif_; }

 private:
  time_t ahead_s() const { return timeDif_ == otimeTIME_DIF_UNDEF ? 0 : timeDif_ * 3600; }
  time_t clock_;
  sbyte timeDif_;
};

inline bool operator==(const OTime& a, const OTime& b) { return a.GetClock() == b.GetClock(); }
inline bool operator!=(const OTime& a, const OTime& b) { return a.GetClock() != b.GetClock(); }
inline bool operator<(const OTime& a, const OTime& b) { return a.GetClock() < b.GetClock(); }
inline bool operator>(const OTime& a, const OTime& b) { return a.GetClock() > b.GetClock(); }
inline bool operator<=(const OTime& a, const OTime& b) { return a.GetClock() <= b.GetClock(); }
inline bool operator>=(const OTime& a, const OTime& b) { return a.GetClock() >= b.GetClock(); }
std::ostream& operator<<(std::ostream& out, const OTime& time);

#endif
