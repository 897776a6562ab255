// Every constant with its value, every member and every call that programs of OPEN-R can name. It need only compile.
#include "Names.h"

#include <DNSEndpointMsg.h>
#include <MCOOP.h>
#include <OPENR/OCalendarTime.h>
#include <OPENR/OFbkImage.h>
#include <OPENR/OList.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OPrimitiveControl.h>
#include <OPENR/OShmPtr.h>
#include <OPENR/OSyslog.h>
#include <OPENR/OTime.h>
#include <OPENR/OUnits.h>
#include <OPENR/core_macro.h>
#include <OPENR/stub_macro.h>
#include <ObjectEntryTable.h>
#include <SystemTime.h>
#include <TCPEndpointMsg.h>
#include <UDPEndpointMsg.h>
#include <ant.h>
#include <apsys.h>
#include <iostream.h>

#define JOIN2(a, b) a##b
#define JOIN(a, b) JOIN2(a, b)
#define CHECK(name, value) typedef char JOIN(check, __LINE__)[(name) == (value) ? 1 : -1]
#define MEMBER(type, name) (void)sizeof(((type*)0)->name)

CHECK(oSUCCESS, 0);
CHECK(oUNDEF, 1);
CHECK(oFAIL, 2);
CHECK(oNOT_SUPPORTED, 3);
CHECK(oINVALID_ARG, 4);
CHECK(oNO_MEMORY, 5);
CHECK(oNOT_FOUND, 6);
CHECK(oALREADY_EXIST, 7);
CHECK(oOPEN_FAILURE, 8);
CHECK(oCLOSE_FAILURE, 9);
CHECK(oFULL_OF_QUEUE, 10);
CHECK(oITEM_NOT_FOUND, 11);
CHECK(oWRONG_MESSAGE, 12);
CHECK(oSEND_FAIL, 13);
CHECK(oSEND_WITH_RBOX_FAIL, 14);
CHECK(oCALL_FAIL, 15);
CHECK(oREPLY_FAIL, 16);
CHECK(oRECEIVE_FAIL, 17);
CHECK(oNOT_INITIALIZED, 18);
CHECK(oREFUSED, 19);
CHECK(oSIZE_TOO_LARGE, 20);
CHECK(oNOT_AVAILABLE, 21);
CHECK(oUNKNOWN_DATA, 22);
CHECK(oUNKNOWN_COMMAND, 23);
CHECK(oOUT_OF_RANGE, 24);
CHECK(oOVERFLOW, 25);
CHECK(oUNDERFLOW, 26);
CHECK(oINVALID_OID, 27);
CHECK(oFATAL, 28);
CHECK(oOBJ_NOT_FOUND, 29);
CHECK(oSYNTAX_ERROR, 30);
CHECK(oNO_ROBOT_DESIGN, 31);
CHECK(oCHECK_SUM_ERROR, 32);
CHECK(oBUSY, 33);
CHECK(oINVALID_PRIMITIVE_ID, 4096 + 0);
CHECK(oINVALID_DATA_VECTOR_ID, 4096 + 1);
CHECK(oINVALID_DATA_TYPE, 4096 + 2);
CHECK(oINVALID_DATA, 4096 + 3);
CHECK(oINVALID_REQUEST, 4096 + 4);
CHECK(oALREADY_REGISTERED, 4096 + 5);
CHECK(oNOT_REGISTERED, 4096 + 6);
CHECK(oEXCEEDED_PARAM_SIZE, 4096 + 7);
CHECK(oINVALID_ASYNC_REQ_ID, 4096 + 8);
CHECK(oFULL_OF_ASYNC_QUEUE, 4096 + 9);
CHECK(oNO_SYNC_KEY, 4096 + 10);
CHECK(oINVALID_SYNC_KEY, 4096 + 11);
CHECK(oGAIN_DISABLED, 4096 + 12);
CHECK(oTOO_MANY_ODA, 4096 + 13);
CHECK(oDESIGNDATA_SIZE_ZERO, 4096 + 14);
CHECK(oCPC_PLUG_OUT, 4096 + 15);
CHECK(oMS_NOT_WRITABLE, 4096 + 16);
CHECK(oALERT_JOINT_UNCONTROLLABLE, 8192 + 0);
CHECK(oentryINIT, 0);
CHECK(oentrySTART, 1);
CHECK(oentrySTOP, 2);
CHECK(oentryDESTROY, 3);
CHECK(oentryBASE, 4);
CHECK(oreasonUNDEF, 0xffffffff);
CHECK(oreasonBOOT, 0);
CHECK(oreasonSHUTDOWN, 1);
CHECK(omemorystickUNDEF, 0xffffffff);
CHECK(omemorystickNOT_EXIST, 0);
CHECK(omemorystickWRITE_PROTECTED, 1);
CHECK(omemorystickWRITABLE, 2);
CHECK(oreasonPARAM_MAX_SIZE, 128);
CHECK(oserviceNAME_MAX, 127);
CHECK(oobjectNAME_MAX, 63);
CHECK(ovrNAME_MAX, 31);
CHECK(ovrPATH_MAX, 127);
CHECK(orobotdesignNAME_MAX, 31);
CHECK(odesignkeywordNAME_MAX, 127);
CHECK(oframeMAX_NUMBER, 0x0ffffff0);
CHECK(oframeINVALID_NUMBER, 0xffffffff);
CHECK(oprimitiveID_UNDEF, 0xffffffff);
CHECK(oprimitiveUNDEF, 0);
CHECK(oprimitiveCOORDINATE, 1);
CHECK(oprimitiveRECEPTOR, 2);
CHECK(oprimitivePLUG, 3);
CHECK(oprimitiveLINK, 4);
CHECK(oprimitiveJOINT, 5);
CHECK(oprimitiveSENSOR, 6);
CHECK(oprimitiveSPEAKER, 7);
CHECK(oprimitiveMIC, 8);
CHECK(oprimitiveFBKIMAGESENSOR, 9);
CHECK(oprimitiveLED, 10);
CHECK(oprimitiveJOINT2, 11);
CHECK(oprimitiveLED2, 12);
CHECK(oprimitiveJOINT3, 13);
CHECK(oprimitiveJOINT4, 14);
CHECK(oprimitiveBLUETOOTH, 15);
CHECK(oprimitiveLED3, 16);
CHECK(osensorUNDEF, 0);
CHECK(osensorSWITCH, 1);
CHECK(osensorACCELEROMETER, 2);
CHECK(osensorGYROMETER, 3);
CHECK(osensorTACTILE_SENSOR, 4);
CHECK(osensorTHERMOMETER, 5);
CHECK(osensorPSD, 6);
CHECK(osensorROTARY_SENSOR, 7);
CHECK(osensorBT_SWITCH, 8);
CHECK(osensorRAW_SENSOR, 9);
CHECK(osensorTM_SENSOR, 10);
CHECK(oasyncReqID_MAX_SIZE, 32);
CHECK(ovrsynckeyMAX_SIZE, 8);
CHECK(ovrsynckeyMAX_NUM_KEY, 8);
CHECK(ovrsynckeyMAX_NUM_DIVISION, 16);
CHECK(ovrctrlPARAM_MAX_SIZE, 192);
CHECK(ovrctrlDEVICE_MAX, 32);
CHECK(oprmctrlPARAM_MAX_SIZE, ovrctrlPARAM_MAX_SIZE - 16);
CHECK(ovrsynckeyUNDEF, 0xffffffff);
CHECK(opowerON, true);
CHECK(opowerOFF, false);
CHECK(orsbPAUSE, 0x00000001);
CHECK(orsbMOTOR_POWER, 0x00000002);
CHECK(orsbVIBRATION_DETECT, 0x00000004);
CHECK(orsbEX_PORT_CONNECTED, 0x00000008);
CHECK(orsbSTATION_CONNECTED, 0x00000010);
CHECK(orsbEX_POWER_CONNECTED, 0x00000020);
CHECK(orsbBATTERY_CONNECTED, 0x00000040);
CHECK(orsbBATTERY_CHARGING, 0x00000080);
CHECK(orsbBATTERY_CAPACITY_FULL, 0x00000100);
CHECK(orsbBATTERY_CAPACITY_LOW, 0x00000200);
CHECK(orsbBATTERY_OVER_CURRENT, 0x00000400);
CHECK(orsbBATTERY_OVER_TEMP_DISCHARGING, 0x00000800);
CHECK(orsbBATTERY_OVER_TEMP_CHARGING, 0x00001000);
CHECK(orsbBATTERY_ERROR_OF_CHARGING, 0x00002000);
CHECK(orsbERROR_OF_PLUNGER, 0x00004000);
CHECK(orsbOPEN_R_POWER_GOOD, 0x00008000);
CHECK(orsbERROR_OF_FAN, 0x00010000);
CHECK(orsbDATA_STREAM_FROM_STATION, 0x00020000);
CHECK(orsbREGISTER_UPDATED_BY_STATION, 0x00040000);
CHECK(orsbRTC_ERROR, 0x00080000);
CHECK(orsbRTC_OVERFLOW, 0x00100000);
CHECK(orsbRTC_RESET, 0x00200000);
CHECK(orsbRTC_SET, 0x00400000);
CHECK(orsbSPECIAL_MODE, 0x00800000);
CHECK(orsbBMN_DEBUG_MODE, 0x01000000);
CHECK(orsbCHARGER_STATUS, 0x02000000);
CHECK(orsbPLUNGER, 0x04000000);
CHECK(orsbSUSPENDED, 0x08000000);
CHECK(orsbSPECIAL_DATA_READ_REQ, 0x10000000);
CHECK(orsbALL, 0x1FFFFFFF);
CHECK(obcbttRELATIVE, 0x00000000);
CHECK(obcbttABSOLUTE, 0x80000000);
CHECK(obcbBOOT_TIMER, 0x0001);
CHECK(obcbVIBRATION_DETECTED, 0x0002);
CHECK(obcbPAUSE_SW, 0x0004);
CHECK(obcbSTATION_CONNECTED, 0x0008);
CHECK(obcbSTATION_DISCONNECTED, 0x0010);
CHECK(obcbBATTERY_CAPACITY_FULL, 0x0020);
CHECK(obcbREQ_FROM_STATION, 0x0040);
CHECK(obcbALL, 0x007F);
CHECK(obsbERROR_CODE_MASK, 0x000F);
CHECK(obsbFULLY_DISCHARGED, 0x0010);
CHECK(obsbFULLY_CHARGED, 0x0020);
CHECK(obsbDISCHARGING, 0x0040);
CHECK(obsbINITIALIZED, 0x0080);
CHECK(obsbREMAINING_TIME_ALARM, 0x0100);
CHECK(obsbREMAINING_CAPACITY_ALARM, 0x0200);
CHECK(obsbRESERVED0, 0x0400);
CHECK(obsbTERMINATED_DISCHARGING_ALARM, 0x0800);
CHECK(obsbOVER_TEMP_ALARM, 0x1000);
CHECK(obsbRESERVED1, 0x2000);
CHECK(obsbTERMINATED_CHARGING_ALARM, 0x4000);
CHECK(obsbOVER_CHARGED_ALARM, 0x8000);
CHECK(obsbALL, 0xFFFF);
CHECK(opsoREMAINING_CAPACITY_NOTIFY_EVERY_CHANGE, 0xFFFF);
CHECK(opsoREMAINING_CAPACITY_NOT_NOTIFY, 0xFFFE);
CHECK(opsoTEMPERATURE_NOTIFY_EVERY_CHANGE, 0xFFFF);
CHECK(opsoTEMPERATURE_NOT_NOTIFY, 0xFFFE);
CHECK(opsoVOLUME_NOTIFY_EVERY_CHANGE, 0xFF);
CHECK(opsoVOLUME_NOT_NOTIFY, 0xFE);
CHECK(opsoTIME_DIF_NOTIFY_EVERY_CHANGE, 0x7F);
CHECK(opsoTIME_DIF_NOT_NOTIFY, 0x7E);
CHECK(odataUNDEF, 0);
CHECK(odataNO_DIMENSION, 1);
CHECK(odataLENGTH, 2);
CHECK(odataMASS, 3);
CHECK(odataTIME, 4);
CHECK(odataDATE, 5);
CHECK(odataANGULAR, 6);
CHECK(odataVELOCITY, 7);
CHECK(odataFORCE, 8);
CHECK(odataACCELERATION, 9);
CHECK(odataANGULAR_VELOCITY, 10);
CHECK(odataTEMPERATURE, 11);
CHECK(odataPRESSURE, 12);
CHECK(odataPERCENTAGE, 13);
CHECK(odataSWITCH, 14);
CHECK(odataLED, 15);
CHECK(odataSOUND, 16);
CHECK(odataIMAGE, 17);
CHECK(odataJOINT_VALUE, 18);
CHECK(odataFBK_YCrCb, 19);
CHECK(odataFBK_CDT, 20);
CHECK(odataCDT, 21);
CHECK(odataPRIMITIVE_INFO, 22);
CHECK(odataCPC_INFO, 23);
CHECK(odataFBK_YCrCb_HPF, 24);
CHECK(odataJOINT_COMMAND, 256);
CHECK(odataCAMERA_COMMAND, 257);
CHECK(odataLED_COMMAND, 258);
CHECK(odataJOINT_COMMAND2, 259);
CHECK(odataLED_COMMAND2, 260);
CHECK(odataJOINT_COMMAND3, 261);
CHECK(odataJOINT_COMMAND4, 262);
CHECK(odataLED_COMMAND3, 263);
CHECK(odataRAW_JOINT_COMMAND, 512);
CHECK(odataRAW_CAMERA_COMMAND, 513);
CHECK(odataRAW_LED_COMMAND, 514);
CHECK(odataRAW_JOINT_COMMAND2, 515);
CHECK(odataCOMMAND_VECTOR, 1024);
CHECK(odataSENSOR_FRAME_VECTOR, 1025);
CHECK(odataSOUND_VECTOR, 1026);
CHECK(odataFBKIMAGE_VECTOR, 1027);
CHECK(odataCDT_VECTOR, 1028);
CHECK(odataPRIMITIVE_MAP, 1029);
CHECK(odataCPC_TREE, 1030);
CHECK(odataDONT_CARE, 0xffffffff);
CHECK(oswitchOFF, 0);
CHECK(oswitchON, 1);
CHECK(oledOFF, 0);
CHECK(oledON, 1);
CHECK(oled3_MODE_UNDEF, 0xffff);
CHECK(oled3_MODE_A, 0);
CHECK(oled3_MODE_B, 1);
CHECK(ojoint3_STATE_UNDEF, 0xffffffff);
CHECK(ojoint3_STATE0, 0);
CHECK(ojoint3_STATE1, 1);
CHECK(ojoint4_STATE_UNDEF, 0xffffffff);
CHECK(ojoint4_STATE0, 0);
CHECK(ojoint4_STATE1, 1);
CHECK(ocamreqAE_OFF, 0);
CHECK(ocamreqAE_ON, 1);
CHECK(ocamreqSET_AWB_MODE, 2);
CHECK(ocamreqDRAW_BOX, 3);
CHECK(ocamparamAWB_AUTO_MODE, 0);
CHECK(ocamparamAWB_INDOOR_MODE, 1);
CHECK(ocamparamAWB_OUTDOOR_MODE, 2);
CHECK(ocamparamAWB_USER_MODE, 3);
CHECK(ocamparamAWB_FL_MODE, 4);
CHECK(ocamparamBOX1, 1);
CHECK(ocamparamBOX2, 2);
CHECK(odataOPTIONAL_MAX, 128);
CHECK(ocommandMAX_FRAMES, 16);
CHECK(osensorframeMAX_FRAMES, 16);
CHECK(osensorframeINVALID_SIGNAL, 0xffff);
CHECK(opsdINVALID_VALUE, 0);
CHECK(osoundformatUNDEF, 0);
CHECK(osoundformatPCM, 1);
CHECK(osoundformatUSB_MIDI, 2);
CHECK(osoundformatSMF, 3);
CHECK(osoundchannelUNDEF, 0);
CHECK(osoundchannelMONO, 1);
CHECK(osoundchannelSTEREO, 2);
CHECK(ofbkimageLAYER_H, 0);
CHECK(ofbkimageLAYER_M, 1);
CHECK(ofbkimageLAYER_L, 2);
CHECK(ofbkimageLAYER_C, 3);
CHECK(ocdtNUM_CHANNELS, 8);
CHECK(ocdtMAX_Y_SEGMENT, 32);
CHECK(ocdtCHANNEL_UNDEF, 0x00);
CHECK(ocdtCHANNEL0, 0x01);
CHECK(ocdtCHANNEL1, 0x02);
CHECK(ocdtCHANNEL2, 0x04);
CHECK(ocdtCHANNEL3, 0x08);
CHECK(ocdtCHANNEL4, 0x10);
CHECK(ocdtCHANNEL5, 0x20);
CHECK(ocdtCHANNEL6, 0x40);
CHECK(ocdtCHANNEL7, 0x80);
CHECK(ocdtINIT, 0x80808080);
CHECK(ocdtCr_MAX_MASK, 0x0000ff00);
CHECK(ocdtCr_MIN_MASK, 0x000000ff);
CHECK(ocdtCb_MAX_MASK, 0xff000000);
CHECK(ocdtCb_MIN_MASK, 0x00ff0000);
CHECK(ofbkimageBAND_Y, 0);
CHECK(ofbkimageBAND_Cr, 1);
CHECK(ofbkimageBAND_Cb, 2);
CHECK(ofbkimageBAND_CDT, 3);
CHECK(ofbkimageBAND_Y_LH, 4);
CHECK(ofbkimageBAND_Y_HL, 5);
CHECK(ofbkimageBAND_Y_HH, 6);
CHECK(oprmreqCOMMON_BASE, 0);
CHECK(oprmreqSPEAKER_BASE, 128);
CHECK(oprmreqMIC_BASE, 256);
CHECK(oprmreqCAM_BASE, 384);
CHECK(oprmreqBT_BASE, 512);
CHECK(oprmreqJOINT2_BASE, 640);
CHECK(oprmreqLED2_BASE, 768);
CHECK(oprmreqSENSOR_BASE, 896);
CHECK(oprmreqLED3_BASE, 1024);
CHECK(oprmreqJOINT4_BASE, 1152);
CHECK(oprmreqPRIVATE_BASE, 1048576);
CHECK(oprmreqSPEAKER_MUTE_ON, oprmreqSPEAKER_BASE + 0);
CHECK(oprmreqSPEAKER_MUTE_OFF, oprmreqSPEAKER_BASE + 1);
CHECK(oprmreqSPEAKER_SET_VOLUME, oprmreqSPEAKER_BASE + 2);
CHECK(oprmreqSPEAKER_SET_SOUND_TYPE, oprmreqSPEAKER_BASE + 3);
CHECK(oprmreqSPEAKER_GET_SOUND_TYPE, oprmreqSPEAKER_BASE + 4);
CHECK(oprmreqSPEAKER_SET_VOLUME_MIDI, oprmreqSPEAKER_BASE + 5);
CHECK(oprmreqSPEAKER_MASTER_TUNING_MIDI, oprmreqSPEAKER_BASE + 6);
CHECK(oprmreqMIC_UNI, oprmreqMIC_BASE + 0);
CHECK(oprmreqMIC_OMNI, oprmreqMIC_BASE + 1);
CHECK(oprmreqMIC_ALC_ON, oprmreqMIC_BASE + 2);
CHECK(oprmreqMIC_ALC_OFF, oprmreqMIC_BASE + 3);
CHECK(oprmreqCAM_SET_WHITE_BALANCE, oprmreqCAM_BASE + 0);
CHECK(oprmreqCAM_SET_GAIN, oprmreqCAM_BASE + 1);
CHECK(oprmreqCAM_SET_SHUTTER_SPEED, oprmreqCAM_BASE + 2);
CHECK(oprmreqCAM_GET_CDT_TABLE, oprmreqCAM_BASE + 3);
CHECK(oprmreqCAM_AE_ON, oprmreqCAM_BASE + 4);
CHECK(oprmreqCAM_AE_OFF, oprmreqCAM_BASE + 5);
CHECK(oprmreqCAM_AWB_ON, oprmreqCAM_BASE + 6);
CHECK(oprmreqCAM_AWB_OFF, oprmreqCAM_BASE + 7);
CHECK(oprmreqBT_ATTACH, oprmreqBT_BASE + 0);
CHECK(oprmreqBT_DETACH, oprmreqBT_BASE + 1);
CHECK(oprmreqJOINT2_SET_COMMAND, oprmreqJOINT2_BASE + 0);
CHECK(oprmreqJOINT2_GET_VALUE, oprmreqJOINT2_BASE + 1);
CHECK(oprmreqLED2_SET_COMMAND, oprmreqLED2_BASE + 0);
CHECK(oprmreqSENSOR_WATCH_BT_SWITCH, oprmreqSENSOR_BASE + 0);
CHECK(oprmreqLED3_SET_COMMAND, oprmreqLED3_BASE + 0);
CHECK(oprmreqJOINT4_SET_COMMAND, oprmreqJOINT4_BASE + 0);
CHECK(ospksndMONO8K8B, 0);
CHECK(ospksndMONO11K8B, 1);
CHECK(ospksndMONO16K8B, 2);
CHECK(ospksndMONO16K16B, 3);
CHECK(ospksndSTEREO16K16B, 4);
CHECK(ospkvolinfdB, 0x8000);
CHECK(ospkvol25dB, 0xe700);
CHECK(ospkvol18dB, 0xee00);
CHECK(ospkvol10dB, 0xf600);
CHECK(ocamparamUNDEF, 0);
CHECK(ocamparamWB_INDOOR_MODE, 1);
CHECK(ocamparamWB_OUTDOOR_MODE, 2);
CHECK(ocamparamWB_FL_MODE, 3);
CHECK(ocamparamGAIN_LOW, 1);
CHECK(ocamparamGAIN_MID, 2);
CHECK(ocamparamGAIN_HIGH, 3);
CHECK(ocamparamSHUTTER_SLOW, 1);
CHECK(ocamparamSHUTTER_MID, 2);
CHECK(ocamparamSHUTTER_FAST, 3);
CHECK(obtswitcheventUNDEF, 0);
CHECK(obtswitcheventVALUE_CHANGED, 1);
CHECK(EndpointType_TCP, 1);
CHECK(EndpointType_UDP, 2);
CHECK(EndpointType_TFTP, 3);
CHECK(EndpointType_DNS, 4);
CHECK(EndpointType_POP3, 5);
CHECK(EndpointType_SMTP, 6);
CHECK(EndpointType_IP, 7);
CHECK(EndpointType_MIBII, 8);
CHECK(EndpointType_MIB_ETHERNET, 9);
CHECK(TCP_SUCCESS, 0);
CHECK(TCP_FAIL, 1);
CHECK(TCP_CONNECTION_CLOSED, 2);
CHECK(TCP_CONNECTION_RESET, 3);
CHECK(TCP_CONNECTION_TIMEOUT, 4);
CHECK(TCP_CONNECTION_BUSY, 5);
CHECK(TCP_ADDRESSINUSE, 6);
CHECK(TCP_ADDRESSERROR, 7);
CHECK(TCP_PORT_UNREACHABLE, 8);
CHECK(TCP_PROTOCOL_UNREACHABLE, 9);
CHECK(TCP_HOST_UNREACHABLE, 10);
CHECK(TCP_NETWORK_UNREACHABLE, 11);
CHECK(TCP_MESSAGE_TOO_LONG, 12);
CHECK(TCP_TTL_EXCEEDED, 13);
CHECK(TCP_TIME_EXCEEDED, 14);
CHECK(TCP_WOULDBLOCK, 15);
CHECK(TCP_BUFFER_INVALID, 16);
CHECK(TCP_OPERATION_INVALID, 17);
CHECK(TCP_OPERATION_UNKNOWN, 18);
CHECK(TCPEndpoint_Operation_Bind, 1);
CHECK(TCPEndpoint_Operation_Listen, 2);
CHECK(TCPEndpoint_Operation_Connect, 3);
CHECK(TCPEndpoint_Operation_Send, 4);
CHECK(TCPEndpoint_Operation_Receive, 5);
CHECK(TCPEndpoint_Operation_Close, 6);
CHECK(TCPEndpoint_Operation_SetBlockingMode, 7);
CHECK(TCPEndpoint_Operation_ReadyForRead, 8);
CHECK(TCPEndpoint_Operation_ReadyForWrite, 9);
CHECK(TCPEndpoint_Operation_BacklogListen, 10);
CHECK(TCPEndpoint_Operation_Accept, 11);
CHECK(TCPEndpoint_Operation_BacklogQueues, 12);
CHECK(TCPEndpoint_Operation_Address, 13);
CHECK(UDP_SUCCESS, 0);
CHECK(UDP_FAIL, 1);
CHECK(UDP_CONNECTION_CLOSED, 2);
CHECK(UDP_CONNECTION_BUSY, 3);
CHECK(UDP_ADDRESSINUSE, 4);
CHECK(UDP_ADDRESSERROR, 5);
CHECK(UDP_PORT_UNREACHABLE, 6);
CHECK(UDP_PROTOCOL_UNREACHABLE, 7);
CHECK(UDP_HOST_UNREACHABLE, 8);
CHECK(UDP_NETWORK_UNREACHABLE, 9);
CHECK(UDP_MESSAGE_TOO_LONG, 10);
CHECK(UDP_TTL_EXCEEDED, 11);
CHECK(UDP_TIME_EXCEEDED, 12);
CHECK(UDP_BUFFER_INVALID, 13);
CHECK(UDP_OPERATION_INVALID, 14);
CHECK(UDP_OPERATION_UNKNOWN, 15);
CHECK(UDP_WOULDBLOCK, 16);
CHECK(UDPEndpoint_Operation_Bind, 0);
CHECK(UDPEndpoint_Operation_Connect, 1);
CHECK(UDPEndpoint_Operation_Send, 2);
CHECK(UDPEndpoint_Operation_Receive, 3);
CHECK(UDPEndpoint_Operation_Close, 4);
CHECK(UDPEndpoint_Operation_SetMulticastLoop, 5);
CHECK(UDPEndpoint_Operation_SetMulticastTTL, 6);
CHECK(UDPEndpoint_Operation_AddMembership, 7);
CHECK(UDPEndpoint_Operation_DropMembership, 8);
CHECK(UDPEndpoint_Operation_SetBlockingMode, 9);
CHECK(UDPEndpoint_Operation_ReadyForRead, 10);
CHECK(UDPEndpoint_Operation_ReadyForWrite, 11);
CHECK(UDPEndpoint_Operation_Address, 12);
CHECK(UDPEndpoint_Operation_ResetConnect, 13);
CHECK(Entry_antEnv_Initialize, 0);
CHECK(ANTENVMSG_SEND, 0);
CHECK(ANT_SUCCESS, 0);
CHECK(ANT_FAIL, 1);
CHECK(ANT_NOMEMORY, 2);
CHECK(ANT_INVALIDPTR, 3);
CHECK(ANT_NO_STATE_TRANSITION, 4);
CHECK(ANT_SDU_BADRANGE, 5);
CHECK(ANT_SDU_NOMORE_DATACELL, 6);
CHECK(ANT_SDU_NOOWNER, 7);
CHECK(ANT_SDUPOOL_ALLOCATED, 8);
CHECK(ANT_SDUPOOL_NOTASSIGNED, 9);
CHECK(ANT_QUEUE_EMPTY, 10);
CHECK(ANT_QUEUE_STATE, 11);
CHECK(ANT_QUEUE_CLOSED, 12);
CHECK(ANT_QUEUE_REJECTED, 13);
CHECK(ANT_QUEUE_BLOCKED, 14);
CHECK(ANT_INVALIDMODULEID, 15);
CHECK(ANT_TMR_TYPE_INVALID, 16);
CHECK(ANT_TMR_MAXNMBR_REACHED, 17);
CHECK(ANT_NOMESSAGES, 18);
CHECK(ANT_NAMING_ENTRY_EXISTS, 19);
CHECK(ANT_NAMING_NO_SUCH_NAME, 20);
CHECK(ANT_NAMING_NAME_INVALID, 21);
CHECK(ANT_REGISTRY_DUPLICATE_KEY, 22);
CHECK(ANT_REGISTRY_NO_KEY, 23);
CHECK(ANT_REGISTRY_WRONG_TYPE, 24);
CHECK(ANT_REGISTRY_INVALID_KEY, 25);
CHECK(ANT_REGISTRY_INVALID_VALUE, 26);
CHECK(ANT_ENDPOINT_NOFACTORY, 27);
CHECK(ANT_NOT_INITIALIZED, 28);
CHECK(ANT_INITIALIZING, 29);
CHECK(ANT_SDUMEMORY_AVAILABLE, (1 << 0));
CHECK(IP_PORT_ANY, 0);
CHECK(Entry_antEnv_HartBeat, Entry_antEnv_HartBeat);
CHECK(antEnv_numEntries, antEnv_numEntries);

