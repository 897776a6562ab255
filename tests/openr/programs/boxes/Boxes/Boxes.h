#ifndef Boxes_h_DEFINED
#define Boxes_h_DEFINED
#include <OPENR/ODeque.h>
#include <OPENR/OList.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OQueue.h>
#include <OPENR/OShmPtr.h>
#include <OPENR/OSubject.h>
#include "def.h"
struct Shape {
  int id;
  double x, y;
  char name[20];
};
struct Passwd {
  char user[16];
  char pass[16];
};
static const int MAX_LOGIN = 3;
class Boxes : public OObject {
 public:
  Boxes();
  virtual ~Boxes() {}
  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];
  virtual OStatus DoInit(const OSystemEvent&);
  virtual OStatus DoStart(const OSystemEvent&);
  virtual OStatus DoStop(const OSystemEvent&);
  virtual OStatus DoDestroy(const OSystemEvent&);
  void Ready(const OReadyEvent& event);
  void Notify(const ONotifyEvent& event);

 private:
  void Lists();
  void Times();
  OList<Passwd, MAX_LOGIN> logins;
  OQueue<int, 4> queue;
  OShmPtr<Shape> shape;
  int sent;
};
#endif
