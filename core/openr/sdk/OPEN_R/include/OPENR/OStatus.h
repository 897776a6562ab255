// What a call answers.
#ifndef BTR_OPENR_OSTATUS_H
#define BTR_OPENR_OSTATUS_H

#include <Types.h>

typedef longword OStatus;

const OStatus oSUCCESS = 0;
const OStatus oUNDEF = 1;
const OStatus oFAIL = 2;
const OStatus oNOT_SUPPORTED = 3;
const OStatus oINVALID_ARG = 4;
const OStatus oNO_MEMORY = 5;
const OStatus oNOT_FOUND = 6;
const OStatus oALREADY_EXIST = 7;
const OStatus oOPEN_FAILURE = 8;
const OStatus oCLOSE_FAILURE = 9;
const OStatus oFULL_OF_QUEUE = 10;
const OStatus oITEM_NOT_FOUND = 11;
const OStatus oWRONG_MESSAGE = 12;
const OStatus oSEND_FAIL = 13;
const OStatus oSEND_WITH_RBOX_FAIL = 14;
const OStatus oCALL_FAIL = 15;
const OStatus oREPLY_FAIL = 16;
const OStatus oRECEIVE_FAIL = 17;
const OStatus oNOT_INITIALIZED = 18;
const OStatus oREFUSED = 19;
const OStatus oSIZE_TOO_LARGE = 20;
const OStatus oNOT_AVAILABLE = 21;
const OStatus oUNKNOWN_DATA = 22;
const OStatus oUNKNOWN_COMMAND = 23;
const OStatus oOUT_OF_RANGE = 24;
const OStatus oOVERFLOW = 25;
const OStatus oUNDERFLOW = 26;
const OStatus oINVALID_OID = 27;
const OStatus oFATAL = 28;
const OStatus oOBJ_NOT_FOUND = 29;
const OStatus oSYNTAX_ERROR = 30;
const OStatus oNO_ROBOT_DESIGN = 31;
const OStatus oCHECK_SUM_ERROR = 32;
const OStatus oBUSY = 33;
const OStatus oINVALID_PRIMITIVE_ID = 4096 + 0;
const OStatus oINVALID_DATA_VECTOR_ID = 4096 + 1;
const OStatus oINVALID_DATA_TYPE = 4096 + 2;
const OStatus oINVALID_DATA = 4096 + 3;
const OStatus oINVALID_REQUEST = 4096 + 4;
const OStatus oALREADY_REGISTERED = 4096 + 5;
const OStatus oNOT_REGISTERED = 4096 + 6;
const OStatus oEXCEEDED_PARAM_SIZE = 4096 + 7;
const OStatus oINVALID_ASYNC_REQ_ID = 4096 + 8;
const OStatus oFULL_OF_ASYNC_QUEUE = 4096 + 9;
const OStatus oNO_SYNC_KEY = 4096 + 10;
const OStatus oINVALID_SYNC_KEY = 4096 + 11;
const OStatus oGAIN_DISABLED = 4096 + 12;
const OStatus oTOO_MANY_ODA = 4096 + 13;
const OStatus oDESIGNDATA_SIZE_ZERO = 4096 + 14;
const OStatus oCPC_PLUG_OUT = 4096 + 15;
const OStatus oMS_NOT_WRITABLE = 4096 + 16;
const OStatus oALERT_JOINT_UNCONTROLLABLE = 8192 + 0;

#endif
