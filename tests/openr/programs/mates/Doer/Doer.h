// A program of our own for the tests.
#ifndef Doer_h
#define Doer_h

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include "../common/State.h"

#include "def.h"

class Doer : public OObject {
 public:
  Doer();
  virtual ~Doer() {}

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
