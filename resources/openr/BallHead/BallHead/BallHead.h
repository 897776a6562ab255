// The head follows an orange ball that the camera sees; its eyes light up while it does. The dog stands.
#ifndef BALLHEAD_H
#define BALLHEAD_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSubject.h>

#include "def.h"

class BallHead : public OObject {
 public:
  BallHead();
  virtual ~BallHead() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void Ready(const OReadyEvent& event);
  void Look(const ONotifyEvent& event);

 private:
  static const int regions = 2;
  static const int framesOfVector = 4;
  enum Joint { TILT, PAN, HEAD, joints };
  static const int eyes = 2;

  void OpenAll();
  void SetColour();
  void MakeRegions();
  void Fill(RCRegion* region);

  OPrimitiveID joint[joints], eye[eyes], camera;
  RCRegion* region[regions];
  double wanted[joints];  // where the head shall look [rad]
  double told[joints];    // where it was told to be
  int seen, unseen;       // images with and without the ball
  bool sees;              // on the last one
};

#endif
