#ifndef Longs_H
#define Longs_H
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include "def.h"
typedef unsigned long DWORD;
typedef unsigned long ulong;
struct FileHead {
  char id[4];
  unsigned long size;
  long int offset;
};
class Longs : public OObject {
 public:
  Longs() {}
  virtual ~Longs() {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);
  DWORD Random();

 private:
  DWORD seed;
};
extern "C" void in_c(char* text, long number);
#endif
