#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include "def.h"

class Slow : public OObject {
 public:
  Slow() {}
  virtual ~Slow() {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent&);
  virtual OStatus DoStart(const OSystemEvent&);
  virtual OStatus DoStop(const OSystemEvent&);
  virtual OStatus DoDestroy(const OSystemEvent&);
  OStatus Con(const OConnectEvent& e) {
    OSYSPRINT(("con %s %d\n", e.SubName(), e.IsConnect()));
    return oSUCCESS;
  }
  void Got(const ONotifyEvent& e);
  void Reg(const ONotifyEvent& e);
  int n;
};
