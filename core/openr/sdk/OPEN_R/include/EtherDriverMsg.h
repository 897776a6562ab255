// What the wireless network card is asked for: its address and what it counted.
#ifndef BTR_OPENR_ETHERDRIVERMSG_H
#define BTR_OPENR_ETHERDRIVERMSG_H

#include <EtherTypes.h>

typedef struct {
  uint32 carrierSenseErrorCount;
  uint32 lateCollisionCount;
  uint32 excessiveCollisionCount;
  uint32 singleCollisionCount;
  uint32 multipleCollisionCount;
  uint32 deferredCount;
  uint32 alignmentErrorCount;
  uint32 fcsErrorCount;
  uint32 frameTooLongCount;
} EtherStatistics;

typedef struct EtherDriverGetMACAddressMsg {
  uint32 port;
  EtherMACAddress address;
  EtherStatus status;
} EtherDriverGetMACAddressMsg;

typedef struct EtherDriverGetStatisticsMsg {
  uint32 port;
  EtherStatistics statistics;
  EtherStatus status;
} EtherDriverGetStatisticsMsg;

#endif
