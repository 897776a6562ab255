#include "PanPath.h"

#include <OPENR/OSyslog.h>
#include <OPENR/OUnits.h>
#include <OPENR/core_macro.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char* const panLocator = "PRM:/r1/c1/c2-Joint2:12";
static const double pi = 3.14159265358979;

// The path: 0.5 rad to either side, once a second. A frame lasts 8 ms.
static const double amplitude_rad = 0.5, frequency_hz = 1, frame_s = 0.008;

PanPath::PanPath() : pan(oprimitiveID_UNDEF), p(8), i(2), d(4), ahead_s(0), frame(0) {}

OStatus PanPath::DoInit(const OSystemEvent&) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  ReadParameters();
  if (OPENR::OpenPrimitive(panLocator, &pan) != oSUCCESS) OSYSLOG1((osyslogERROR, "no pan joint"));
  MakeRegions();
  return oSUCCESS;
}

OStatus PanPath::DoStart(const OSystemEvent&) {
  OPENR::SetMotorPower(opowerON);
  OPENR::EnableJointGain(pan);
  OPENR::SetJointGain(pan, (word)(p + 0.5), (word)(i + 0.5), (word)(d + 0.5), 0x0e, 0x02, 0x0f);
  OSYSPRINT(
      ("pan gains %d %d %d, %d ms ahead\n", (int)(p + 0.5), (int)(i + 0.5), (int)(d + 0.5), (int)(1000 * ahead_s)));
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus PanPath::DoStop(const OSystemEvent&) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus PanPath::DoDestroy(const OSystemEvent&) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

// The robot is ready for more: every vector that it has given back is filled and sent.
void PanPath::Ready(const OReadyEvent&) {
  bool any = false;
  for (int n = 0; n < regions; n++) {
    if (region[n]->NumberOfReference() != 1) continue;
    Fill(region[n]);
    subject[sbjMove]->SetData(region[n]);
    any = true;
  }
  if (any) subject[sbjMove]->NotifyObservers();
}

// Lines NAME VALUE; what is not there stays as it is.
void PanPath::ReadParameters() {
  FILE* file = fopen("/MS/PARAMS.TXT", "r");
  if (file == 0) return;
  char name[64];
  double value;
  while (fscanf(file, "%63s %lf", name, &value) == 2) {
    if (strcmp(name, "pan_p") == 0) p = value;
    if (strcmp(name, "pan_i") == 0) i = value;
    if (strcmp(name, "pan_d") == 0) d = value;
    if (strcmp(name, "ahead_ms") == 0) ahead_s = value / 1000;
  }
  fclose(file);
}

void PanPath::MakeRegions() {
  for (int n = 0; n < regions; n++) {
    MemoryRegionID id;
    OCommandVectorData* vector;
    OPENR::NewCommandVectorData(1, &id, &vector);
    vector->SetNumData(1);
    vector->GetInfo(0)->Set(odataJOINT_COMMAND2, pan, framesOfVector);
    region[n] = new RCRegion(vector->vectorInfo.memRegionID, vector->vectorInfo.offset, (void*)vector,
                             vector->vectorInfo.totalSize);
  }
}

void PanPath::Fill(RCRegion* to) {
  OCommandVectorData* vector = (OCommandVectorData*)to->Base();
  OJointCommandValue2* value = (OJointCommandValue2*)vector->GetData(0)->value;
  for (int n = 0; n < framesOfVector; n++, frame++)
    value[n].value = micro(amplitude_rad * sin(2 * pi * frequency_hz * (frame * frame_s + ahead_s)));
}
