// A program of our own for the tests.
#ifndef Client_h
#define Client_h

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include <DNSEndpointMsg.h>
#include <TCPEndpointMsg.h>
#include <UDPEndpointMsg.h>
#include <ant.h>

#include "def.h"

class Client : public OObject {
 public:
  Client();
  virtual ~Client() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void Connected(void* message);

 private:
  antStackRef stack;
  antModuleRef endpoint;
};

#endif
