#ifndef Idiom_H
#define Idiom_H
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <math.h>
#include <cstdio>
#include <list>
#include <map>
#include <string>
#include <vector>
#include "def.h"
class Idiom : public OObject {
 public:
  Idiom();
  virtual ~Idiom() {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);
  void go();
  void machine();
};
#endif
