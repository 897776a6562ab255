// The head's pan joint follows a sine. Its gains, and how far ahead of the path it is told, come from /MS/PARAMS.TXT.
#ifndef PANPATH_H
#define PANPATH_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSubject.h>

#include "def.h"

class PanPath : public OObject {
 public:
  PanPath();
  virtual ~PanPath() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  void Ready(const OReadyEvent& event);

 private:
  static const int regions = 2;
  static const int framesOfVector = 4;

  void ReadParameters();
  void MakeRegions();
  void Fill(RCRegion* region);

  OPrimitiveID pan;
  RCRegion* region[regions];
  double p, i, d;  // as OPEN-R counts them
  double ahead_s;  // the joint is told where the path will be so much later
  long frame;      // the next one
};

#endif
