#include "BallHead.h"

#include <OPENR/OFbkImage.h>
#include <OPENR/OSyslog.h>
#include <OPENR/OUnits.h>
#include <OPENR/core_macro.h>
#include <math.h>
#include <string.h>

static const char* const headLocators[] = {"PRM:/r1/c1-Joint2:11", "PRM:/r1/c1/c2-Joint2:12",
                                           "PRM:/r1/c1/c2/c3-Joint2:13"};
static const char* const eyeLocators[] = {"PRM:/r1/c1/c2/c3/li-LED3:li", "PRM:/r1/c1/c2/c3/lj-LED3:lj"};
static const char* const cameraLocator = "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1";

// Gains as Sony gives them.
static const word headGains[][3] = {{0x0a, 0x04, 0x02}, {0x08, 0x02, 0x04}, {0x08, 0x04, 0x02}};
static const word legGains[][3] = {{0x1c, 0x08, 0x01}, {0x14, 0x04, 0x01}, {0x1c, 0x08, 0x01}};
static const word pShift = 0x0e, iShift = 0x02, dShift = 0x0f;

// What counts as a ball's colour, bright enough: the league's orange, red and no blue, and the robot's own pink. A
// channel of the table each. At least so many pixels of layer C.
static const int colours = 2;
static const OCdtChannel channel[colours] = {ocdtCHANNEL0, ocdtCHANNEL1};
static const byte crMax[colours] = {255, 230}, crMin[colours] = {150, 150}, cbMax[colours] = {100, 190},
                  cbMin[colours] = {0, 120};
static const int darkestSegment = 6, leastPixels = 3;

// The camera sees so much from side to side and from top to bottom [rad]; of what the ball is off the middle, the head
// makes good this share with each image; it turns at most so far in a frame.
static const double wide = 0.993, high = 0.789, share = 0.25, most = 0.02;
static const double lowest[] = {-1.2, -1.4, -0.2}, highest[] = {0, 1.4, 0.7};

BallHead::BallHead() : camera(oprimitiveID_UNDEF), seen(0), unseen(0), sees(false) {
  for (int j = 0; j < joints; j++) {
    joint[j] = oprimitiveID_UNDEF;
    wanted[j] = told[j] = 0;
  }
  wanted[TILT] = -0.3;
}

OStatus BallHead::DoInit(const OSystemEvent&) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  MakeRegions();
  return oSUCCESS;
}

OStatus BallHead::DoStart(const OSystemEvent&) {
  OpenAll();
  SetColour();
  for (int n = 0; n < regions; n++) {
    OCommandVectorData* vector = (OCommandVectorData*)region[n]->Base();
    for (int j = 0; j < joints; j++) vector->GetInfo(j)->Set(odataJOINT_COMMAND2, joint[j], framesOfVector);
    for (int e = 0; e < eyes; e++) vector->GetInfo(joints + e)->Set(odataLED_COMMAND3, eye[e], 1);
  }
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus BallHead::DoStop(const OSystemEvent&) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  OSYSPRINT(("the ball was on %d of %d images\n", seen, seen + unseen));
  return oSUCCESS;
}

OStatus BallHead::DoDestroy(const OSystemEvent&) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void BallHead::Ready(const OReadyEvent&) {
  bool any = false;
  for (int n = 0; n < regions; n++) {
    if (region[n]->NumberOfReference() != 1) continue;
    Fill(region[n]);
    subject[sbjMove]->SetData(region[n]);
    any = true;
  }
  if (any) subject[sbjMove]->NotifyObservers();
}

