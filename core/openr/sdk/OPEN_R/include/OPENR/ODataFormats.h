// Vectors of data between objects and the robot, laid out as on the robot: sizes and offsets are 32 bits.
#ifndef BTR_OPENR_ODATAFORMATS_H
#define BTR_OPENR_ODATAFORMATS_H

#include <OPENR/OPENR.h>

typedef longword ODataType;
const ODataType odataUNDEF = 0;
const ODataType odataNO_DIMENSION = 1;
const ODataType odataLENGTH = 2;
const ODataType odataMASS = 3;
const ODataType odataTIME = 4;
const ODataType odataDATE = 5;
const ODataType odataANGULAR = 6;
const ODataType odataVELOCITY = 7;
const ODataType odataFORCE = 8;
const ODataType odataACCELERATION = 9;
const ODataType odataANGULAR_VELOCITY = 10;
const ODataType odataTEMPERATURE = 11;
const ODataType odataPRESSURE = 12;
const ODataType odataPERCENTAGE = 13;
const ODataType odataSWITCH = 14;
const ODataType odataLED = 15;
const ODataType odataSOUND = 16;
const ODataType odataIMAGE = 17;
const ODataType odataJOINT_VALUE = 18;
const ODataType odataFBK_YCrCb = 19;
const ODataType odataFBK_CDT = 20;
const ODataType odataCDT = 21;
const ODataType odataPRIMITIVE_INFO = 22;
const ODataType odataCPC_INFO = 23;
const ODataType odataFBK_YCrCb_HPF = 24;
const ODataType odataJOINT_COMMAND = 256;
const ODataType odataCAMERA_COMMAND = 257;
const ODataType odataLED_COMMAND = 258;
const ODataType odataJOINT_COMMAND2 = 259;
const ODataType odataLED_COMMAND2 = 260;
const ODataType odataJOINT_COMMAND3 = 261;
const ODataType odataJOINT_COMMAND4 = 262;
const ODataType odataLED_COMMAND3 = 263;
const ODataType odataRAW_JOINT_COMMAND = 512;
const ODataType odataRAW_CAMERA_COMMAND = 513;
const ODataType odataRAW_LED_COMMAND = 514;
const ODataType odataRAW_JOINT_COMMAND2 = 515;
const ODataType odataCOMMAND_VECTOR = 1024;
const ODataType odataSENSOR_FRAME_VECTOR = 1025;
const ODataType odataSOUND_VECTOR = 1026;
const ODataType odataFBKIMAGE_VECTOR = 1027;
const ODataType odataCDT_VECTOR = 1028;
const ODataType odataPRIMITIVE_MAP = 1029;
const ODataType odataCPC_TREE = 1030;
const ODataType odataDONT_CARE = 0xffffffff;

typedef longword OSwitchValue;
const OSwitchValue oswitchOFF = 0;
const OSwitchValue oswitchON = 1;

typedef longword OLEDValue;
const OLEDValue oledOFF = 0;
const OLEDValue oledON = 1;

typedef word OLED3Mode;
const OLED3Mode oled3_MODE_UNDEF = 0xffff;
const OLED3Mode oled3_MODE_A = 0;
const OLED3Mode oled3_MODE_B = 1;

typedef longword OJointValue3;
const OJointValue3 ojoint3_STATE_UNDEF = 0xffffffff;
const OJointValue3 ojoint3_STATE0 = 0;
const OJointValue3 ojoint3_STATE1 = 1;

typedef longword OJointValue4;
const OJointValue4 ojoint4_STATE_UNDEF = 0xffffffff;
const OJointValue4 ojoint4_STATE0 = 0;
const OJointValue4 ojoint4_STATE1 = 1;

typedef longword OCameraRequest;
const OCameraRequest ocamreqAE_OFF = 0;
const OCameraRequest ocamreqAE_ON = 1;
const OCameraRequest ocamreqSET_AWB_MODE = 2;
const OCameraRequest ocamreqDRAW_BOX = 3;

const byte ocamparamAWB_AUTO_MODE = 0;
const byte ocamparamAWB_INDOOR_MODE = 1;
const byte ocamparamAWB_OUTDOOR_MODE = 2;
const byte ocamparamAWB_USER_MODE = 3;
const byte ocamparamAWB_FL_MODE = 4;
const byte ocamparamBOX1 = 1;
const byte ocamparamBOX2 = 2;

const size_t odataOPTIONAL_MAX = 128;
const size_t ocommandMAX_FRAMES = 16;
const size_t osensorframeMAX_FRAMES = 16;

const word osensorframeINVALID_SIGNAL = 0xffff;
const slongword opsdINVALID_VALUE = 0;

typedef word OSoundFormat;
const OSoundFormat osoundformatUNDEF = 0;
const OSoundFormat osoundformatPCM = 1;
const OSoundFormat osoundformatUSB_MIDI = 2;
const OSoundFormat osoundformatSMF = 3;

