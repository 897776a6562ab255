#ifndef MOTION_H
#define MOTION_H
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include "Order.h"
#include "def.h"
class Motion : public OObject {
 public:
  Motion();
  virtual ~Motion() {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent&);
  virtual OStatus DoStart(const OSystemEvent&);
  virtual OStatus DoStop(const OSystemEvent&);
  virtual OStatus DoDestroy(const OSystemEvent&);
  OStatus Connected(const OConnectEvent& e);
  void MoveReady(const OReadyEvent& e);
  void GotOrder(const ONotifyEvent& e);

 private:
  void send(float pan);
  static const size_t NVEC = 4;
  OPrimitiveID ids[3];
  RCRegion* regions[NVEC];
};
#endif
