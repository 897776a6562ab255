#ifndef Passive_H
#define Passive_H
#include <EndpointTypes.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <TCPEndpointMsg.h>
#include <ant.h>

#include "def.h"

class Passive : public OObject {
 public:
  Passive();
  virtual ~Passive() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void ListenCont(ANTENVMSG msg);
  void ReceiveCont(ANTENVMSG msg);
  void DataListenCont(ANTENVMSG msg);
  void ConnectCont(ANTENVMSG msg);
  void DataConnectCont(ANTENVMSG msg);
  void SendCont(ANTENVMSG msg);

 private:
  antModuleRef Endpoint();

  antStackRef stack;
  antModuleRef server, client, serverData, clientData;
  antSharedBuffer buffer;
  byte* bytes;
};
#endif