typedef word OSoundChannel;
const OSoundChannel osoundchannelUNDEF = 0;
const OSoundChannel osoundchannelMONO = 1;
const OSoundChannel osoundchannelSTEREO = 2;

typedef int OFbkImageLayer;
const OFbkImageLayer ofbkimageLAYER_H = 0;
const OFbkImageLayer ofbkimageLAYER_M = 1;
const OFbkImageLayer ofbkimageLAYER_L = 2;
const OFbkImageLayer ofbkimageLAYER_C = 3;

const int ocdtNUM_CHANNELS = 8;
const int ocdtMAX_Y_SEGMENT = 32;

typedef longword OCdtChannel;
const OCdtChannel ocdtCHANNEL_UNDEF = 0x00;
const OCdtChannel ocdtCHANNEL0 = 0x01;
const OCdtChannel ocdtCHANNEL1 = 0x02;
const OCdtChannel ocdtCHANNEL2 = 0x04;
const OCdtChannel ocdtCHANNEL3 = 0x08;
const OCdtChannel ocdtCHANNEL4 = 0x10;
const OCdtChannel ocdtCHANNEL5 = 0x20;
const OCdtChannel ocdtCHANNEL6 = 0x40;
const OCdtChannel ocdtCHANNEL7 = 0x80;

const longword ocdtINIT = 0x80808080;
const longword ocdtCr_MAX_MASK = 0x0000ff00;
const longword ocdtCr_MIN_MASK = 0x000000ff;
const longword ocdtCb_MAX_MASK = 0xff000000;
const longword ocdtCb_MIN_MASK = 0x00ff0000;

/// The head of every vector, 192 bytes.
struct ODataVectorInfo {
  MemoryRegionID memRegionID;
  longword physAddr;
  longword offset;     ///< of this vector in its region
  longword totalSize;  ///< [bytes]
  ODataType type;
  longword infoOffset;  ///< from here to the first info
  longword infoSize;
  longword maxNumData;
  longword numData;
  OVRSyncKey syncKey;
  longword wait;  ///< [frames of 8 ms]
  longword optOffset;
  longword optSize;
  longword padding[3];
  byte optional[odataOPTIONAL_MAX];
};

struct OCommandValue {
  slongword value[2];
};

struct OJointCommandValue2 {
  slongword value;  ///< [µrad]
  slongword padding;
};

struct OJointCommandValue3 {
  OJointValue3 value;
  word reserved;
  word padding;
};

struct OJointCommandValue4 {
  OJointValue4 value;
  word period;  ///< [frames of 8 ms]
  word reserved;
};

struct OLEDCommandValue2 {
  OLEDValue led;
  word period;
  word reserved;
};

struct OLEDCommandValue3 {
  sword intensity;  ///< 0 to 255
  OLED3Mode mode;
  word period;
  word reserved;
};

struct OCommandInfo {
  ODataType type;
  OPrimitiveID primitiveID;
  longword frameNumber;
  longword numFrames;
  longword frameSize;
  longword dataOffset;  ///< from the vector's begin
  longword dataSize;
  longword padding[1];

  void Set(ODataType t, OPrimitiveID id, size_t nframes) {
    type = t;
    primitiveID = id;
    numFrames = static_cast<longword>(nframes);
  }
};

struct OCommandData {
  OCommandValue value[ocommandMAX_FRAMES];
};

struct OCommandVectorData {
  ODataVectorInfo vectorInfo;
  OCommandInfo info[1];

  void SetNumData(size_t ndata) { vectorInfo.numData = static_cast<longword>(ndata); }
  OCommandInfo* GetInfo(int index) { return reinterpret_cast<OCommandInfo*>(infoBytes()) + index; }
  OCommandData* GetData(int index) {
    return reinterpret_cast<OCommandData*>(reinterpret_cast<byte*>(this) + GetInfo(index)->dataOffset);
  }

 private:
  byte* infoBytes() { return reinterpret_cast<byte*>(this) + sizeof(ODataVectorInfo); }
};

struct OSensorValue {
  slongword value;
  word signal;
  word padding[5];
};

struct OJointValue {
  slongword value;  ///< [µrad]
  word signal;
  sword pwmDuty;
  slongword refValue;
  word refSignal;
  word padding[1];

  OJointValue() : value(0), signal(0), pwmDuty(0), refValue(0), refSignal(0) {}
  OJointValue(slongword val, word sig, sword pwm, slongword rv, word rs)
      : value(val), signal(sig), pwmDuty(pwm), refValue(rv), refSignal(rs) {}
};

struct OSwitchStatus {
  OSwitchValue value;
  word signal;
  word padding[5];
};

