// Leaves out the headers that it needs: those of the robot came with one another.
#include "Omitted.h"

#include <OPENR/core_macro.h>
#include <string.h>

static OPrimitiveID unknown;

Omitted::Omitted() {}

OStatus Omitted::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  use();
  return oSUCCESS;
}

OStatus Omitted::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Omitted::DoStop(const OSystemEvent& event) { return oSUCCESS; }

OStatus Omitted::DoDestroy(const OSystemEvent& event) { return oSUCCESS; }

void Omitted::use() {
  OSYSPRINT(("%.1f degrees, %d microradians\n", degrees(M_PI / 2), oradians(180)));
  OSYSPRINT(("same %d %d, other %d\n", stricmp("Forward", "FORWARD"), strnicmp("sensor-update x", "Sensor-Update y", 14),
             stricmp("left", "right") < 0));
  OTime time(0, 9);
  SystemTime now;
  GetSystemTime(&now);
  OPowerStatus power;
  OSYSPRINT(("dif %d power %d\n", time.GetTimeDif(), OPENR::GetPowerStatus(&power)));
  int numbers[3] = {3, 1, 2};
  std::sort(numbers, numbers + 3);
  std::ostringstream text;
  text << setw(4) << setfill('0') << numbers[2] << accumulate(numbers, numbers + 3, 0);
  std::bitset<8> bits(5);
  OSYSPRINT(("%s %d %d\n", text.str().c_str(), (int)bits.count(), TRUE));
  // Of other robots, and of none.
  OSYSPRINT(("%d ", OPENR::OpenPrimitive("PRM:/r1/c1-Joint2:j1", &unknown)));
  OSYSPRINT(("%d ", OPENR::OpenPrimitive("PRM:/r1/c1/c2-Joint2:j2", &unknown)));
  OSYSPRINT(("%d\n", OPENR::OpenPrimitive("PRM:/r9/c1-Joint2:91", &unknown)));
}
