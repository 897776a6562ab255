#ifndef _Dialect_h_DEFINED
#define _Dialect_h_DEFINED
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <fstream.h>
#include <iomanip.h>
#include <iostream.h>
#include <strstream.h>
#include "Old.h"
#include "def.h"

struct Frame {
  int n;
  Frame() : n(7) {}
  ~Frame() {}
};

class Dialect : public OObject {
 public:
  Dialect::Dialect();  // extra qualification
  virtual ~Dialect() {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent&);
  virtual OStatus DoStart(const OSystemEvent&);
  virtual OStatus DoStop(const OSystemEvent&);
  virtual OStatus DoDestroy(const OSystemEvent&);
  void Notified(const ONotifyEvent& event);
  void Timer(void* msg);
  void Other(void* msg) { cout << "other " << (int)msg << endl; }
  friend int peek(Dialect& d) { return d.secret; }

 private:
  static const int SIZE = 10;
  static const float RATE = 0.125;
  static const double PI_ = 3.14159;
  enum Mode {
    IDLE = 0,
    RUN,
  };
  Mode mode;
  int secret;
  const char* names[3];
  byte bytes[SIZE];
};
#endif
