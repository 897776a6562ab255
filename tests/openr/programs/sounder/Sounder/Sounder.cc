// Ten blocks of 32 ms at 8 kHz with a square wave.
#include "Sounder.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

Sounder::Sounder() : started(false), blocks(0) {}

OStatus Sounder::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  char design[orobotdesignNAME_MAX + 1];
  OPENR::GetRobotDesign(design);
  const bool inChest = strcmp(design, "ERS-7") == 0;
  OPENR::OpenPrimitive(inChest ? "PRM:/s1-Speaker:S1" : "PRM:/r1/c1/c2/c3/s1-Speaker:S1", &speaker);
  OPENR::ControlPrimitive(speaker, oprmreqSPEAKER_MUTE_OFF, 0, 0, 0, 0);
  OPrimitiveControl_SpeakerVolume volume(ospkvol10dB);
  OPENR::ControlPrimitive(speaker, oprmreqSPEAKER_SET_VOLUME, &volume, sizeof(volume), 0, 0);
  OPrimitiveControl_SpeakerSoundType type(ospksndMONO8K8B), now;
  OPENR::ControlPrimitive(speaker, oprmreqSPEAKER_SET_SOUND_TYPE, &type, sizeof(type), 0, 0);
  OPENR::ControlPrimitive(speaker, oprmreqSPEAKER_GET_SOUND_TYPE, 0, 0, &now, sizeof(now));
  OVolumeSwitch volumeSwitch;
  OPENR::GetVolumeSwitch(&volumeSwitch);
  OSYSPRINT(("type %d switch %d\n", (int)now.type, volumeSwitch));
  for (int i = 0; i < 2; i++) {
    MemoryRegionID memory;
    OSoundVectorData* vector;
    OPENR::NewSoundVectorData(1, 256, &memory, &vector);
    vector->SetNumData(1);
    vector->GetInfo(0)->Set(odataSOUND_VECTOR, speaker, 256);
    for (int k = 0; k < 256; k++) vector->GetData(0)[k] = (byte)(k % 16 < 8 ? 100 : -100);
    region[i] = new RCRegion(vector->vectorInfo.memRegionID, vector->vectorInfo.offset, (void*)vector,
                             vector->vectorInfo.totalSize);
  }
  return oSUCCESS;
}

OStatus Sounder::DoStart(const OSystemEvent& event) {
  ENABLE_ALL_SUBJECT;
  ASSERT_READY_TO_ALL_OBSERVER;
  started = true;
  OSYSPRINT(("ready at start %d\n", subject[sbjSpeaker]->IsReady() == true));
  for (int i = 0; i < 2; i++, blocks++) subject[sbjSpeaker]->SetData(region[i]);
  subject[sbjSpeaker]->NotifyObservers();
  return oSUCCESS;
}

OStatus Sounder::DoStop(const OSystemEvent& event) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus Sounder::DoDestroy(const OSystemEvent& event) {
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void Sounder::Ready(const OReadyEvent& event) {
  if (!started) return;
  if (blocks >= 10) {
    OSYSPRINT(("played %d\n", blocks));
    return;
  }
  RCRegion* free = region[0]->NumberOfReference() == 1 ? region[0] : region[1];
  if (free->NumberOfReference() != 1) return;
  subject[sbjSpeaker]->SetData(free);
  subject[sbjSpeaker]->NotifyObservers();
  blocks++;
}

void Sounder::Notify(const ONotifyEvent& event) {
  OSoundVectorData* vector = (OSoundVectorData*)event.Data(0);
  OSoundInfo* info = vector->GetInfo(0);
  static int count = 0;
  if (count++ == 0)
    OSYSPRINT(("mic %d Hz %d bits channels %d bytes %d\n", info->samplingRate, info->bitsPerSample, info->channel,
               (int)info->dataSize));
  observer[event.ObsIndex()]->AssertReady();
}
