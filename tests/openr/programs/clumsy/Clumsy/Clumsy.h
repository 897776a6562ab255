// A program of our own for the tests.
#ifndef Clumsy_h
#define Clumsy_h

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>

#include "def.h"

class Clumsy : public OObject {
 public:
  Clumsy();
  virtual ~Clumsy() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void Ready(const OReadyEvent& event);

 private:
  OCommandVectorData* vector(ODataType type, OPrimitiveID id, int frames);
  OPrimitiveID pan, face, gravity;
  RCRegion* region;
  int readies;
};

#endif
