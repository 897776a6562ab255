// A program of our own for the tests.
#ifndef Mover_h
#define Mover_h

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include "../common/State.h"

#include "def.h"

class Mover : public OObject {
 public:
  Mover();
  virtual ~Mover() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void GotShared(const ONotifyEvent& event);

  RCRegion* region;
};

#endif
