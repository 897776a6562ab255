#pragma once
#include <OPENR/ODataFormats.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <map>
#include <string>
#include "Order.h"
#include "def.h"
class Module {
 public:
  virtual ~Module() {}
  virtual void step(int) = 0;
  virtual const char* name() const { return "?"; }
};
class Brain : public OObject {
 public:
  Brain();
  virtual ~Brain() {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent&);
  virtual OStatus DoStart(const OSystemEvent&);
  virtual OStatus DoStop(const OSystemEvent&);
  virtual OStatus DoDestroy(const OSystemEvent&);
  OStatus Controlled(const OControlEvent& e);
  void OrdersReady(const OReadyEvent& e);
  void GotSensor(const ONotifyEvent& e);

 private:
  std::map<std::string, Module*> modules;
  int n;
};
