// A program of our own for the tests.
#ifndef Faulty_h
#define Faulty_h

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include "def.h"

class Faulty : public OObject {
 public:
  Faulty();
  virtual ~Faulty() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void Notify(const ONotifyEvent& event);
  int deep(int n);
  int same(int twice, int twice);
  int forgets(int n);
};

#endif
