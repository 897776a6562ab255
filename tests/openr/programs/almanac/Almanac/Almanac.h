#ifndef Almanac_H
#define Almanac_H
#include <OPENR/OCalendarTime.h>
#include <OPENR/ODebug.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <Time_a.h>
#include <dirent.h>
#include <fstream.h>
#include <unistd.h>
#include "def.h"
class Almanac : public OObject {
 public:
  Almanac();
  virtual ~Almanac() {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);
  void list(const char* dir);
};
#endif
