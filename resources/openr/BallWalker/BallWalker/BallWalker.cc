#include "BallWalker.h"

#include <OPENR/OFbkImage.h>
#include <OPENR/OSyslog.h>
#include <OPENR/OUnits.h>
#include <OPENR/core_macro.h>
#include <math.h>
#include <string.h>

static const char* const locators[] = {"PRM:/r1/c1-Joint2:11", "PRM:/r1/c1/c2-Joint2:12", "PRM:/r1/c1/c2/c3-Joint2:13",
                                       "PRM:/r2/c1-Joint2:21", "PRM:/r2/c1/c2-Joint2:22", "PRM:/r2/c1/c2/c3-Joint2:23",
                                       "PRM:/r3/c1-Joint2:31", "PRM:/r3/c1/c2-Joint2:32", "PRM:/r3/c1/c2/c3-Joint2:33",
                                       "PRM:/r4/c1-Joint2:41", "PRM:/r4/c1/c2-Joint2:42", "PRM:/r4/c1/c2/c3-Joint2:43",
                                       "PRM:/r5/c1-Joint2:51", "PRM:/r5/c1/c2-Joint2:52", "PRM:/r5/c1/c2/c3-Joint2:53"};
static const char* const cameraLocator = "PRM:/r1/c1/c2/c3/i1-FbkImageSensor:F1";
enum { leftFront, leftRear, rightFront, rightRear };

// Gains as Sony gives them: head, then a leg.
static const word headGains[][3] = {{0x0a, 0x04, 0x02}, {0x08, 0x02, 0x04}, {0x08, 0x04, 0x02}};
static const word legGains[][3] = {{0x1c, 0x08, 0x01}, {0x14, 0x04, 0x01}, {0x1c, 0x08, 0x01}};
static const word pShift = 0x0e, iShift = 0x02, dShift = 0x0f;

// What counts as the ball's orange: red and no blue, bright enough. At least so many pixels of layer C.
static const byte crMax = 255, crMin = 150, cbMax = 100, cbMin = 0;
static const int darkestSegment = 6, leastPixels = 3;

// The head: what the camera sees from side to side and from top to bottom [rad], the share that is made good with each
// image, how far it turns at most in a frame, and its range.
static const double wide = 0.993, high = 0.789, share = 0.2, most = 0.02;
static const double lowest[] = {-1.25, -1.4, -0.2}, highest[] = {0, 1.4, 0.7};

// The walk, a trot: legs swing about these angles (front and rear leg), once in a cycle, and fold while they go ahead.
static const double pi = 3.14159265358979, frame_s = 0.008, cycle_s = 0.48;
static const double middle[2][3] = {{-0.2, 0.05, 1.45}, {-0.3, 0.05, 1.5}};
static const double swing = 0.35, fold = 0.7;
// Where the head looks tells where the ball is: legs turn the dog until it is ahead, and rest when the head looks down
// to it. So many images without the ball, and the dog stands; strides grow and shrink slowly.
static const double turnPerPan = 1.2, near = -0.6, change = 0.01;
static const int patience = 15;
// Then the head looks so far to either side, so many images for there and back.
static const double aside = 0.9, straight = -0.3;
static const int imagesOfSearch = 90;

static double Within(double value, double low, double up) { return value < low ? low : value > up ? up : value; }

BallWalker::BallWalker()
    : camera(oprimitiveID_UNDEF), phase(0), stride(0), turn(0), images(0), missed(patience), there(false) {
  for (int j = 0; j < joints; j++) joint[j] = oprimitiveID_UNDEF;
  for (int j = 0; j < LEGS; j++) wanted[j] = told[j] = 0;
  wanted[TILT] = straight;
}

OStatus BallWalker::DoInit(const OSystemEvent&) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  OpenAll();
  MakeRegions();
  return oSUCCESS;
}

