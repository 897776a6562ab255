// A program of our own for the tests.
#ifndef Sounder_h
#define Sounder_h

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include "def.h"

class Sounder : public OObject {
 public:
  Sounder();
  virtual ~Sounder() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void Ready(const OReadyEvent& event);
  void Notify(const ONotifyEvent& event);

 private:
  OPrimitiveID speaker;
  RCRegion* region[2];
  bool started;
  int blocks;
};

#endif
