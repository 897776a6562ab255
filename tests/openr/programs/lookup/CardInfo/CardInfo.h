#ifndef CardInfo_h_DEFINED
#define CardInfo_h_DEFINED
#include <ERA201D1.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserverVector.h>
#include <OPENR/OSubject.h>
#include "def.h"
class CardInfo : public OObject {
 public:
  CardInfo();
  virtual ~CardInfo() {}
  OSubject* subject[numOfSubject];
  OObserverVector* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent&);
  virtual OStatus DoStart(const OSystemEvent&);
  virtual OStatus DoStop(const OSystemEvent&);
  virtual OStatus DoDestroy(const OSystemEvent&);
  void Power(void* msg);
  void Show(const EtherDriverGetMACAddressMsg& msg);
};
#endif
