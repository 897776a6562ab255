// Goes wrong in the way that is typed.
#include "Faulty.h"

#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>
#include <apsys.h>
#include <assert.h>
#include <fcntl.h>
#include <math.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <list>
#include <stdexcept>

struct Link {
  Link* next;
  long number;
};

Faulty::Faulty() {}

OStatus Faulty::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;

  return oSUCCESS;
}

OStatus Faulty::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;

  return oSUCCESS;
}

OStatus Faulty::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Faulty::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

int Faulty::deep(int n) {
  volatile char room[1000];
  room[n % 1000] = (char)n;
  return deep(n + 1) + room[(n + 1) % 1000];
}

int Faulty::same(int one, int) { return one; }

int Faulty::forgets(int n) {
  if (n < 0) return 1;
  OSYSPRINT(("forgets to return\n"));
}

static void __attribute__((noinline)) smash() {
  char room[10];
  strcpy(room, "This goes beyond its ten characters, to where the function was called from.");
}

static void divide() {
  int zero = 0;
  OSYSPRINT(("%d\n", 7 / zero));
}

void Faulty::Notify(const ONotifyEvent& event) {
  char line[80];
  if (gets(line) == 0) return;
  OSYSPRINT(("does %s\n", line));
  volatile double zero = 0, huge = 1e300;
  volatile int none = 0;
  if (strcmp(line, "null") == 0) *(int*)0 = 1;
  if (strcmp(line, "read") == 0) none = *(volatile int*)0x10;
  if (strcmp(line, "divide") == 0) none = 7 / none;
  if (strcmp(line, "nan") == 0) huge = zero / zero;
  if (strcmp(line, "overflow") == 0) none = (int)huge;
  if (strcmp(line, "misaligned") == 0) {
    char bytes[16];
    none = *(volatile int*)(bytes + 1 + none);
  }
  // Pointers have 4 bytes on the robot, and memory is dealt out by fours.
  static double room[8];
  char* by4 = (char*)room + 4 + none;
  if (strcmp(line, "half a double") == 0) huge = *(volatile double*)by4;
  if (strcmp(line, "pool") == 0) {
    Link* link = new (by4) Link;
    link->next = link;
    link->number = 3;
    OSYSPRINT(("pool %d %d\n", link->next->number, link->next == link));
  }
  if (strcmp(line, "heap") == 0) {
    char* memory = (char*)malloc(24);
    for (int i = 0; i < 4096; i++) ((volatile char*)memory)[i] = 0x55;
    for (int size = 16; size < 3000; size += 16) free(malloc(size));
    free(memory);
  }
  if (strcmp(line, "twice") == 0) {
    void* memory = malloc(5000);
    free(memory);
    free(memory);
  }
  // Gives the heap what is on the stack: the C library ends while it holds its own lock.
  if (strcmp(line, "pop") == 0) std::list<int>().pop_front();
  if (strcmp(line, "gone") == 0) {
    RCRegion* region = new RCRegion(5000);
    region->RemoveReference();
    region->RemoveReference();
  }
  if (strcmp(line, "literal") == 0) *(volatile char*)"literal" = 'L';
  if (strcmp(line, "deep") == 0) none = deep(0);
  if (strcmp(line, "loop") == 0)
    for (;;) none = none + 1;
  if (strcmp(line, "throw") == 0) throw std::runtime_error("thrown");
  if (strcmp(line, "abort") == 0) abort();
  if (strcmp(line, "assert") == 0) assert(none == 1);
  if (strcmp(line, "forget") == 0) forgets(none);
  if (strcmp(line, "smash") == 0) smash();
  if (strcmp(line, "by zero") == 0) divide();
  if (strcmp(line, "mips") == 0) {
    int status;
    __asm__ volatile("mfc0 %0, $12" : "=r"(status));
    none = status;
  }
  if (strcmp(line, "read only") == 0) {
    MemoryRegionID id;
    byte* there;
    OSYSPRINT(("region %d\n", NewSharedMemoryRegion(4096, MEMPROTINFO_R, &id, (void**)&there) == sSUCCESS));
    *there = 1;
  }
  if (strcmp(line, "delete") == 0) {
    void* memory = malloc(10);
    OSYSPRINT(("delete %d\n", DeleteRegion(memory) != sSUCCESS));
    MemoryRegionID id;
    NewSharedMemoryRegion(100, MEMPROTINFO_RW, &id, &memory);
    memset(memory, 1, 100);
    OSYSPRINT(("delete %d\n", DeleteRegion(memory) != sSUCCESS));
  }
  if (strcmp(line, "vanish") == 0) syscall(SYS_kill, syscall(SYS_getpid), 9);
  if (strcmp(line, "sleep") == 0) syscall(SYS_pause);
  if (strcmp(line, "escape") == 0) {
    char path[200];
    FILE* in = fopen("/MS/ESCAPE.TXT", "r");
    fgets(path, sizeof(path), in);
    const int out = syscall(SYS_open, path, O_CREAT | O_WRONLY, 0666);
    char* const arguments[] = {(char*)"sh", 0};
    const int ran = syscall(SYS_execve, "/bin/sh", arguments, arguments);
    OSYSPRINT(("outside %d program %d\n", out >= 0, ran >= 0));
  }
  OSYSPRINT(("lives on\n"));
  observer[event.ObsIndex()]->AssertReady();
}
