// What a primitive can be asked for beyond its commands.
#ifndef BTR_OPENR_OPRIMITIVECONTROL_H
#define BTR_OPENR_OPRIMITIVECONTROL_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>

const OPrimitiveRequest oprmreqCOMMON_BASE = 0;
const OPrimitiveRequest oprmreqSPEAKER_BASE = 128;
const OPrimitiveRequest oprmreqMIC_BASE = 256;
const OPrimitiveRequest oprmreqCAM_BASE = 384;
const OPrimitiveRequest oprmreqBT_BASE = 512;
const OPrimitiveRequest oprmreqJOINT2_BASE = 640;
const OPrimitiveRequest oprmreqLED2_BASE = 768;
const OPrimitiveRequest oprmreqSENSOR_BASE = 896;
const OPrimitiveRequest oprmreqLED3_BASE = 1024;
const OPrimitiveRequest oprmreqJOINT4_BASE = 1152;
const OPrimitiveRequest oprmreqPRIVATE_BASE = 1048576;
const OPrimitiveRequest oprmreqSPEAKER_MUTE_ON = oprmreqSPEAKER_BASE + 0;
const OPrimitiveRequest oprmreqSPEAKER_MUTE_OFF = oprmreqSPEAKER_BASE + 1;
const OPrimitiveRequest oprmreqSPEAKER_SET_VOLUME = oprmreqSPEAKER_BASE + 2;
const OPrimitiveRequest oprmreqSPEAKER_SET_SOUND_TYPE = oprmreqSPEAKER_BASE + 3;
const OPrimitiveRequest oprmreqSPEAKER_GET_SOUND_TYPE = oprmreqSPEAKER_BASE + 4;
const OPrimitiveRequest oprmreqSPEAKER_SET_VOLUME_MIDI = oprmreqSPEAKER_BASE + 5;
const OPrimitiveRequest oprmreqSPEAKER_MASTER_TUNING_MIDI = oprmreqSPEAKER_BASE + 6;
const OPrimitiveRequest oprmreqMIC_UNI = oprmreqMIC_BASE + 0;
const OPrimitiveRequest oprmreqMIC_OMNI = oprmreqMIC_BASE + 1;
const OPrimitiveRequest oprmreqMIC_ALC_ON = oprmreqMIC_BASE + 2;
const OPrimitiveRequest oprmreqMIC_ALC_OFF = oprmreqMIC_BASE + 3;
const OPrimitiveRequest oprmreqCAM_SET_WHITE_BALANCE = oprmreqCAM_BASE + 0;
const OPrimitiveRequest oprmreqCAM_SET_GAIN = oprmreqCAM_BASE + 1;
const OPrimitiveRequest oprmreqCAM_SET_SHUTTER_SPEED = oprmreqCAM_BASE + 2;
const OPrimitiveRequest oprmreqCAM_GET_CDT_TABLE = oprmreqCAM_BASE + 3;
const OPrimitiveRequest oprmreqCAM_AE_ON = oprmreqCAM_BASE + 4;
const OPrimitiveRequest oprmreqCAM_AE_OFF = oprmreqCAM_BASE + 5;
const OPrimitiveRequest oprmreqCAM_AWB_ON = oprmreqCAM_BASE + 6;
const OPrimitiveRequest oprmreqCAM_AWB_OFF = oprmreqCAM_BASE + 7;
const OPrimitiveRequest oprmreqBT_ATTACH = oprmreqBT_BASE + 0;
const OPrimitiveRequest oprmreqBT_DETACH = oprmreqBT_BASE + 1;
const OPrimitiveRequest oprmreqJOINT2_SET_COMMAND = oprmreqJOINT2_BASE + 0;
const OPrimitiveRequest oprmreqJOINT2_GET_VALUE = oprmreqJOINT2_BASE + 1;
const OPrimitiveRequest oprmreqLED2_SET_COMMAND = oprmreqLED2_BASE + 0;
const OPrimitiveRequest oprmreqSENSOR_WATCH_BT_SWITCH = oprmreqSENSOR_BASE + 0;
const OPrimitiveRequest oprmreqLED3_SET_COMMAND = oprmreqLED3_BASE + 0;
const OPrimitiveRequest oprmreqJOINT4_SET_COMMAND = oprmreqJOINT4_BASE + 0;

typedef longword OSpeakerSoundType;
const OSpeakerSoundType ospksndMONO8K8B = 0;
const OSpeakerSoundType ospksndMONO11K8B = 1;
const OSpeakerSoundType ospksndMONO16K8B = 2;
const OSpeakerSoundType ospksndMONO16K16B = 3;
const OSpeakerSoundType ospksndSTEREO16K16B = 4;

