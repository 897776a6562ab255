// Pan goes up by 1000 µrad a frame from its second vector on; mouth and ear once; a face lamp in three steps, started
// together with the second vector by keys.
#include "Mover.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/OUnits.h>
#include <OPENR/core_macro.h>

Mover::Mover() : readies(0), made(0) {}

OStatus Mover::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  OPENR::SetMotorPower(opowerON);
  OPENR::OpenPrimitive("PRM:/r1/c1/c2-Joint2:12", &pan);
  OPENR::OpenPrimitive("PRM:/r1/c1/c2/c3/c4-Joint2:14", &mouth);
  OPENR::OpenPrimitive("PRM:/r1/c1/c2/c3/e5-Joint4:15", &ear);
  OPENR::OpenPrimitive("PRM:/r1/c1/c2/c3/la-LED3:la", &face);
  OPENR::OpenPrimitive("PRM:/r1/c1/c2/c3/l3-LED2:l3", &mode);
  OPrimitiveID none;
  const OStatus unknown = OPENR::OpenPrimitive("PRM:/nothing", &none);
  OSYSPRINT(("unknown %d %x\n", unknown, none));
  OSYSPRINT(("gain %d\n", OPENR::SetJointGain(pan, 8, 2, 4, 14, 2, 15)));
  OPENR::EnableJointGain(oprimitiveID_UNDEF);
  OSYSPRINT(("gain %d\n", OPENR::SetJointGain(pan, 8, 2, 4, 14, 2, 15)));
  word p, i, d, ps, is, ds;
  OPENR::GetJointGain(pan, &p, &i, &d, &ps, &is, &ds);
  OSYSPRINT(("gains %d %d %d %d %d %d\n", p, i, d, ps, is, ds));
  moves[0] = make(2, pan, odataJOINT_COMMAND2, ocommandMAX_FRAMES);
  moves[1] = make(2, pan, odataJOINT_COMMAND2, ocommandMAX_FRAMES);
  shine = make(2, face, odataLED_COMMAND3, 3);
  OVRSyncKey root;
  OPENR::NewSyncKey(&root);
  OSYSPRINT(("keys %d %d\n", OPENR::DivideSyncKey(root, &first, &second), OPENR::CancelSyncKey(12345)));
  return oSUCCESS;
}

OStatus Mover::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;

  return oSUCCESS;
}

OStatus Mover::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Mover::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

RCRegion* Mover::make(int commands, OPrimitiveID id, ODataType type, int frames) {
  MemoryRegionID memory;
  OCommandVectorData* vector;
  OPENR::NewCommandVectorData(commands, &memory, &vector);
  vector->SetNumData(commands);
  vector->GetInfo(0)->Set(type, id, frames);
  return new RCRegion(vector->vectorInfo.memRegionID, vector->vectorInfo.offset, (void*)vector,
                      vector->vectorInfo.totalSize);
}

void Mover::Ready(const OReadyEvent& event) {
  readies++;
  if (readies > 4) return;
  OSYSPRINT(("ready %d refs %d %d\n", readies, moves[0]->NumberOfReference(), moves[1]->NumberOfReference()));
  const int count = readies == 1 ? 2 : 1;
  for (int k = 0; k < count; k++) {
    RCRegion* region = moves[0]->NumberOfReference() == 1 ? moves[0] : moves[1];
    if (region->NumberOfReference() != 1) continue;
    OCommandVectorData* vector = (OCommandVectorData*)region->Base();
    const int number = made++;
    OJointCommandValue2* values = (OJointCommandValue2*)vector->GetData(0)->value;
    for (int f = 0; f < (int)ocommandMAX_FRAMES; f++) values[f].value = (number * (int)ocommandMAX_FRAMES + f) * 1000;
    if (number == 0) {  // the mouth, too far
      vector->GetInfo(1)->Set(odataJOINT_COMMAND2, mouth, 1);
      ((OJointCommandValue2*)vector->GetData(1)->value)[0].value = oradians(-90);
    } else {  // the ear
      vector->GetInfo(1)->Set(odataJOINT_COMMAND4, ear, 1);
      OJointCommandValue4* out = (OJointCommandValue4*)vector->GetData(1)->value;
      out[0].value = ojoint4_STATE1;
      out[0].period = 1;
    }
    if (number == 1)
      vector->vectorInfo.syncKey = first;
    else
      vector->vectorInfo.syncKey = ovrsynckeyUNDEF;
    subject[sbjMove]->SetData(region);
  }
  subject[sbjMove]->NotifyObservers();
}

void Mover::ReadyShine(const OReadyEvent& event) {
  static int times = 0;
  if (times++ > 0) return;
  OCommandVectorData* vector = (OCommandVectorData*)shine->Base();
  OLEDCommandValue3* values = (OLEDCommandValue3*)vector->GetData(0)->value;
  for (int i = 0; i < 3; i++) {
    values[i].intensity = 100 * i + 55;
    values[i].mode = oled3_MODE_A;
    values[i].period = 4;
  }
  vector->GetInfo(1)->Set(odataLED_COMMAND2, mode, 1);
  OLEDCommandValue2* on = (OLEDCommandValue2*)vector->GetData(1)->value;
  on[0].led = oledON;
  on[0].period = 2;
  vector->vectorInfo.syncKey = second;
  vector->vectorInfo.wait = 3;
  subject[sbjShine]->SetData(shine);
  subject[sbjShine]->NotifyObservers();
}
