#ifndef Timer_h_DEFINED
#define Timer_h_DEFINED
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include "def.h"
class Timer : public OObject {
 public:
  Timer() : times(0) {}
  virtual ~Timer() {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);
  void Once(void* msg);
  void Again(void* msg);

 private:
  EventID again, never;
  int times;
};
#endif
