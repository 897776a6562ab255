#ifndef Widths_H
#define Widths_H
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <string.h>
#include <time.h>

#include "def.h"

// Both sources know it.
struct Percept {
  unsigned long time;
  long x, y;
  float confidence;
};
void overloads(char* text, Percept& percept);

class Widths : public OObject {
 public:
  Widths() {}
  virtual ~Widths() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);
};
#endif
