#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>
#include <limits.h>
#include <time.h>
#include "Longs.h"
OStatus Longs::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  seed = 12345UL;
  return oSUCCESS;
}
DWORD Longs::Random() {
  seed = seed * 1664525UL + 1013904223L;
  return seed >> 16;
}
OStatus Longs::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  long long wide = 1;
  OSYSPRINT(("sizes %d %d %d %d\n", sizeof(long), sizeof(ulong), sizeof(wide), sizeof(FileHead)));
  OSYSPRINT(("limits %ld %ld %lu\n", LONG_MAX, LONG_MIN, ULONG_MAX));
  const DWORD first = Random(), second = Random();
  OSYSPRINT(("random %lu %lu\n", first, second));
  FileHead head = {{'a', 'b', 'c', 'd'}, 7, -2L};
  FILE* file = fopen("/MS/HEAD.DAT", "wb");
  fwrite(&head, 12, 1, file);
  fclose(file);
  FileHead read;
  file = fopen("/MS/HEAD.DAT", "rb");
  fread(&read, sizeof(read), 1, file);
  fseek(file, 0L, SEEK_END);
  long end = ftell(file);
  fclose(file);
  OSYSPRINT(("read %.4s %lu %ld of %ld\n", read.id, read.size, read.offset, end));
  char text[40];
  in_c(text, -1L);
  OSYSPRINT(("in C %s\n", text));
  long now;
  time(&now);
  OSYSPRINT(("a time %d %d\n", now == (long)time(NULL), now == (long)time(0)));
  return oSUCCESS;
}
OStatus Longs::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}
OStatus Longs::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}
