#ifndef IDLER_H
#define IDLER_H
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include "def.h"
class Idler : public OObject {
 public:
  Idler() : done(false) {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  OStatus DoInit(const OSystemEvent& event);
  OStatus DoStart(const OSystemEvent& event);
  OStatus DoStop(const OSystemEvent& event);
  OStatus DoDestroy(const OSystemEvent& event);
  void Sensed(const ONotifyEvent& event);

 private:
  bool done;
};
#endif
