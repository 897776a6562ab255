#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/OUnits.h>
#include <OPENR/core_macro.h>
#include "Almanac.h"
#include "entry.h"
Almanac::Almanac() {}
OStatus Almanac::DoInit(const OSystemEvent& event) {
 NEW_ALL_SUBJECT_AND_OBSERVER; REGISTER_ALL_ENTRY; SET_ALL_READY_AND_NOTIFY_ENTRY;
 return oSUCCESS; }
OStatus Almanac::DoStart(const OSystemEvent& event) {
 OTime now, noon;
 OPENR::GetTime(&now);
 OCalendarTime day(now);
 OSYSPRINT(("today %d/%d/%d %02d:%02d:%02d, weekday %d, kept %d\n", day.GetMonth(), day.GetDay(), day.GetYear(), day.GetHour(), day.GetMinute(), day.GetSecond(), day.GetDayOfWeek(), day.year_));
 noon.Set(now.GetClock(), 9);
 day.Set(noon);
 time_t clock; sbyte dif;
 day.GetTime(&clock, &dif);
 OSYSPRINT(("Tokyo %d:00, %d hours, same %d\n", day.GetHour(), dif, clock == now.GetClock()));
 OSYSPRINT(("later %d, 30 February %d\n", OCalendarTime(2004, 2, 29, 0, 0, 0) > OCalendarTime(now), day.Set(2004, 2, 30, 0, 0, 0)));
 OPENR::SetTime(OTime(0, 0));
 OPENR::GetTime(&now);
 cout << OCalendarTime(now) << endl;
 RelativeTime r = ConvertToRelativeTime(ConvertToSystemTime(RelativeTime(2, 500)));
 OSYSPRINT(("in %d.%03d s\n", r.sec, r.msec));
 SystemTime before, after; GetSystemTime(&before); Wait(static_cast<longlong>(40000000)); GetSystemTime(&after); after = after - before;
 OSYSPRINT(("waited %d us\n", after.useconds));
 const char* files[] = {"/MS/ZEBRA.TXT", "/MS/APE.TXT", "/MS/MOUSE.TXT"};
 for (int i = 0; i < 3; i++) { ofstream out(files[i]); out << i; }
 list("/MS"); list("/MS/OPEN-R/MW");
 OSYSPRINT(("stands in a folder %d\n", getcwd(0, 0) != 0));
 ENABLE_ALL_SUBJECT; ASSERT_READY_TO_ALL_OBSERVER;
 return oSUCCESS; }
OStatus Almanac::DoStop(const OSystemEvent& event) {
 DISABLE_ALL_SUBJECT; DEASSERT_READY_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus Almanac::DoDestroy(const OSystemEvent& event) { DELETE_ALL_SUBJECT_AND_OBSERVER; return oSUCCESS; }
void Almanac::list(const char* dir) {
  DIR* d = opendir(dir); struct dirent* e;
  OSYSPRINT(("%s:", dir)); while ((e = readdir(d)) != 0) OSYSPRINT((" %s", e->d_name));
  rewinddir(d); OSYSPRINT((", first again %s\n", readdir(d)->d_name)); closedir(d);
}
