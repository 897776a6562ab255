// A program of our own for the tests.
#ifndef Crier_h
#define Crier_h

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include <ant.h>

#include "def.h"

class Crier : public OObject {
 public:
  Crier();
  virtual ~Crier() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void Tick(const ONotifyEvent& event);
  void Heard(ANTENVMSG msg);

 private:
  void listen();

  antStackRef stack;
  antModuleRef endpoint;
  antSharedBuffer toSend, received;
  int number, frames;
};

#endif
