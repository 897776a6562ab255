// The dog walks to an orange ball that its camera sees, and stops before it. Its head follows the ball, and legs turn
// the dog to where the head looks.
#ifndef BALLWALKER_H
#define BALLWALKER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSubject.h>

#include "def.h"

class BallWalker : public OObject {
 public:
  BallWalker();
  virtual ~BallWalker() {}

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
  enum { TILT, PAN, HEAD, LEGS };  // then four legs of three joints each
  static const int joints = LEGS + 12;

  void OpenAll();
  void SetColour();
  void MakeRegions();
  void Fill(RCRegion* region);
  double Leg(int leg, int part) const;

  OPrimitiveID joint[joints], camera;
  RCRegion* region[regions];
  double wanted[LEGS], told[LEGS];  // of the head [rad]
  double phase;                     // of the walk [rad]
  double stride, turn;              // as they are now: 0 … 1, −1 … 1 (left)
  int images, missed;               // missed: one after the other, without the ball
  bool there;                       // before the ball
};

#endif
