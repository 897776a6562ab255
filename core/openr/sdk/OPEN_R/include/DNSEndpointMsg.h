// Names of machines. The simulated robot knows "localhost" and addresses written as numbers.
#ifndef BTR_OPENR_DNSENDPOINTMSG_H
#define BTR_OPENR_DNSENDPOINTMSG_H

#include <EndpointTypes.h>
#include <IPAddress.h>
#include <antEnvMsg.h>

#include <string.h>

enum DNSEndpointError {
  DNS_SUCCESS = 0,
  DNS_FAIL = 1,
  DNS_NAME_ERROR = 2,
  DNS_HOST_NOT_FOUND = 3,
  DNS_TIMEOUT = 4,
  DNS_CONNECTION_CLOSED = 5,
  DNS_OPERATION_INVALID = 6,
  DNS_OPERATION_UNKNOWN = 7
};

enum DNSEndpointOperation {
  DNSEndpoint_Operation_GetHostByName = 0,
  DNSEndpoint_Operation_GetHostByAddr = 1,
  DNSEndpoint_Operation_Close = 2,
  DNSEndpoint_Operation_GetServers = 3,
  DNSEndpoint_Operation_SetServers = 4
};

const int DNS_NAME_MAX = 255;
const int DNS_ADDRESSES_MAX = 8;

class DNSEndpointBaseMsg : public antEnvMsg {
 public:
  DNSEndpointError error;
  DNSEndpointBaseMsg() : error(DNS_SUCCESS) {}
  DNSEndpointBaseMsg(antModuleRef& _module, DNSEndpointOperation _operation)
      : antEnvMsg(_module, _operation), error(DNS_SUCCESS) {}
};

class DNSEndpointGetHostByNameMsg : public DNSEndpointBaseMsg {
 public:
  char name[DNS_NAME_MAX + 1];
  IPAddress address;
  IPAddress addresses[DNS_ADDRESSES_MAX];
  int numAddresses;
  DNSEndpointGetHostByNameMsg() : numAddresses(0) { name[0] = 0; }
  DNSEndpointGetHostByNameMsg(antModuleRef& _module, const char* _name)
      : DNSEndpointBaseMsg(_module, DNSEndpoint_Operation_GetHostByName), numAddresses(0) {
    strncpy(name, _name, DNS_NAME_MAX);
    name[DNS_NAME_MAX] = 0;
  }
};

class DNSEndpointGetHostByAddrMsg : public DNSEndpointBaseMsg {
 public:
  char name[DNS_NAME_MAX + 1];
  IPAddress address;
  DNSEndpointGetHostByAddrMsg() { name[0] = 0; }
  DNSEndpointGetHostByAddrMsg(antModuleRef& _module, IPAddress _address)
      : DNSEndpointBaseMsg(_module, DNSEndpoint_Operation_GetHostByAddr), address(_address) {
    name[0] = 0;
  }
};
typedef DNSEndpointGetHostByAddrMsg DNSEndpointGetHostByAddressMsg;

class DNSEndpointCloseMsg : public DNSEndpointBaseMsg {
 public:
  DNSEndpointCloseMsg() {}
  DNSEndpointCloseMsg(antModuleRef& _module) : DNSEndpointBaseMsg(_module, DNSEndpoint_Operation_Close) {}
};

#endif
