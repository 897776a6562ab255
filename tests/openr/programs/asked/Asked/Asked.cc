#include "Asked.h"

#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>
#include <math.h>

const int size = 256;
double wide[size], root[size];
float above[size], below[size], ratio[size];
int whole[size];
byte table[size];

// Loops in which a number that would stop the program is kept out of what it would stop in.
void fill() {
  for (int i = 0; i < size; i++) table[i] = wide[i] > 255 ? 255 : (byte)wide[i];
  for (int i = 0; i < size; i++) whole[i] = wide[i] < 1e6 ? (int)wide[i] : 1000000;
  for (int i = 0; i < size; i++) root[i] = wide[i] > 0 ? sqrt(wide[i]) : 0.0;
  for (int i = 0; i < size; i++) ratio[i] = below[i] != 0 ? above[i] / below[i] : 0.0f;
}

OStatus Asked::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  return oSUCCESS;
}
OStatus Asked::DoStart(const OSystemEvent& event) {
  for (int i = 0; i < size; i++) {
    wide[i] = i % 3 ? i : -i / 3;
    above[i] = i % 5 ? i : 0;
    below[i] = i % 5;
  }
  wide[9] = 1e300;
  fill();
  OSYSPRINT(("%d %d %d %.2f %.1f\n", table[9], table[21] == (byte)-7 ? 21 : 0, whole[9], root[7], ratio[7]));
  return oSUCCESS;
}
OStatus Asked::DoStop(const OSystemEvent& event) { return oSUCCESS; }
OStatus Asked::DoDestroy(const OSystemEvent& event) { return oSUCCESS; }
