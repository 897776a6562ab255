#include <OPENR/OObject.h>
#include <OPENR/OObserverVector.h>
#include <OPENR/OSubject.h>
#include <OPENR/ObjcommMessages.h>
#include "def.h"
class Relay : public OObject {
 public:
  Relay() {}
  OSubject* subject[numOfSubject];
  OObserverVector* observer[numOfObserver];
  OStatus DoInit(const OSystemEvent&);
  OStatus DoStart(const OSystemEvent&);
  OStatus DoStop(const OSystemEvent&);
  OStatus DoDestroy(const OSystemEvent&);
  void Ready(const OReadyEvent& event);
  void Update(const ONotifyEvent& event);
};
