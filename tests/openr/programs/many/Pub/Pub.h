#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include "def.h"

class Pub : public OObject {
 public:
  Pub() {}
  virtual ~Pub() {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent&);
  virtual OStatus DoStart(const OSystemEvent&);
  virtual OStatus DoStop(const OSystemEvent&);
  virtual OStatus DoDestroy(const OSystemEvent&);
  OStatus Ctl(const OControlEvent& e);
  void Ready(const OReadyEvent& e);
  void RegReady(const OReadyEvent& e);
  void Tick(const ONotifyEvent& e);
  RCRegion* reg;
  int n;
};
