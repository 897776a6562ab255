// Sends the robot one wrong vector after the other, each of them twice, then one with nothing in it, and one that moves
// the head.
#include "Clumsy.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>
#include <string.h>

Clumsy::Clumsy() : readies(0) {}

OStatus Clumsy::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  OPENR::OpenPrimitive("PRM:/r1/c1/c2-Joint2:12", &pan);
  OPENR::OpenPrimitive("PRM:/r1/c1/c2/c3/la-LED3:la", &face);
  OPENR::OpenPrimitive("PRM:/a1-Sensor:a1", &gravity);
  return oSUCCESS;
}

OStatus Clumsy::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Clumsy::DoStop(const OSystemEvent& event) { return oSUCCESS; }

OStatus Clumsy::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

OCommandVectorData* Clumsy::vector(ODataType type, OPrimitiveID id, int frames) {
  MemoryRegionID memory;
  OCommandVectorData* made;
  OPENR::NewCommandVectorData(1, &memory, &made);
  made->SetNumData(1);
  made->GetInfo(0)->Set(type, id, frames);
  ((OJointCommandValue2*)made->GetData(0)->value)[0].value = 100000;
  region = new RCRegion(made->vectorInfo.memRegionID, made->vectorInfo.offset, (void*)made, made->vectorInfo.totalSize);
  return made;
}

void Clumsy::Ready(const OReadyEvent& event) {
  char junk[400];
  memset(junk, 'U', sizeof(junk));
  switch (readies++ / 2) {
    case 0: vector(odataJOINT_COMMAND2, 4711, 1); break;
    case 1: vector(odataJOINT_COMMAND2, oprimitiveID_UNDEF, 1); break;
    case 2: vector(odataJOINT_COMMAND2, gravity, 1); break;
    case 3: vector(odataJOINT_COMMAND2, face, 1); break;
    case 4: vector(odataJOINT_COMMAND2, pan, 0); break;
    case 5: vector(odataJOINT_COMMAND2, pan, 40); break;
    case 6: vector(odataJOINT_COMMAND2, pan, 1)->GetInfo(0)->dataOffset = 1000; break;
    case 7: vector(odataJOINT_COMMAND2, pan, 0)->SetNumData(5); break;
    case 8: region = new RCRegion(10); break;
    case 9: region = new RCRegion(sizeof(junk)); memcpy(region->Base(), junk, sizeof(junk)); break;
    case 10: vector(odataUNDEF, oprimitiveID_UNDEF, 0); break;
    case 11: vector(odataJOINT_COMMAND2, pan, 1); break;
    default: return;
  }
  subject[sbjMove]->SetData(region);
  subject[sbjMove]->NotifyObservers();
  region->RemoveReference();
}