// The middle of all pixels of the ball's colour, and the head towards it.
void BallHead::Look(const ONotifyEvent& event) {
  OFbkImageVectorData* images = (OFbkImageVectorData*)event.Data(0);
  OFbkImage image(images->GetInfo(ofbkimageLAYER_C), images->GetData(ofbkimageLAYER_C), ofbkimageBAND_CDT);
  double sumX = 0, sumY = 0;
  int count = 0;
  if (image.IsValid())
    for (int y = 0; y < image.Height() - 1; y++)  // the last row is a tag
      for (int x = 0; x < image.Width(); x++)
        if (image.Pixel(x, y) & (channel[0] | channel[1])) {
          sumX += x;
          sumY += y;
          count++;
        }
  sees = count >= leastPixels;
  if (sees) {
    const double right = sumX / count / image.Width() - 0.5, down = sumY / count / image.Height() - 0.5;
    wanted[PAN] = told[PAN] - share * right * wide;
    wanted[TILT] = told[TILT] - share * down * high;
    if (seen++ == 0) OSYSPRINT(("there is the ball: %d pixels\n", count));
  } else {
    unseen++;
  }
  for (int j = 0; j < joints; j++) wanted[j] = fmax(lowest[j], fmin(highest[j], wanted[j]));
  observer[event.ObsIndex()]->AssertReady();
}

// Motors on; the head's joints and the legs, which stay where they are.
void BallHead::OpenAll() {
  OPENR::SetMotorPower(opowerON);
  OPENR::OpenPrimitive(cameraLocator, &camera);
  for (int j = 0; j < joints; j++) {
    OPENR::OpenPrimitive(headLocators[j], &joint[j]);
    OPENR::EnableJointGain(joint[j]);
    OPENR::SetJointGain(joint[j], headGains[j][0], headGains[j][1], headGains[j][2], pShift, iShift, dShift);
  }
  for (int e = 0; e < eyes; e++) OPENR::OpenPrimitive(eyeLocators[e], &eye[e]);
  for (char leg = '2'; leg <= '5'; leg++)
    for (int part = 0; part < 3; part++) {
      char locator[] = "PRM:/rN/c1/c2/c3-Joint2:N1";
      char* end = locator + strlen("PRM:/rN") + 3 * (part + 1);
      strcpy(end, "-Joint2:N1");
      end[strlen("-Joint2:")] = locator[strlen("PRM:/r")] = leg;
      end[strlen("-Joint2:N")] = (char)('1' + part);
      OPrimitiveID id;
      if (OPENR::OpenPrimitive(locator, &id) != oSUCCESS) continue;
      OPENR::EnableJointGain(id);
      OPENR::SetJointGain(id, legGains[part][0], legGains[part][1], legGains[part][2], pShift, iShift, dShift);
    }
}

void BallHead::SetColour() {
  MemoryRegionID id;
  OCdtVectorData* table;
  OPENR::NewCdtVectorData(&id, &table);
  table->SetNumData(colours);
  for (int c = 0; c < colours; c++) {
    table->GetInfo(c)->Init(camera, channel[c]);
    for (int segment = darkestSegment; segment < ocdtMAX_Y_SEGMENT; segment++)
      table->GetInfo(c)->Set(segment, crMax[c], crMin[c], cbMax[c], cbMin[c]);
  }
  OPENR::SetCdtVectorData(id);
  OPENR::DeleteCdtVectorData(id);
}

void BallHead::MakeRegions() {
  for (int n = 0; n < regions; n++) {
    MemoryRegionID id;
    OCommandVectorData* vector;
    OPENR::NewCommandVectorData(joints + eyes, &id, &vector);
    vector->SetNumData(joints + eyes);
    region[n] = new RCRegion(vector->vectorInfo.memRegionID, vector->vectorInfo.offset, (void*)vector,
                             vector->vectorInfo.totalSize);
  }
}

void BallHead::Fill(RCRegion* to) {
  OCommandVectorData* vector = (OCommandVectorData*)to->Base();
  for (int j = 0; j < joints; j++) {
    OJointCommandValue2* value = (OJointCommandValue2*)vector->GetData(j)->value;
    for (int n = 0; n < framesOfVector; n++) {
      told[j] += fmax(-most, fmin(most, wanted[j] - told[j]));
      value[n].value = micro(told[j]);
    }
  }
  for (int e = 0; e < eyes; e++) {
    OLEDCommandValue3* value = (OLEDCommandValue3*)vector->GetData(joints + e)->value;
    value->intensity = sees ? 255 : 0;
    value->mode = oled3_MODE_A;
    value->period = framesOfVector;
  }
}
