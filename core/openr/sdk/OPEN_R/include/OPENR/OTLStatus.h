// What containers answer.
#ifndef BTR_OPENR_OTLSTATUS_H
#define BTR_OPENR_OTLSTATUS_H

#include <Types.h>

typedef int OTLStatus;
const OTLStatus otlSUCCESS = 0;
const OTLStatus otlUNDEF = 1;
const OTLStatus otlFAIL = 2;
const OTLStatus otlOVERFLOW = 3;   ///< no room for one more
const OTLStatus otlUNDERFLOW = 4;  ///< nothing is in it

#endif