// A value of any type, never looked at.
template <class T>
struct Made {
  static T* it;
};
template <class T>
struct Made<T&> {
  static T* it;
};
template <class T>
T* Made<T>::it = 0;
template <class T>
T* Made<T&>::it = 0;
#define make(T) (*Made<T>::it)

class Opened : public OObject {
 public:
  static void members();
};

void Opened::members() {
  MEMBER(OPowerStatus, robotStatus);
  MEMBER(OPowerStatus, batteryStatus);
  MEMBER(OPowerStatus, remainingCapacity);
  MEMBER(OPowerStatus, temperature);
  MEMBER(OPowerStatus, fullyChargedCapacity);
  MEMBER(OPowerStatus, voltage);
  MEMBER(OPowerStatus, current);
  MEMBER(OPowerStatus, timeDif);
  MEMBER(OPowerStatus, volume);
  MEMBER(OBootCondition, bitmap);
  MEMBER(OBootCondition, bootTime);
  MEMBER(OBootCondition, bootTimeType);
  MEMBER(OBootCondition, vibrationLevel);
  MEMBER(ODataVectorInfo, memRegionID);
  MEMBER(ODataVectorInfo, physAddr);
  MEMBER(ODataVectorInfo, offset);
  MEMBER(ODataVectorInfo, totalSize);
  MEMBER(ODataVectorInfo, type);
  MEMBER(ODataVectorInfo, infoOffset);
  MEMBER(ODataVectorInfo, infoSize);
  MEMBER(ODataVectorInfo, maxNumData);
  MEMBER(ODataVectorInfo, numData);
  MEMBER(ODataVectorInfo, syncKey);
  MEMBER(ODataVectorInfo, wait);
  MEMBER(ODataVectorInfo, optOffset);
  MEMBER(ODataVectorInfo, optSize);
  MEMBER(ODataVectorInfo, padding);
  MEMBER(ODataVectorInfo, optional);
  MEMBER(OCommandValue, value);
  MEMBER(OJointCommandValue2, value);
  MEMBER(OJointCommandValue2, padding);
  MEMBER(OJointCommandValue3, value);
  MEMBER(OJointCommandValue3, reserved);
  MEMBER(OJointCommandValue3, padding);
  MEMBER(OJointCommandValue4, value);
  MEMBER(OJointCommandValue4, period);
  MEMBER(OJointCommandValue4, reserved);
  MEMBER(OLEDCommandValue2, led);
  MEMBER(OLEDCommandValue2, period);
  MEMBER(OLEDCommandValue2, reserved);
  MEMBER(OLEDCommandValue3, intensity);
  MEMBER(OLEDCommandValue3, mode);
  MEMBER(OLEDCommandValue3, period);
  MEMBER(OLEDCommandValue3, reserved);
  MEMBER(OCommandInfo, type);
  MEMBER(OCommandInfo, primitiveID);
  MEMBER(OCommandInfo, frameNumber);
  MEMBER(OCommandInfo, numFrames);
  MEMBER(OCommandInfo, frameSize);
  MEMBER(OCommandInfo, dataOffset);
  MEMBER(OCommandInfo, dataSize);
  MEMBER(OCommandInfo, padding);
  MEMBER(OCommandData, value);
  MEMBER(OCommandVectorData, vectorInfo);
  MEMBER(OCommandVectorData, info);
  MEMBER(OSensorValue, value);
  MEMBER(OSensorValue, signal);
  MEMBER(OSensorValue, padding);
  MEMBER(OJointValue, value);
  MEMBER(OJointValue, signal);
  MEMBER(OJointValue, pwmDuty);
  MEMBER(OJointValue, refValue);
  MEMBER(OJointValue, refSignal);
  MEMBER(OJointValue, padding);
  MEMBER(OSwitchStatus, value);
  MEMBER(OSwitchStatus, signal);
  MEMBER(OSwitchStatus, padding);
  MEMBER(OSensorFrameInfo, type);
  MEMBER(OSensorFrameInfo, primitiveID);
  MEMBER(OSensorFrameInfo, frameNumber);
  MEMBER(OSensorFrameInfo, numFrames);
  MEMBER(OSensorFrameInfo, frameSize);
  MEMBER(OSensorFrameInfo, dataOffset);
  MEMBER(OSensorFrameInfo, dataSize);
  MEMBER(OSensorFrameInfo, padding);
  MEMBER(OSensorFrameData, frame);
  MEMBER(OSensorFrameVectorData, vectorInfo);
  MEMBER(OSensorFrameVectorData, info);
  MEMBER(OSoundInfo, type);
  MEMBER(OSoundInfo, primitiveID);
  MEMBER(OSoundInfo, frameNumber);
  MEMBER(OSoundInfo, frameSize);
  MEMBER(OSoundInfo, dataOffset);
  MEMBER(OSoundInfo, maxDataSize);
  MEMBER(OSoundInfo, dataSize);
  MEMBER(OSoundInfo, format);
  MEMBER(OSoundInfo, channel);
  MEMBER(OSoundInfo, samplingRate);
  MEMBER(OSoundInfo, bitsPerSample);
  MEMBER(OSoundInfo, actualDataSize);
  MEMBER(OSoundInfo, padding);
  MEMBER(OSoundVectorData, vectorInfo);
  MEMBER(OSoundVectorData, info);
  MEMBER(OFbkImageInfo, type);
  MEMBER(OFbkImageInfo, primitiveID);
  MEMBER(OFbkImageInfo, frameNumber);
  MEMBER(OFbkImageInfo, dataOffset);
  MEMBER(OFbkImageInfo, dataSize);
  MEMBER(OFbkImageInfo, width);
  MEMBER(OFbkImageInfo, height);
  MEMBER(OFbkImageInfo, padding);
  MEMBER(OFbkImageVectorData, vectorInfo);
  MEMBER(OFbkImageVectorData, info);
  MEMBER(OCdtInfo, type);
  MEMBER(OCdtInfo, primitiveID);
  MEMBER(OCdtInfo, channel);
  MEMBER(OCdtInfo, table);
  MEMBER(OCdtInfo, padding);
  MEMBER(OCdtVectorData, vectorInfo);
  MEMBER(OCdtVectorData, info);
  MEMBER(OPrimitiveInfo, type);
  MEMBER(OPrimitiveInfo, primitiveID);
  MEMBER(OPrimitiveInfo, primitiveType);
  MEMBER(OPrimitiveInfo, sensorType);
  MEMBER(OPrimitiveInfo, primitiveStatus);
  MEMBER(OPrimitiveInfo, padding);
  MEMBER(OPrimitiveInfo, locator);
  MEMBER(OPrimitiveControl_SpeakerVolume, volume);
  MEMBER(OPrimitiveControl_SpeakerSoundType, type);
  MEMBER(OPrimitiveControl_MasterTuningMIDI, value);
  MEMBER(OPrimitiveControl_CameraParam, camparam);
  MEMBER(OPrimitiveControl_Cdt, index);
  MEMBER(OPrimitiveControl_Cdt, table);
  MEMBER(OPrimitiveControl_JointCommandValue2, command);
  MEMBER(OPrimitiveControl_JointValue, jval);
  MEMBER(OPrimitiveControl_LEDCommandValue2, command);
  MEMBER(OPrimitiveControl_BtSwitchWatcherInfo, event);
  MEMBER(OPrimitiveControl_BtSwitchWatcherInfo, entry);
  MEMBER(OPrimitiveControl_BtSwitchEvent, event);
  MEMBER(OPrimitiveControl_BtSwitchEvent, value);
  MEMBER(OPrimitiveControl_LEDCommandValue3, command);
  MEMBER(OPrimitiveControl_JointCommandValue4, command);
  MEMBER(TCPEndpointBaseMsg, error);
  MEMBER(TCPEndpointBacklogQueueMsg, backlog);
  MEMBER(TCPEndpointBindMsg, lAddress);
  MEMBER(TCPEndpointBindMsg, lPort);
  MEMBER(TCPEndpointListenMsg, lAddress);
  MEMBER(TCPEndpointListenMsg, lPort);
  MEMBER(TCPEndpointListenMsg, fAddress);
  MEMBER(TCPEndpointListenMsg, fPort);
  MEMBER(TCPEndpointBacklogListenMsg, lAddress);
  MEMBER(TCPEndpointBacklogListenMsg, lPort);
  MEMBER(TCPEndpointBacklogListenMsg, fAddress);
  MEMBER(TCPEndpointBacklogListenMsg, fPort);
  MEMBER(TCPEndpointAcceptMsg, lAddress);
  MEMBER(TCPEndpointAcceptMsg, lPort);
  MEMBER(TCPEndpointAcceptMsg, fAddress);
  MEMBER(TCPEndpointAcceptMsg, fPort);
  MEMBER(TCPEndpointAcceptMsg, queueNr);
  MEMBER(TCPEndpointConnectMsg, lAddress);
  MEMBER(TCPEndpointConnectMsg, lPort);
  MEMBER(TCPEndpointConnectMsg, fAddress);
  MEMBER(TCPEndpointConnectMsg, fPort);
  MEMBER(TCPEndpointSendMsg, buffer);
  MEMBER(TCPEndpointSendMsg, size);
  MEMBER(TCPEndpointSendMsg, queueNr);
  MEMBER(TCPEndpointReceiveMsg, buffer);
  MEMBER(TCPEndpointReceiveMsg, sizeMin);
  MEMBER(TCPEndpointReceiveMsg, sizeMax);
  MEMBER(TCPEndpointReceiveMsg, queueNr);
  MEMBER(TCPEndpointCloseMsg, abort);
  MEMBER(TCPEndpointCloseMsg, linger);
  MEMBER(TCPEndpointCloseMsg, lingerTime);
  MEMBER(TCPEndpointCloseMsg, queueNr);
  MEMBER(TCPEndpointSetBlockingModeMsg, blocking);
  MEMBER(TCPEndpointSetBlockingModeMsg, queueNr);
  MEMBER(TCPEndpointReadyForReadMsg, ready);
  MEMBER(TCPEndpointReadyForReadMsg, queueNr);
  MEMBER(TCPEndpointReadyForWriteMsg, ready);
  MEMBER(TCPEndpointReadyForWriteMsg, queueNr);
  MEMBER(TCPEndpointAddressMsg, queueNr);
  MEMBER(TCPEndpointAddressMsg, lAddress);
  MEMBER(TCPEndpointAddressMsg, lPort);
  MEMBER(TCPEndpointAddressMsg, fAddress);
  MEMBER(TCPEndpointAddressMsg, fPort);
  MEMBER(UDPEndpointBaseMsg, error);
  MEMBER(UDPEndpointBindMsg, address);
  MEMBER(UDPEndpointBindMsg, port);
  MEMBER(UDPEndpointConnectMsg, address);
  MEMBER(UDPEndpointConnectMsg, port);
  MEMBER(UDPEndpointSendMsg, address);
  MEMBER(UDPEndpointSendMsg, port);
  MEMBER(UDPEndpointSendMsg, buffer);
  MEMBER(UDPEndpointSendMsg, size);
  MEMBER(UDPEndpointReceiveMsg, address);
  MEMBER(UDPEndpointReceiveMsg, port);
  MEMBER(UDPEndpointReceiveMsg, buffer);
  MEMBER(UDPEndpointReceiveMsg, size);
  MEMBER(UDPEndpointCloseMsg, linger);
  MEMBER(UDPEndpointCloseMsg, lingerTime);
  MEMBER(UDPEndpointSetBlockingModeMsg, blocking);
  MEMBER(UDPEndpointReadyForReadMsg, ready);
  MEMBER(UDPEndpointReadyForWriteMsg, ready);
  MEMBER(UDPEndpointAddressMsg, lAddress);
  MEMBER(UDPEndpointAddressMsg, lPort);
  MEMBER(UDPEndpointAddressMsg, fAddress);
  MEMBER(UDPEndpointAddressMsg, fPort);
  MEMBER(UDPEndpointSetMulticastLoopMsg, enable);
  MEMBER(UDPEndpointSetMulticastTTLMsg, ttl);
  MEMBER(UDPEndpointAddMembershipMsg, multiaddr);
  MEMBER(UDPEndpointAddMembershipMsg, interface);
  MEMBER(UDPEndpointDropMembershipMsg, multiaddr);
  MEMBER(UDPEndpointDropMembershipMsg, interface);
  MEMBER(antEnvMsg, dstSelector);
  MEMBER(antEnvMsg, dstModule);
  MEMBER(antEnvMsg, dstOperation);
  MEMBER(antEnvMsg, sender);
  MEMBER(antEnvMsg, msgSize);
  MEMBER(antEnvMsg, invocationType);
  MEMBER(antEnvMsg, contInfo);
  MEMBER(antEnvMsg, continuation);
  void (OObject::*m0)(const OSystemEvent&) = &OObject::Init;
  void (OObject::*m1)(const OSystemEvent&) = &OObject::Start;
  void (OObject::*m2)(const OSystemEvent&) = &OObject::Stop;
  void (OObject::*m3)(const OSystemEvent&) = &OObject::Destroy;
  OStatus (OObject::*m4)(const OSystemEvent&) = &OObject::DoInit;
  OStatus (OObject::*m5)(const OSystemEvent&) = &OObject::DoStart;
  OStatus (OObject::*m6)(const OSystemEvent&) = &OObject::DoStop;
  OStatus (OObject::*m7)(const OSystemEvent&) = &OObject::DoDestroy;
  OReason (OSystemEvent::*m8)() const = &OSystemEvent::Reason;
  const void* (OSystemEvent::*m9)() const = &OSystemEvent::Param;
  size_t (OSystemEvent::*m10)() const = &OSystemEvent::ParamSize;
  int (OConnectEvent::*m11)() const = &OConnectEvent::ObsIndex;
  const char* (OConnectEvent::*m12)() const = &OConnectEvent::SubName;
  bool (OConnectEvent::*m13)() const = &OConnectEvent::IsConnect;
  bool (OConnectEvent::*m14)() const = &OConnectEvent::IsDisconnect;
  int (OControlEvent::*m15)() const = &OControlEvent::SbjIndex;
  const char* (OControlEvent::*m16)() const = &OControlEvent::SubName;
  bool (OControlEvent::*m17)() const = &OControlEvent::IsAddObserver;
  bool (OControlEvent::*m18)() const = &OControlEvent::IsRemoveObserver;
  const ObserverID& (OControlEvent::*m19)() const = &OControlEvent::SenderID;
  int (OReadyEvent::*m20)() const = &OReadyEvent::SbjIndex;
  const ObserverID& (OReadyEvent::*m21)() const = &OReadyEvent::SenderID;
  bool (OReadyEvent::*m22)() const = &OReadyEvent::IsAssert;
  bool (OReadyEvent::*m23)() const = &OReadyEvent::IsDeassert;
  void (ONotifyEvent::*m24)(int) = &ONotifyEvent::SetIndex;
  void (ONotifyEvent::*m25)(const OSubjectInfo&) = &ONotifyEvent::SetSubjectInfo;
  void (ONotifyEvent::*m26)(int) = &ONotifyEvent::SetNumOfData;
  void (ONotifyEvent::*m27)(int) = &ONotifyEvent::SetNumOfNotify;
  void (ONotifyEvent::*m28)(int, RCRegion*) = &ONotifyEvent::SetData;
  int (ONotifyEvent::*m29)() const = &ONotifyEvent::ObsIndex;
  const OSubjectInfo& (ONotifyEvent::*m30)() const = &ONotifyEvent::SenderID;
  int (ONotifyEvent::*m31)() const = &ONotifyEvent::NumOfData;
  int (ONotifyEvent::*m32)() const = &ONotifyEvent::NumOfNotify;
  const void* (ONotifyEvent::*m33)(int) const = &ONotifyEvent::Data;
  const void** (ONotifyEvent::*m34)() const = &ONotifyEvent::Data;
  RCRegion* (ONotifyEvent::*m35)(int) const = &ONotifyEvent::RCData;
  OStatus (OSubject::*m36)(const OServiceEntry&) = &OSubject::SetReadyEntry;
  const SubjectID& (OSubject::*m37)() const = &OSubject::GetID;
  OStatus (OSubject::*m38)(size_t) = &OSubject::SetBufferSize;
  size_t (OSubject::*m39)() const = &OSubject::GetBufferSize;
  OStatus (OSubject::*m40)(size_t) = &OSubject::SetNotifyUnitSize;
  size_t (OSubject::*m41)() const = &OSubject::GetNotifyUnitSize;
  OStatus (OSubject::*m42)(const OObserverInfo&, RCRegion*) = &OSubject::SetData;
  OStatus (OSubject::*m43)(const ObserverID&, RCRegion*) = &OSubject::SetData;
  OStatus (OSubject::*m44)(RCRegion*) = &OSubject::SetData;
  OStatus (OSubject::*m45)(const OObserverInfo&, const OShmPtrBase&) = &OSubject::SetData;
  OStatus (OSubject::*m46)(const ObserverID&, const OShmPtrBase&) = &OSubject::SetData;
  OStatus (OSubject::*m47)(const OShmPtrBase&) = &OSubject::SetData;
  OStatus (OSubject::*m48)(const OObserverInfo&, const void*, size_t) = &OSubject::SetData;
  OStatus (OSubject::*m49)(const ObserverID&, const void*, size_t) = &OSubject::SetData;
  OStatus (OSubject::*m50)(const void*, size_t) = &OSubject::SetData;
  OStatus (OSubject::*m51)(const OObserverInfo&, MemoryRegionID, u_int) = &OSubject::SetData;
  OStatus (OSubject::*m52)(const ObserverID&, MemoryRegionID, u_int) = &OSubject::SetData;
  OStatus (OSubject::*m53)(MemoryRegionID, size_t) = &OSubject::SetData;
  OStatus (OSubject::*m54)(const OObserverInfo&, const OMemoryLocator&) = &OSubject::SetData;
  OStatus (OSubject::*m55)(const ObserverID&, const OMemoryLocator&) = &OSubject::SetData;
  OStatus (OSubject::*m56)(const OMemoryLocator&) = &OSubject::SetData;
  OStatus (OSubject::*m57)(const OObserverInfo&) = &OSubject::NotifyObserver;
  OStatus (OSubject::*m58)(const ObserverID&) = &OSubject::NotifyObserver;
  OStatus (OSubject::*m59)() = &OSubject::NotifyObservers;
  size_t (OSubject::*m60)(const OObserverInfo&) const = &OSubject::RemainBuffer;
  size_t (OSubject::*m61)(const ObserverID&) const = &OSubject::RemainBuffer;
  size_t (OSubject::*m62)() const = &OSubject::RemainBuffer;
  OStatus (OSubject::*m63)(const OObserverInfo&) = &OSubject::ClearBuffer;
  OStatus (OSubject::*m64)(const ObserverID&) = &OSubject::ClearBuffer;
  OStatus (OSubject::*m65)() = &OSubject::ClearBuffer;
  OStatus (OSubject::*m66)(const OControlMessage&, OStatus) = &OSubject::ControlHandler;
  OStatus (OSubject::*m67)(const OReadyMessage&) = &OSubject::ReadyHandler;
  OStatus (OSubject::*m68)(OControlMessage*) = &OSubject::ControlHandler;
  OStatus (OSubject::*m69)(OReadyMessage*) = &OSubject::ReadyHandler;
  int (OSubject::*m70)() const = &OSubject::NumberOfObservers;
  ObserverConstIterator (OSubject::*m71)() const = &OSubject::begin;
  ObserverConstIterator (OSubject::*m72)() const = &OSubject::end;
  ObserverConstIterator (OSubject::*m73)(const ObserverID&) const = &OSubject::FindObserver;
  int (OSubject::*m74)(const ObserverID&) const = &OSubject::ReadyStatus;
  int (OSubject::*m75)(const OObserverInfo&) const = &OSubject::ReadyStatus;
  int (OSubject::*m76)() const = &OSubject::IsAllReady;
  int (OSubject::*m77)() const = &OSubject::IsAnyReady;
  int (OSubject::*m78)() const = &OSubject::IsReady;
  int (OSubject::*m79)(const ObserverID&) const = &OSubject::IsReady;
  int (OSubject::*m80)(const OObserverInfo&) const = &OSubject::IsReady;
  int (OSubject::*m81)(const OMemoryLocator&) const = &OSubject::NumberOfReference;
  int (OSubject::*m82)(RCRegion*) = &OSubject::Lock;
  int (OSubject::*m83)(RCRegion*) = &OSubject::Unlock;
  OStatus (OObserver::*m84)(const OServiceEntry&) = &OObserver::SetNotifyEntry;
  void (OObserver::*m85)(size_t) = &OObserver::SetSkip;
  void (OObserver::*m86)(size_t, size_t, size_t) = &OObserver::SetBufCtrlParam;
  OStatus (OObserver::*m87)(const OConnectMessage&, OStatus) = &OObserver::ConnectHandler;
  OStatus (OObserver::*m88)(const ONotifyMessage&, ONotifyEvent*) = &OObserver::NotifyHandler;
  OStatus (OObserver::*m89)(OConnectMessage*) = &OObserver::ConnectHandler;
  OStatus (OObserver::*m90)(ONotifyMessage*, ONotifyEvent*) = &OObserver::NotifyHandler;
  OStatus (OObserver::*m91)() = &OObserver::AssertReady;
  OStatus (OObserver::*m92)() = &OObserver::DeassertReady;
  OStatus (OObserver::*m93)(const SubjectID&) = &OObserver::AssertReady;
  OStatus (OObserver::*m94)(const SubjectID&) = &OObserver::DeassertReady;
  OStatus (OObserver::*m95)(const OSubjectInfo&) = &OObserver::AssertReady;
  OStatus (OObserver::*m96)(const OSubjectInfo&) = &OObserver::DeassertReady;
  SubjectConstIterator (OObserver::*m97)() const = &OObserver::begin;
  SubjectConstIterator (OObserver::*m98)() const = &OObserver::end;
  SubjectID (OObserver::*m99)(RCRegion*) const = &OObserver::FindSender;
  int (OObserver::*m100)() const = &OObserver::NumberOfSubjects;
  const ObserverID& (OObserver::*m101)() const = &OObserver::GetObserverID;
  const ObserverID& (OObserver::*m102)() const = &OObserver::GetID;
  void (OObserver::*m103)(unsigned int*, size_t) = &OObserver::Dump;
  void (RCRegion::*m104)() = &RCRegion::AddReference;
  void (RCRegion::*m105)() = &RCRegion::RemoveReference;
  int (RCRegion::*m106)() const = &RCRegion::NumberOfReference;
  char* (RCRegion::*m107)() const = &RCRegion::Base;
  size_t (RCRegion::*m108)() const = &RCRegion::Size;
  MemoryRegionID (RCRegion::*m109)() const = &RCRegion::MemID;
  offset_t (RCRegion::*m110)() const = &RCRegion::Offset;
  RCRegion::RegionType (RCRegion::*m111)() const = &RCRegion::GetType;
  void (RCRegion::*m112)(size_t) = &RCRegion::SetSize;
  void (OPowerStatus::*m113)(longword, word, word, word, sbyte, byte) = &OPowerStatus::Set;
  void (OPowerStatus::*m114)() const = &OPowerStatus::Print;
  void (OPowerStatus::*m115)() const = &OPowerStatus::PrintDetail;
  void (OCommandInfo::*m116)(ODataType, OPrimitiveID, size_t) = &OCommandInfo::Set;
  void (OCommandVectorData::*m117)(size_t) = &OCommandVectorData::SetNumData;
  OCommandInfo* (OCommandVectorData::*m118)(int) = &OCommandVectorData::GetInfo;
  OCommandData* (OCommandVectorData::*m119)(int) = &OCommandVectorData::GetData;
  void (OSensorFrameInfo::*m120)(ODataType, OPrimitiveID, size_t) = &OSensorFrameInfo::Set;
  void (OSensorFrameVectorData::*m121)(size_t) = &OSensorFrameVectorData::SetNumData;
  OSensorFrameInfo* (OSensorFrameVectorData::*m122)(int) = &OSensorFrameVectorData::GetInfo;
  OSensorFrameData* (OSensorFrameVectorData::*m123)(int) = &OSensorFrameVectorData::GetData;
  void (OSoundInfo::*m124)(ODataType, OPrimitiveID, size_t) = &OSoundInfo::Set;
  void (OSoundVectorData::*m125)(size_t) = &OSoundVectorData::SetNumData;
  OSoundInfo* (OSoundVectorData::*m126)(int) = &OSoundVectorData::GetInfo;
  byte* (OSoundVectorData::*m127)(int) = &OSoundVectorData::GetData;
  void (OFbkImageVectorData::*m128)(OPrimitiveID) = &OFbkImageVectorData::SetPrimitiveID;
  OFbkImageInfo* (OFbkImageVectorData::*m129)(int) = &OFbkImageVectorData::GetInfo;
  byte* (OFbkImageVectorData::*m130)(int) = &OFbkImageVectorData::GetData;
  void (OCdtInfo::*m131)(OPrimitiveID, OCdtChannel) = &OCdtInfo::Init;
  void (OCdtInfo::*m132)(int, byte, byte, byte, byte) = &OCdtInfo::Set;
  void (OCdtVectorData::*m133)(size_t) = &OCdtVectorData::SetNumData;
  OCdtInfo* (OCdtVectorData::*m134)(int) = &OCdtVectorData::GetInfo;
  bool (OFbkImage::*m135)() const = &OFbkImage::IsValid;
  byte* (OFbkImage::*m136)() const = &OFbkImage::Pointer;
  int (OFbkImage::*m137)() const = &OFbkImage::Width;
  int (OFbkImage::*m138)() const = &OFbkImage::Height;
  int (OFbkImage::*m139)() const = &OFbkImage::Skip;
  byte (OFbkImage::*m140)(int, int) const = &OFbkImage::Pixel;
  word (OFbkImage::*m141)() const = &OFbkImage::FieldCounter;
  byte (OFbkImage::*m142)(OCdtChannel) const = &OFbkImage::ColorFrequency;
  longword (OFbkImage::*m143)() = &OFbkImage::GetTagInfo;
  OStatus (OTime::*m144)(time_t, sbyte) = &OTime::Set;
  OStatus (OTime::*m145)(time_t) = &OTime::SetClock;
  OStatus (OTime::*m146)(time_t) = &OTime::SetLocalTime;
  OStatus (OTime::*m147)(sbyte) = &OTime::SetTimeDif;
  time_t (OTime::*m148)() const = &OTime::GetClock;
  time_t (OTime::*m149)() const = &OTime::GetLocalTime;
  sbyte (OTime::*m150)() const = &OTime::GetTimeDif;
  antError (TCPEndpointBaseMsg::*m151)(TCPEndpointError) = &TCPEndpointBaseMsg::Reply;
  antError (UDPEndpointBaseMsg::*m152)(UDPEndpointError) = &UDPEndpointBaseMsg::Reply;
  OID& (antStackRef::*m153)() = &antStackRef::get_oid;
  MAV_Dispatcher* (antStackRef::*m154)() = &antStackRef::get_disp;
  bool (antStackRef::*m155)() = &antStackRef::IsValid;
  OID (antEnvMsgContInfo::*m156)() = &antEnvMsgContInfo::GetOID;
  uint32 (antEnvMsgContInfo::*m157)() = &antEnvMsgContInfo::GetSelector;
  antError (antEnvMsg::*m158)() = &antEnvMsg::Reply;
  antError (antEnvMsg::*m159)(antStackRef, OID&, int32, int) = &antEnvMsg::Send;
  antError (antEnvMsg::*m160)(antStackRef, int) = &antEnvMsg::Call;
  antEnvMsg* (*m161)(ANTENVMSG) = &antEnvMsg::Receive;
  int32 (antEnvMsg::*m162)() = &antEnvMsg::GetOperation;
  OID& (antEnvMsg::*m163)() = &antEnvMsg::GetSender;
  OSTREAM& (antModuleRef::*m164)(OSTREAM&) const = &antModuleRef::Print;
  boolean (IPAddress::*m165)() const = &IPAddress::InMulticast;
  boolean (IPAddress::*m166)() const = &IPAddress::InBroadcast;
  boolean (IPAddress::*m167)() const = &IPAddress::InLoop;
  boolean (IPAddress::*m168)() const = &IPAddress::AllHostsGroup;
  uint32 (IPAddress::*m169)() const = &IPAddress::Address;
  char* (IPAddress::*m170)(char*) const = &IPAddress::GetAsString;
  OSTREAM& (IPAddress::*m171)(OSTREAM&) const = &IPAddress::print;
  OStatus (*f0)(const char*, OPrimitiveID*) = OPENR::OpenPrimitive;
  OStatus (*f1)(OPrimitiveID) = OPENR::ClosePrimitive;
  OStatus (*f2)(OPrimitiveID, OPrimitiveRequest, void*, size_t, void*, size_t) = OPENR::ControlPrimitive;
  OStatus (*f3)(size_t, MemoryRegionID*, OCommandVectorData**) = OPENR::NewCommandVectorData;
  OStatus (*f4)(MemoryRegionID) = OPENR::DeleteCommandVectorData;
  OStatus (*f5)(size_t, size_t, MemoryRegionID*, OSoundVectorData**) = OPENR::NewSoundVectorData;
  OStatus (*f6)(MemoryRegionID) = OPENR::DeleteSoundVectorData;
  OStatus (*f7)(OPrimitiveID) = OPENR::EnableJointGain;
  OStatus (*f8)(OPrimitiveID) = OPENR::DisableJointGain;
  OStatus (*f9)(OPrimitiveID, word, word, word, word, word, word) = OPENR::SetJointGain;
  OStatus (*f10)(OPrimitiveID, word, word, word, word, word, word) = OPENR::RegisterDefaultJointGain;
  OStatus (*f11)(OPrimitiveID, word*, word*, word*, word*, word*, word*) = OPENR::GetJointGain;
  OStatus (*f12)(OPrimitiveID, word*, word*, word*, word*, word*, word*) = OPENR::GetDefaultJointGain;
  OStatus (*f13)(OPrimitiveID) = OPENR::SetDefaultJointGain;
  OStatus (*f14)(OPrimitiveID, OJointValue*) = OPENR::GetJointValue;
  OStatus (*f15)(OPrimitiveID, OSensorValue*) = OPENR::GetSensorValue;
  OStatus (*f16)(OVRSyncKey*) = OPENR::NewSyncKey;
  OStatus (*f17)(OVRSyncKey) = OPENR::CancelSyncKey;
  OStatus (*f18)(OVRSyncKey, OVRSyncKey*, OVRSyncKey*) = OPENR::DivideSyncKey;
  OStatus (*f19)(MemoryRegionID*, OCdtVectorData**) = OPENR::NewCdtVectorData;
  OStatus (*f20)(MemoryRegionID) = OPENR::DeleteCdtVectorData;
  OStatus (*f21)(MemoryRegionID) = OPENR::SetCdtVectorData;
  OStatus (*f22)(OPower) = OPENR::SetMotorPower;
  OStatus (*f23)(const OBootCondition&) = OPENR::Shutdown;
  OStatus (*f24)(OBootCondition*) = OPENR::GetBootCondition;
  OStatus (*f25)(OPowerStatus*) = OPENR::GetPowerStatus;
  OStatus (*f26)(const OPowerStatus&, const OServiceEntry&) = OPENR::ObservePowerStatus;
  OStatus (*f27)(const OServiceEntry&) = OPENR::UnobservePowerStatus;
  OStatus (*f28)(const char*, ODesignDataID*, byte**, size_t*) = OPENR::FindDesignData;
  OStatus (*f29)(ODesignDataID) = OPENR::DeleteDesignData;
  OStatus (*f30)(char*) = OPENR::GetRobotDesign;
  OStatus (*f31)(OMemoryStickStatus*) = OPENR::GetMemoryStickStatus;
  OStatus (*f32)(OFatal) = OPENR::Fatal;
  OStatus (*f33)(const OTime&) = OPENR::SetTime;
  OStatus (*f34)(OTime*) = OPENR::GetTime;
  OStatus (*f35)(sbyte) = OPENR::SetTimeDifference;
  OStatus (*f36)(sbyte*) = OPENR::GetTimeDifference;
  OStatus (*f37)(OVolumeSwitch) = OPENR::SetVolumeSwitch;
  OStatus (*f38)(OVolumeSwitch*) = OPENR::GetVolumeSwitch;
  OStatus (*f39)(MWIID) = OPENR::RequireMWInfo;
  OStatus (*f40)(MWIID) = OPENR::CancelMWInfo;
  OStatus (*f41)(MWIID, bool*) = OPENR::IsMWInfoRequired;
  OStatus (*f42)(size_t, MemoryRegionID*, OSensorFrameVectorData**) = OPENR::NewSensorFrameVectorData;
  OStatus (*f43)(MemoryRegionID) = OPENR::DeleteSensorFrameVectorData;
  OStatus (*f44)(MemoryRegionID*, OFbkImageVectorData**) = OPENR::NewFbkImageVectorData;
  OStatus (*f45)(MemoryRegionID) = OPENR::DeleteFbkImageVectorData;
}

