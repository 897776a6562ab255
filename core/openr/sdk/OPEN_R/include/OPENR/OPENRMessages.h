// What messages between the system and an object look like. A stub hands them on.
#ifndef BTR_OPENR_OPENRMESSAGES_H
#define BTR_OPENR_OPENRMESSAGES_H

#include <OPENR/OPENR.h>
#include <OPENR/OPower.h>

typedef longword OMsgType;

struct OReasonMessage {
  OMsgType msgType;
  OReason reason;
  size_t paramSize;
  byte param[oreasonPARAM_MAX_SIZE];
};

/// What the Extra entry of ObservePowerStatus() is given.
struct OPowerStatusMessage {
  OMsgType msgType;
  OPowerStatus powerStatus;
};

#endif
