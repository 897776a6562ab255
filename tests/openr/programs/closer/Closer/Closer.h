#ifndef Closer_H
#define Closer_H
#include <EndpointTypes.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <TCPEndpointMsg.h>
#include <ant.h>
#include "def.h"
class Closer : public OObject {
 public:
  Closer();
  virtual ~Closer() {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);
  void ListenCont(ANTENVMSG msg);
  void CloseCont(ANTENVMSG msg);
  void ConnectCont(ANTENVMSG msg);
  void Listen(Port);
  antStackRef stack;
  antModuleRef e, c;
  int rounds;
};
#endif
