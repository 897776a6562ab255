#ifndef Asked_H
#define Asked_H
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include "def.h"

class Asked : public OObject {
 public:
  Asked() {}
  virtual ~Asked() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);
};
#endif
