// A program of our own for the tests.
#ifndef Source_h
#define Source_h

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include "def.h"

class Source : public OObject {
 public:
  Source();
  virtual ~Source() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  OStatus Control(const OControlEvent& event);
  void Ready(const OReadyEvent& event);
  void Tick(const ONotifyEvent& event);

 private:
  void tell(const char* what);
  void work(const char* line);
  int sent;
  FILE* script;
};

#endif