/// [dB/256], a 16-bit number with sign.
typedef longword OSpeakerVolume;
const OSpeakerVolume ospkvolinfdB = 0x8000;
const OSpeakerVolume ospkvol25dB = 0xe700;
const OSpeakerVolume ospkvol18dB = 0xee00;
const OSpeakerVolume ospkvol10dB = 0xf600;

const longword ocamparamUNDEF = 0;
const longword ocamparamWB_INDOOR_MODE = 1;
const longword ocamparamWB_OUTDOOR_MODE = 2;
const longword ocamparamWB_FL_MODE = 3;
const longword ocamparamGAIN_LOW = 1;
const longword ocamparamGAIN_MID = 2;
const longword ocamparamGAIN_HIGH = 3;
const longword ocamparamSHUTTER_SLOW = 1;
const longword ocamparamSHUTTER_MID = 2;
const longword ocamparamSHUTTER_FAST = 3;

typedef longword OBtSwitchEvent;
const OBtSwitchEvent obtswitcheventUNDEF = 0;
const OBtSwitchEvent obtswitcheventVALUE_CHANGED = 1;

struct OPrimitiveControl_SpeakerVolume {
  longword volume;
  OPrimitiveControl_SpeakerVolume() : volume(ospkvolinfdB) {}
  OPrimitiveControl_SpeakerVolume(longword vol) : volume(vol) {}
};

struct OPrimitiveControl_SpeakerSoundType {
  OSpeakerSoundType type;
  OPrimitiveControl_SpeakerSoundType() : type(ospksndMONO8K8B) {}
  OPrimitiveControl_SpeakerSoundType(OSpeakerSoundType t) : type(t) {}
};

struct OPrimitiveControl_MasterTuningMIDI {
  sword value;
  OPrimitiveControl_MasterTuningMIDI() : value(0) {}
  OPrimitiveControl_MasterTuningMIDI(sword v) : value(v) {}
};

struct OPrimitiveControl_CameraParam {
  longword camparam;
  OPrimitiveControl_CameraParam() : camparam(ocamparamUNDEF) {}
  OPrimitiveControl_CameraParam(longword param) : camparam(param) {}
};

struct OPrimitiveControl_Cdt {
  longword index;
  byte table[100];
  OPrimitiveControl_Cdt() : index(0) {}
  OPrimitiveControl_Cdt(longword idx) : index(idx) {}
};

struct OPrimitiveControl_JointCommandValue2 {
  OJointCommandValue2 command;
  OPrimitiveControl_JointCommandValue2(slongword v = 0) {
    command.value = v;
    command.padding = 0;
  }
};

struct OPrimitiveControl_JointValue {
  OJointValue jval;
  OPrimitiveControl_JointValue() {}
  OPrimitiveControl_JointValue(slongword val, word sig, sword pwm, slongword rv, word rs)
      : jval(val, sig, pwm, rv, rs) {}
};

struct OPrimitiveControl_LEDCommandValue2 {
  OLEDCommandValue2 command;
  OPrimitiveControl_LEDCommandValue2(OLEDValue l = oledOFF) {
    command.led = l;
    command.period = 0;
    command.reserved = 0;
  }
};

struct OPrimitiveControl_BtSwitchWatcherInfo {
  OBtSwitchEvent event;
  OServiceEntry entry;
  OPrimitiveControl_BtSwitchWatcherInfo() : event(obtswitcheventUNDEF) {}
  OPrimitiveControl_BtSwitchWatcherInfo(OBtSwitchEvent ev, const OServiceEntry& e) : event(ev), entry(e) {}
};

struct OPrimitiveControl_BtSwitchEvent {
  OBtSwitchEvent event;
  OSwitchValue value;
  OPrimitiveControl_BtSwitchEvent() : event(obtswitcheventUNDEF), value(oswitchOFF) {}
  OPrimitiveControl_BtSwitchEvent(OBtSwitchEvent ev, OSwitchValue val) : event(ev), value(val) {}
};

struct OPrimitiveControl_LEDCommandValue3 {
  OLEDCommandValue3 command;
  OPrimitiveControl_LEDCommandValue3(sword b = 0, OLED3Mode m = oled3_MODE_UNDEF) {
    command.intensity = b;
    command.mode = m;
    command.period = 0;
    command.reserved = 0;
  }
};

struct OPrimitiveControl_JointCommandValue4 {
  OJointCommandValue4 command;
  OPrimitiveControl_JointCommandValue4(OJointValue4 v = ojoint4_STATE_UNDEF) {
    command.value = v;
    command.period = 0;
    command.reserved = 0;
  }
};

#endif
