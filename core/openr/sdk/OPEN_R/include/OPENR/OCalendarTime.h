#ifndef BTR_OPENR_OCALENDARTIME_H
#define BTR_OPENR_OCALENDARTIME_H

#include <OPENR/OTime.h>

const int ocldtdowSUNDAY = 0;
const int ocldtdowMONDAY = 1;
const int ocldtdowTUESDAY = 2;
const int ocldtdowWEDNESDAY = 3;
const int ocldtdowTHURSDAY = 4;
const int ocldtdowFRIDAY = 5;
const int ocldtdowSATURDAY = 6;
const int ocldtSTART_DAY_OF_THE_WEEK = ocldtdowSATURDAY;  ///< of otimeSTART_YEAR

inline bool LeapYear(int year) { return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0; }

/// A local time as year, month, day, hour, minute and second.
class OCalendarTime {
 public:
  // As they are kept: the year counts from otimeSTART_YEAR, the month from 1; Sunday is day 0 of the week.
  int year_, month_, day_, hour_, min_, sec_, dow_;
  sbyte timeDif_;

  OCalendarTime() { Set(0); }
  OCalendarTime(time_t clock, sbyte timeDif = 0) { Set(OTime(clock, timeDif)); }
  OCalendarTime(const OTime& time) { Set(time); }
  /// `year` in full or from otimeSTART_YEAR.
  OCalendarTime(int year, int month, int day, int hour, int minute, int second, sbyte timeDif = 0) : timeDif_(timeDif) {
    Set(year, month, day, hour, minute, second);
  }

  OStatus Set(time_t clock) { return Set(OTime(clock, 0)); }
  OStatus Set(time_t clock, sbyte timeDif) { return Set(OTime(clock, timeDif)); }
  OStatus Set(const OTime& time);
  /// oINVALID_ARG, and nothing changed, for what no calendar has.
  OStatus Set(int year, int month, int day, int hour, int minute, int second);
  OStatus SetTime(time_t clock, sbyte timeDif) { return Set(OTime(clock, timeDif)); }
  OStatus SetTime(const OTime& time) { return Set(time); }
  OStatus SetTimeDif(sbyte timeDif) {
    timeDif_ = timeDif;
    return oSUCCESS;
  }

  /// In full: 2004.
  int GetYear() const { return otimeSTART_YEAR + year_; }
  int GetMonth() const { return month_; }  ///< 1 to 12
  int GetDay() const { return day_; }      ///< 1 to 31
  int GetHour() const { return hour_; }
  int GetMinute() const { return min_; }
  int GetMin() const { return min_; }
  int GetSecond() const { return sec_; }
  int GetSec() const { return sec_; }
  int GetDayOfWeek() const { return dow_; }  ///< 0 is Sunday
  sbyte GetTimeDif() const { return timeDif_; }
  int Year() const { return GetYear(); }
  int Month() const { return month_; }
  int Day() const { return day_; }
  int Hour() const { return hour_; }
  int Minute() const { return min_; }
  int Second() const { return sec_; }
  int DayOfWeek() const { return dow_; }

  /// The same as an OTime has it.
  time_t GetTime() const;
  time_t GetClock() const { return GetTime(); }
  OStatus GetTime(time_t* clock, sbyte* timeDif) const {
    *clock = GetTime();
    *timeDif = timeDif_;
    return oSUCCESS;
  }
  OStatus GetTime(OTime* time) const { return time->Set(GetTime(), timeDif_); }
  /// Whether a calendar has this day and a clock this time; the day of the week is not looked at.
  bool ProperDate() const;
  /// Makes dow_ what it is on that date; oINVALID_ARG for no proper one.
  OStatus CorrectDayOfTheWeek();
  void Print() const;
  /// "2004-01-02 03:04:05": 20 characters with the end.
  void Sprint(char* text) const;
  /// As in a letter's head, "Fri, 02 Jan 2004 03:04:05 +0900": 32 characters with the end.
  void RFC2822(char* text) const;
};

inline bool operator==(const OCalendarTime& a, const OCalendarTime& b) { return a.GetTime() == b.GetTime(); }
inline bool operator!=(const OCalendarTime& a, const OCalendarTime& b) { return a.GetTime() != b.GetTime(); }
inline bool operator<(const OCalendarTime& a, const OCalendarTime& b) { return a.GetTime() < b.GetTime(); }
inline bool operator>(const OCalendarTime& a, const OCalendarTime& b) { return a.GetTime() > b.GetTime(); }
inline bool operator<=(const OCalendarTime& a, const OCalendarTime& b) { return a.GetTime() <= b.GetTime(); }
inline bool operator>=(const OCalendarTime& a, const OCalendarTime& b) { return a.GetTime() >= b.GetTime(); }
std::ostream& operator<<(std::ostream& out, const OCalendarTime& time);

#endif
