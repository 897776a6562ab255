// A program of our own for the tests.
#ifndef Looker_h
#define Looker_h

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include "def.h"

class Looker : public OObject {
 public:
  Looker();
  virtual ~Looker() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void Notify(const ONotifyEvent& event);

 private:
  OPrimitiveID camera;
};

#endif
