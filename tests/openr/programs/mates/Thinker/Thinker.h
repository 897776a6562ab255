// A program of our own for the tests.
#ifndef Thinker_h
#define Thinker_h

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include "../common/State.h"

#include "def.h"

class Thinker : public OObject {
 public:
  Thinker();
  virtual ~Thinker() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void ReadyShared(const OReadyEvent& event);
  void Power(void* message);
  void Tick(const ONotifyEvent& event);

  RCRegion* region;
  State* state;
};

#endif
