// The wireless network card.
#ifndef BTR_OPENR_ETHERTYPES_H
#define BTR_OPENR_ETHERTYPES_H

#include <Types.h>

#ifdef __cplusplus
#include <iosfwd>
#endif

typedef enum { ETHER_OK = 0, ETHER_FAIL = 1 } EtherStatus;

typedef struct {
  uint8 octet[6];
} EtherMACAddress;

#ifdef __cplusplus
const char* etherStatusStr(EtherStatus status);
/// As "02:00:00:00:00:01".
std::ostream& operator<<(std::ostream& out, const EtherMACAddress& address);
#endif

#endif
