// A program of our own for the tests.
#ifndef Sink_h
#define Sink_h

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include "def.h"

class Sink : public OObject {
 public:
  Sink();
  virtual ~Sink() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  OStatus Connect(const OConnectEvent& event);
  void Notify(const ONotifyEvent& event);
};

#endif
