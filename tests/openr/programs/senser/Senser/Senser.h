// A program of our own for the tests.
#ifndef Senser_h
#define Senser_h

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include "def.h"

class Senser : public OObject {
 public:
  Senser();
  virtual ~Senser() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void Notify(const ONotifyEvent& event);
  void Power(void* message);

 private:
  OPrimitiveID pan, up, near;
  RCRegion* kept;
};

#endif
