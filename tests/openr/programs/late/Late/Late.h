#ifndef Late_H
#define Late_H
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <TCPEndpointMsg.h>
#include <ant.h>
#include "def.h"
class Late : public OObject {
 public:
  Late() : listens(false) {}
  virtual ~Late() {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);
  void Sensed(const ONotifyEvent& event);
  void Connected(ANTENVMSG msg);
  void Heard(ANTENVMSG msg);

 private:
  antModuleRef Endpoint();
  antStackRef stack;
  antModuleRef client, server;
  bool listens;
};
#endif