struct OSensorFrameInfo {
  ODataType type;
  OPrimitiveID primitiveID;
  longword frameNumber;
  longword numFrames;
  longword frameSize;
  longword dataOffset;
  longword dataSize;
  longword padding[1];

  void Set(ODataType t, OPrimitiveID id, size_t nframes) {
    type = t;
    primitiveID = id;
    numFrames = static_cast<longword>(nframes);
  }
};

struct OSensorFrameData {
  OSensorValue frame[osensorframeMAX_FRAMES];
};

struct OSensorFrameVectorData {
  ODataVectorInfo vectorInfo;
  OSensorFrameInfo info[1];

  void SetNumData(size_t ndata) { vectorInfo.numData = static_cast<longword>(ndata); }
  OSensorFrameInfo* GetInfo(int index) { return reinterpret_cast<OSensorFrameInfo*>(infoBytes()) + index; }
  OSensorFrameData* GetData(int index) {
    return reinterpret_cast<OSensorFrameData*>(reinterpret_cast<byte*>(this) + GetInfo(index)->dataOffset);
  }

 private:
  byte* infoBytes() { return reinterpret_cast<byte*>(this) + sizeof(ODataVectorInfo); }
};

struct OSoundInfo {
  ODataType type;
  OPrimitiveID primitiveID;
  longword frameNumber;
  longword frameSize;
  longword dataOffset;
  longword maxDataSize;
  longword dataSize;
  OSoundFormat format;
  OSoundChannel channel;
  word samplingRate;
  word bitsPerSample;
  longword actualDataSize;
  longword padding[6];

  void Set(ODataType t, OPrimitiveID id, size_t dsize) {
    type = t;
    primitiveID = id;
    dataSize = static_cast<longword>(dsize);
  }
};

struct OSoundVectorData {
  ODataVectorInfo vectorInfo;
  OSoundInfo info[1];

  void SetNumData(size_t ndata) { vectorInfo.numData = static_cast<longword>(ndata); }
  OSoundInfo* GetInfo(int index) { return reinterpret_cast<OSoundInfo*>(infoBytes()) + index; }
  byte* GetData(int index) { return reinterpret_cast<byte*>(this) + GetInfo(index)->dataOffset; }

 private:
  byte* infoBytes() { return reinterpret_cast<byte*>(this) + sizeof(ODataVectorInfo); }
};

struct OFbkImageInfo {
  ODataType type;
  OPrimitiveID primitiveID;
  longword frameNumber;
  longword dataOffset;
  longword dataSize;
  longword width;
  longword height;
  longword padding[1];
};

struct OFbkImageVectorData {
  ODataVectorInfo vectorInfo;
  OFbkImageInfo info[1];

  void SetPrimitiveID(OPrimitiveID primitiveID) {
    for (int i = 0; i < static_cast<int>(vectorInfo.numData); ++i) GetInfo(i)->primitiveID = primitiveID;
  }
  OFbkImageInfo* GetInfo(int index) { return reinterpret_cast<OFbkImageInfo*>(infoBytes()) + index; }
  byte* GetData(int index) { return reinterpret_cast<byte*>(this) + GetInfo(index)->dataOffset; }

 private:
  byte* infoBytes() { return reinterpret_cast<byte*>(this) + sizeof(ODataVectorInfo); }
};

/// A box of colours for each of 32 segments of brightness.
struct OCdtInfo {
  ODataType type;
  OPrimitiveID primitiveID;
  OCdtChannel channel;
  longword table[ocdtMAX_Y_SEGMENT];
  longword padding;

  void Init(OPrimitiveID prmID, OCdtChannel chan) {
    type = odataCDT;
    primitiveID = prmID;
    channel = chan;
    for (int i = 0; i < ocdtMAX_Y_SEGMENT; ++i) table[i] = ocdtINIT;
  }
  void Set(int y_segment, byte cr_max, byte cr_min, byte cb_max, byte cb_min) {
    if (y_segment < 0 || y_segment >= ocdtMAX_Y_SEGMENT) return;
    table[y_segment] = (static_cast<longword>(cb_max) << 24) | (static_cast<longword>(cb_min) << 16) |
                       (static_cast<longword>(cr_max) << 8) | static_cast<longword>(cr_min);
  }
};

struct OCdtVectorData {
  ODataVectorInfo vectorInfo;
  OCdtInfo info[ocdtNUM_CHANNELS];

  void SetNumData(size_t ndata) { vectorInfo.numData = static_cast<longword>(ndata); }
  OCdtInfo* GetInfo(int index) { return &info[index]; }
};

struct OPrimitiveInfo {
  ODataType type;
  OPrimitiveID primitiveID;
  OPrimitiveType primitiveType;
  OSensorType sensorType;
  OStatus primitiveStatus;
  longword padding[3];
  char locator[ovrPATH_MAX + 1];
};

#endif
