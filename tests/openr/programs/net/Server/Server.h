// A program of our own for the tests.
#ifndef Server_h
#define Server_h

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include <TCPEndpointMsg.h>
#include <UDPEndpointMsg.h>
#include <ant.h>

#include "def.h"

class Server : public OObject {
 public:
  Server();
  virtual ~Server() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void ListenDone(void* message);
  void ReceiveDone(void* message);
  void SendDone(void* message);
  void CloseDone(void* message);
  void DatagramDone(void* message);

 private:
  void listen(int which);
  void receiveDatagram();
  antStackRef stack;
  antModuleRef endpoints[2], datagrams;
  antSharedBuffer buffers[2], datagramBuffer;
};

#endif
