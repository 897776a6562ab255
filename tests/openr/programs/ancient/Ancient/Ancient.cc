// What the robot's compiler had beyond the language, sizes of one type, numbers read from a file. Its parts stand in
// folders, and there is no Makefile.
#include "Ancient.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

#include <algorithm>
#include <cstdio>

#include "deeper.h"
#include "sum.h"

#define TRACE(text) OSYSPRINT(("in " __FUNCTION__ ": " text "\n"))

OStatus Ancient::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  Extensions();
  Sizes();
  Table();
  const longword values[] = {1, 2, 3};
  OSYSPRINT(("parts %ld %d\n", sum_of(values, 3), Deeper::twice(21)));
  return oSUCCESS;
}

OStatus Ancient::DoStart(const OSystemEvent& event) { return oSUCCESS; }
OStatus Ancient::DoStop(const OSystemEvent& event) { return oSUCCESS; }
OStatus Ancient::DoDestroy(const OSystemEvent& event) { return oSUCCESS; }

static int clipped(int value, int low, int high) {
  value <?= high;
  value >?= low;
  return value;
}

void Ancient::Extensions() {
  TRACE("found");
  word raw[] = {1, 2, 3, 4, 5, 6};
  void* at = raw;
  ((word*)at)++;
  const word second = *((word*)at)++;
  ++(word*)at;
  (byte*)at -= 2;
  longword changes = 7;
  (slongword)changes = -1;
  OSYSPRINT(("casts %d %d %x\n", second, (int)((word*)at - raw), changes));
  int most = 3;
  most >?= second == 2 ? 9 : 1;
  for (int i = 0; i < 3; most <?= 8 - i, i++) {
  }
  OSYSPRINT(("clipped %d %d %d, most %d\n", clipped(5, 0, 9), clipped(-5, 0, 9), clipped(50, 0, 9), most));
  OSYSPRINT(("mixed %d %d\n", (int)(10 * ((1.5 <? 2) + (3 >? 2.5 + 1))), 1 <? 2 <? 0 + 4));
}

void Ancient::Sizes() {
  MemoryRegionID memory;
  OSoundVectorData* vector;
  OPENR::NewSoundVectorData(1, 1024, &memory, &vector);
  const size_t wanted = 4000;
  OSYSPRINT(("sizes %d %d %d\n", (int)std::min(wanted, vector->GetInfo(0)->maxDataSize),
             (int)std::max(vector->GetInfo(0)->maxDataSize, wanted),
             (int)std::min(vector->GetInfo(0)->maxDataSize, sizeof(OSoundInfo))));
  OPENR::DeleteSoundVectorData(memory);
}

void Ancient::Table() {
  FILE* file = fopen("/MS/OPEN-R/MW/DATA/P/TABLE.TXT", "r");
  char name[16];
  longword numbers[4] = {0, 0, 0, 7};
  word half[2] = {0, 9};
  slongword negative[2] = {0, 5};
  int count = fscanf(file, "%15s %lu %lx,%lo", name, &numbers[0], &numbers[1], &numbers[2]);
  OSYSPRINT(("read %d %s %lu %lx %lo %lu\n", count, name, numbers[0], numbers[1], numbers[2], numbers[3]));
  count = std::fscanf(file, "%hu %*ld %ld%%", &half[0], &negative[0]);
  OSYSPRINT(("read %d %u %u %d %d\n", count, half[0], half[1], negative[0], negative[1]));
  unsigned long large = ~0ul;
  long small = 1l << 40;
  size_t size = ~(size_t)0;
  float real = 0;
  double precise = 0;
  count = fscanf(file, "%lu %d %u %f %lf", &large, &small, &size, &real, &precise);
  OSYSPRINT(("read %d %d %d %d %d\n", count, large == 5, small == -6, size == 7, (int)(4 * (real + precise))));
  fclose(file);
  longword pair[3] = {0, 0, 3};
  char letter = 0;
  count = sscanf("key]= 12;13x", "%*[^]]]= %ld;%ld%c", &pair[0], &pair[1], &letter);
  OSYSPRINT(("read %d %d %d %d %c\n", count, pair[0], pair[1], pair[2], letter));
}
