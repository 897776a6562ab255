#ifndef HAND_H
#define HAND_H
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
class Hand : public OObject {
 public:
  Hand() : n(0) {}
  virtual ~Hand() {}
  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);
  void Sensor(const ONotifyEvent& event);
  OObserver* observer;
  int n;
};
#endif
