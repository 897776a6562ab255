#ifndef BTR_OPENR_OCALENDARTIME_H
#define BTR_OPENR_OCALENDARTIME_H

#include <OPENR/OTime.h>

/// A time as year, month, day, hour, minute and second.
class OCalendarTime {
 public:
  OCalendarTime() { Set(0); }
  OCalendarTime(time_t seconds) { Set(seconds); }
  OCalendarTime(const OTime& time) { Set(time.GetLocalTime()); }
  OCalendarTime(int year, int month, int day, int hour, int minute, int second) {
    Set(year, month, day, hour, minute, second);
  }

  OStatus Set(time_t seconds);
  OStatus Set(const OTime& time) { return Set(time.GetLocalTime()); }
  OStatus Set(int year, int month, int day, int hour, int minute, int second);

  int GetYear() const { return year_; }
  int GetMonth() const { return month_; }  ///< 1 to 12
  int GetDay() const { return day_; }      ///< 1 to 31
  int GetHour() const { return hour_; }
  int GetMinute() const { return minute_; }
  int GetMin() const { return minute_; }
  int GetSecond() const { return second_; }
  int GetSec() const { return second_; }
  int GetDayOfWeek() const { return dayOfWeek_; }  ///< 0 is Sunday
  int Year() const { return year_; }
  int Month() const { return month_; }
  int Day() const { return day_; }
  int Hour() const { return hour_; }
  int Minute() const { return minute_; }
  int Second() const { return second_; }
  int DayOfWeek() const { return dayOfWeek_; }
  time_t GetTime() const;
  time_t GetClock() const { return GetTime(); }

 private:
  int year_, month_, day_, hour_, minute_, second_, dayOfWeek_;
};

std::ostream& operator<<(std::ostream& out, const OCalendarTime& time);

#endif
