// Kinds of endpoints of the IP stack.
#ifndef BTR_OPENR_ENDPOINTTYPES_H
#define BTR_OPENR_ENDPOINTTYPES_H

#include <antTypes.h>

enum EndpointType {
  EndpointType_TCP = 1,
  EndpointType_UDP = 2,
  EndpointType_TFTP = 3,
  EndpointType_DNS = 4,
  EndpointType_POP3 = 5,
  EndpointType_SMTP = 6,
  EndpointType_IP = 7,
  EndpointType_MIBII = 8,
  EndpointType_MIB_ETHERNET = 9,
};

typedef uint16 Port;

#endif