OStatus BallWalker::DoStart(const OSystemEvent&) {
  OPENR::SetMotorPower(opowerON);
  for (int j = 0; j < joints; j++) {
    const word* gain = j < LEGS ? headGains[j] : legGains[(j - LEGS) % 3];
    OPENR::EnableJointGain(joint[j]);
    OPENR::SetJointGain(joint[j], gain[0], gain[1], gain[2], pShift, iShift, dShift);
  }
  SetColour();
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus BallWalker::DoStop(const OSystemEvent&) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus BallWalker::DoDestroy(const OSystemEvent&) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void BallWalker::Ready(const OReadyEvent&) {
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
void BallWalker::Look(const ONotifyEvent& event) {
  OFbkImageVectorData* vector = (OFbkImageVectorData*)event.Data(0);
  OFbkImage image(vector->GetInfo(ofbkimageLAYER_C), vector->GetData(ofbkimageLAYER_C), ofbkimageBAND_CDT);
  double sumX = 0, sumY = 0;
  int count = 0;
  if (image.IsValid())
    for (int y = 0; y < image.Height() - 1; y++)  // the last row is a tag
      for (int x = 0; x < image.Width(); x++)
        if (image.Pixel(x, y) & ocdtCHANNEL0) {
          sumX += x;
          sumY += y;
          count++;
        }
  if (count >= leastPixels) {
    if (images++ == 0) OSYSPRINT(("there is the ball\n"));
    missed = 0;
    wanted[PAN] = told[PAN] - share * (sumX / count / image.Width() - 0.5) * wide;
    wanted[TILT] = told[TILT] - share * (sumY / count / image.Height() - 0.5) * high;
  } else if (missed++ >= patience) {
    if (missed == patience + 1) OSYSPRINT(("where is the ball?\n"));
    // Looks about.
    wanted[PAN] = aside * sin(2 * pi * (missed - patience) / imagesOfSearch);
    wanted[TILT] = straight;
  }
  for (int j = 0; j < LEGS; j++) wanted[j] = Within(wanted[j], lowest[j], highest[j]);
  const bool was = there;
  there = there || (missed == 0 && told[TILT] < near);
  if (there && !was) OSYSPRINT(("here I am\n"));
  observer[event.ObsIndex()]->AssertReady();
}

void BallWalker::OpenAll() {
  OPENR::OpenPrimitive(cameraLocator, &camera);
  for (int j = 0; j < joints; j++)
    if (OPENR::OpenPrimitive(locators[j], &joint[j]) != oSUCCESS) OSYSLOG1((osyslogERROR, "no %s", locators[j]));
}

void BallWalker::SetColour() {
  MemoryRegionID id;
  OCdtVectorData* table;
  OPENR::NewCdtVectorData(&id, &table);
  table->SetNumData(1);
  table->GetInfo(0)->Init(camera, ocdtCHANNEL0);
  for (int segment = darkestSegment; segment < ocdtMAX_Y_SEGMENT; segment++)
    table->GetInfo(0)->Set(segment, crMax, crMin, cbMax, cbMin);
  OPENR::SetCdtVectorData(id);
  OPENR::DeleteCdtVectorData(id);
}

void BallWalker::MakeRegions() {
  for (int n = 0; n < regions; n++) {
    MemoryRegionID id;
    OCommandVectorData* vector;
    OPENR::NewCommandVectorData(joints, &id, &vector);
    vector->SetNumData(joints);
    for (int j = 0; j < joints; j++) vector->GetInfo(j)->Set(odataJOINT_COMMAND2, joint[j], framesOfVector);
    region[n] = new RCRegion(vector->vectorInfo.memRegionID, vector->vectorInfo.offset, (void*)vector,
                             vector->vectorInfo.totalSize);
  }
}

// Diagonal legs together. J1 is forward of a front leg and backward of a rear one.
double BallWalker::Leg(int leg, int part) const {
  const bool front = leg == leftFront || leg == rightFront, left = leg == leftFront || leg == leftRear;
  const double at = phase + (leg == leftFront || leg == rightRear ? 0 : pi);
  const double side = left ? 1 - turn : 1 + turn;
  double angle = middle[front ? 0 : 1][part];
  if (part == 0) angle += (front ? 1 : -1) * swing * stride * side * sin(at);
  if (part == 2) angle += fold * stride * fmax(0.0, cos(at));
  return angle;
}

void BallWalker::Fill(RCRegion* to) {
  OCommandVectorData* vector = (OCommandVectorData*)to->Base();
  for (int n = 0; n < framesOfVector; n++) {
    const bool walks = missed < patience && !there;
    stride = Within(stride + (walks ? change : -change), 0, 1);
    turn = walks ? Within(turnPerPan * told[PAN], -1, 1) : 0;
    phase += 2 * pi * frame_s / cycle_s;
    for (int j = 0; j < joints; j++) {
      if (j < LEGS) told[j] += Within(wanted[j] - told[j], -most, most);
      const double angle = j < LEGS ? told[j] : Leg((j - LEGS) / 3, (j - LEGS) % 3);
      ((OJointCommandValue2*)vector->GetData(j)->value)[n].value = micro(angle);
    }
  }
}
