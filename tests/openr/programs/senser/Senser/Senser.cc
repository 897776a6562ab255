#include "Senser.h"

#include <MCOOP.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/OUnits.h>
#include <OPENR/core_macro.h>

Senser::Senser() : kept(0) {}

OStatus Senser::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  char name[orobotdesignNAME_MAX + 1];
  OPENR::GetRobotDesign(name);
  ODesignDataID id;
  byte* data;
  size_t size;
  OPENR::FindDesignData("OWN", &id, &data, &size);
  OSYSPRINT(("%s %.*s", name, (int)size, (char*)data));
  OPENR::DeleteDesignData(id);
  OPENR::FindDesignData("COMMON", &id, &data, &size);
  OSYSPRINT((" %.*s %d\n", (int)size, (char*)data, OPENR::FindDesignData("NONE", &id, &data, &size)));
  OPENR::OpenPrimitive("PRM:/r1/c1/c2-Joint2:12", &pan);
  OPENR::OpenPrimitive("PRM:/a3-Sensor:a3", &up);
  OPENR::OpenPrimitive("PRM:/r1/c1/c2/c3/p1-Sensor:p1", &near);
  OPowerStatus wanted;
  wanted.Set(orsbALL, 0, opsoREMAINING_CAPACITY_NOT_NOTIFY, opsoTEMPERATURE_NOT_NOTIFY, opsoTIME_DIF_NOT_NOTIFY,
             opsoVOLUME_NOT_NOTIFY);
  OSYSPRINT(("observe %d\n", OPENR::ObservePowerStatus(wanted, OServiceEntry(myOID_, Extra_Entry[entryPower]))));
  return oSUCCESS;
}

OStatus Senser::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;

  return oSUCCESS;
}

OStatus Senser::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Senser::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void Senser::Notify(const ONotifyEvent& event) {
  OSensorFrameVectorData* vector = (OSensorFrameVectorData*)event.Data(0);
  static int count = 0;
  if (count++ < 2) {
    OSYSPRINT(("vector of %d, frames %d from %d\n", (int)vector->vectorInfo.numData, (int)vector->GetInfo(0)->numFrames,
               (int)vector->GetInfo(0)->frameNumber));
    for (int i = 0; i < (int)vector->vectorInfo.numData; i++) {
      OSensorFrameInfo* info = vector->GetInfo(i);
      OSensorFrameData* data = vector->GetData(i);
      if (info->primitiveID == pan) {
        OJointValue* joint = (OJointValue*)&data->frame[3];
        OSYSPRINT(("pan %d ref %d type %d\n", joint->value, joint->refValue, (int)info->type));
      }
      if (info->primitiveID == up) OSYSPRINT(("up %d\n", data->frame[0].value));
      if (info->primitiveID == near)
        OSYSPRINT(("near %d %d %d %d\n", data->frame[0].signal != 0, data->frame[1].signal != 0,
                   data->frame[2].signal != 0, data->frame[3].signal != 0));
    }
    OJointValue now;
    OSensorValue value;
    OPENR::GetJointValue(pan, &now);
    OPENR::GetSensorValue(up, &value);
    OSYSPRINT(("calls %d %d\n", now.value, value.value));
    SystemTime time;
    GetSystemTime(&time);
    OSYSPRINT(("time %d %d\n", time.seconds, time.useconds));
    kept = event.RCData(0);
    kept->AddReference();  // longer than until the next assert
    OSYSPRINT(("references %d\n", kept->NumberOfReference()));
  }
  observer[event.ObsIndex()]->AssertReady();
}

void Senser::Power(void* message) {
  OPowerStatusMessage* notice = (OPowerStatusMessage*)message;
  OSYSPRINT(("pause %d\n", (notice->powerStatus.robotStatus & orsbPAUSE) != 0));
  if (notice->powerStatus.robotStatus & orsbPAUSE) {
    OPowerStatus status;
    OPENR::GetPowerStatus(&status);
    OSYSPRINT(("capacity %d\n", status.remainingCapacity));
    OBootCondition condition(obcbPAUSE_SW);
    OPENR::Shutdown(condition);
  }
}