// Never called.
void constructors() {
  { OObject one; }
  { OSystemEvent one(make(OReason), make(void*), make(size_t)); }
  { OConnectEvent one(make(int), make(char*), make(OConnectCmd)); }
  { OControlEvent one(make(int), make(char*), make(ObjcommCommand)); }
  { OControlEvent one(make(int), make(ObserverID), make(char*), make(ObjcommCommand)); }
  { OReadyEvent one(make(int), make(ObserverID), make(ObjcommCommand)); }
  { ONotifyEvent one; }
  { OSubject one; }
  { OObserver one; }
  new RCRegion;
  new RCRegion(make(size_t));
  new RCRegion(make(MemoryRegionID), make(offset_t), make(void*), make(size_t));
  { OPowerStatus one; }
  {
    OPowerStatus one(make(longword), make(word), make(word), make(word), make(word), make(word), make(word),
                     make(sbyte), make(byte));
  }
  { OPowerStatus one(make(const OPowerStatus&)); }
  { OBootCondition one; }
  { OBootCondition one(make(word)); }
  { OBootCondition one(make(word), make(time_t), make(longword)); }
  { OBootCondition one(make(word), make(time_t), make(longword), make(byte)); }
  { OBootCondition one(make(const OBootCondition&)); }
  { OJointValue one; }
  { OJointValue one(make(slongword), make(word), make(sword), make(slongword), make(word)); }
  { OFbkImage one(make(OFbkImageInfo*), make(byte*), make(OFbkImageBand)); }
  { OPrimitiveControl_SpeakerVolume one(make(longword)); }
  { OPrimitiveControl_SpeakerSoundType one(make(OSpeakerSoundType)); }
  { OPrimitiveControl_MasterTuningMIDI one(make(sword)); }
  { OPrimitiveControl_CameraParam one; }
  { OPrimitiveControl_CameraParam one(make(longword)); }
  { OPrimitiveControl_Cdt one; }
  { OPrimitiveControl_Cdt one(make(longword)); }
  { OPrimitiveControl_JointCommandValue2 one(make(slongword)); }
  { OPrimitiveControl_JointValue one; }
  { OPrimitiveControl_JointValue one(make(slongword), make(word), make(sword), make(slongword), make(word)); }
  { OPrimitiveControl_LEDCommandValue2 one(make(OLEDValue)); }
  { OPrimitiveControl_BtSwitchWatcherInfo one(make(OBtSwitchEvent), make(const OServiceEntry&)); }
  { OPrimitiveControl_BtSwitchEvent one(make(OBtSwitchEvent), make(OSwitchValue)); }
  { OPrimitiveControl_LEDCommandValue3 one(make(sword), make(OLED3Mode)); }
  { OPrimitiveControl_JointCommandValue4 one(make(OJointValue4)); }
  { OTime one; }
  { OTime one(make(time_t), make(sbyte)); }
  { OTime one(make(const OTime&)); }
  { TCPEndpointBaseMsg one; }
  { TCPEndpointBaseMsg one(make(antModuleRef&), make(TCPEndpointOperation)); }
  { TCPEndpointBacklogQueueMsg one; }
  { TCPEndpointBacklogQueueMsg one(make(antModuleRef&), make(int16)); }
  { TCPEndpointBindMsg one; }
  { TCPEndpointBindMsg one(make(antModuleRef&), make(IPAddress), make(Port)); }
  { TCPEndpointListenMsg one; }
  { TCPEndpointListenMsg one(make(antModuleRef&), make(IPAddress), make(Port), make(IPAddress), make(Port)); }
  { TCPEndpointBacklogListenMsg one; }
  { TCPEndpointBacklogListenMsg one(make(antModuleRef&), make(IPAddress), make(Port), make(IPAddress), make(Port)); }
  { TCPEndpointAcceptMsg one; }
  { TCPEndpointAcceptMsg one(make(antModuleRef&)); }
  { TCPEndpointConnectMsg one; }
  { TCPEndpointConnectMsg one(make(antModuleRef&), make(IPAddress), make(Port), make(IPAddress), make(Port)); }
  { TCPEndpointSendMsg one; }
  { TCPEndpointSendMsg one(make(antModuleRef&), make(byte*), make(int), make(int16)); }
  { TCPEndpointReceiveMsg one; }
  { TCPEndpointReceiveMsg one(make(antModuleRef&), make(byte*), make(int), make(int), make(int16)); }
  { TCPEndpointCloseMsg one; }
  { TCPEndpointCloseMsg one(make(antModuleRef&), make(bool), make(int), make(bool), make(int16)); }
  { TCPEndpointSetBlockingModeMsg one; }
  { TCPEndpointSetBlockingModeMsg one(make(antModuleRef&), make(bool), make(int16)); }
  { TCPEndpointReadyForReadMsg one; }
  { TCPEndpointReadyForReadMsg one(make(antModuleRef&), make(int16)); }
  { TCPEndpointReadyForWriteMsg one; }
  { TCPEndpointReadyForWriteMsg one(make(antModuleRef&), make(int16)); }
  { TCPEndpointAddressMsg one; }
  { TCPEndpointAddressMsg one(make(antModuleRef&), make(int16)); }
  { UDPEndpointBaseMsg one; }
  { UDPEndpointBaseMsg one(make(antModuleRef&), make(UDPEndpointOperation)); }
  { UDPEndpointBindMsg one; }
  { UDPEndpointBindMsg one(make(antModuleRef&), make(IPAddress), make(Port)); }
  { UDPEndpointConnectMsg one; }
  { UDPEndpointConnectMsg one(make(antModuleRef&), make(IPAddress), make(Port)); }
  { UDPEndpointSendMsg one; }
  { UDPEndpointSendMsg one(make(antModuleRef&), make(byte*), make(int)); }
  { UDPEndpointSendMsg one(make(antModuleRef&), make(IPAddress), make(Port), make(byte*), make(int)); }
  { UDPEndpointReceiveMsg one; }
  { UDPEndpointReceiveMsg one(make(antModuleRef&), make(byte*), make(int)); }
  { UDPEndpointCloseMsg one; }
  { UDPEndpointCloseMsg one(make(antModuleRef&), make(bool), make(int)); }
  { UDPEndpointSetBlockingModeMsg one; }
  { UDPEndpointSetBlockingModeMsg one(make(antModuleRef&), make(bool)); }
  { UDPEndpointReadyForReadMsg one; }
  { UDPEndpointReadyForReadMsg one(make(antModuleRef&)); }
  { UDPEndpointReadyForWriteMsg one; }
  { UDPEndpointReadyForWriteMsg one(make(antModuleRef&)); }
  { UDPEndpointAddressMsg one; }
  { UDPEndpointAddressMsg one(make(antModuleRef&)); }
  { UDPEndpointResetConnectMsg one; }
  { UDPEndpointResetConnectMsg one(make(antModuleRef&)); }
  { UDPEndpointSetMulticastLoopMsg one; }
  { UDPEndpointSetMulticastLoopMsg one(make(antModuleRef&), make(Boolean)); }
  { UDPEndpointSetMulticastTTLMsg one; }
  { UDPEndpointSetMulticastTTLMsg one(make(antModuleRef&), make(byte)); }
  { UDPEndpointAddMembershipMsg one; }
  { UDPEndpointAddMembershipMsg one(make(antModuleRef&), make(IPAddress), make(IPAddress)); }
  { UDPEndpointDropMembershipMsg one; }
  { UDPEndpointDropMembershipMsg one(make(antModuleRef&), make(IPAddress), make(IPAddress)); }
  { antStackRef one; }
  { antStackRef one(make(const OID&)); }
  { antStackRef one(make(const MAV_Dispatcher*)); }
  { antStackRef one(make(char*)); }
  { antEnvMsgContInfo one; }
  { antEnvMsgContInfo one(make(TID&)); }
  { antEnvMsgContInfo one(make(OID), make(uint32)); }
  { antEnvMsg one; }
  { antEnvMsg one(make(antEnvMsg&)); }
  { antEnvMsg one(make(int32), make(Selector)); }
  { antEnvMsg one(make(antModuleRef), make(int32), make(Selector)); }
  { antModuleRef one; }
  { IPAddress one; }
  { IPAddress one(make(const IPAddress&)); }
  { IPAddress one(make(uint32)); }
  { IPAddress one(make(int)); }
  { IPAddress one(make(byte), make(byte), make(byte), make(byte)); }
  { IPAddress one(make(const char*)); }
}

Names::Names() {}

OStatus Names::DoInit(const OSystemEvent& event) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  OSYSLOG1((osyslogINFO, "%s %d", "named", event.Reason() == oreasonBOOT));
  OSYSDEBUG(("not seen\n"));
  OSYSPRINT(("%d %d %d\n", oradians(90), micro(1.5), (int)degrees(radians(10.0) + 1e-9)));
  OList<int, 4> list;
  list.PushBack(1);
  OShmPtr<ODataVectorInfo> shared;
  shared.Allocate();
  ODataVectorInfo three;
  three.numData = 3;
  *shared = three;
  cout << "size " << list.GetSize() << " " << shared->numData << " " << IPAddress(10, 0, 1, 100) << endl;
  OCalendarTime calendar(OTime(0, 0));
  cout << calendar.GetYear() << endl;
  return oSUCCESS;
}

OStatus Names::DoStart(const OSystemEvent& event) { return oSUCCESS; }
OStatus Names::DoStop(const OSystemEvent& event) { return oSUCCESS; }
OStatus Names::DoDestroy(const OSystemEvent& event) { return oSUCCESS; }
