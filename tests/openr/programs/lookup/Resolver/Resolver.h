#ifndef Resolver_h_DEFINED
#define Resolver_h_DEFINED
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <ant.h>
#include "def.h"
class Resolver : public OObject {
 public:
  Resolver();
  virtual ~Resolver() {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);
  void ServerCont(ANTENVMSG msg);
  void HostCont(ANTENVMSG msg);

 private:
  void Ask();
  antStackRef ipstackRef;
  antModuleRef dns;
  int asked;
};
#endif
