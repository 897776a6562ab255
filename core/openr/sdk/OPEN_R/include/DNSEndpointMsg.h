// Names of machines. Servers and the default domain are those of WLANCONF.TXT; the simulated robot asks nobody and
// knows "localhost", its own name (HOSTNAME), and addresses written as numbers.
#ifndef BTR_OPENR_DNSENDPOINTMSG_H
#define BTR_OPENR_DNSENDPOINTMSG_H

#include <DNSEndpointErr.h>
#include <EndpointTypes.h>
#include <IPAddress.h>
#include <antEnvMsg.h>

#include <string.h>

#define MAXNS 3      /* servers */
#define MAXDNAME 100 /* characters of a name, its end included */
#define DNSENDPOINT_OPERATION_NUM 9

enum DNSEndpointOperation {
  DNSEndpoint_Operation_SetServerAddresses = 0,
  DNSEndpoint_Operation_GetServerAddresses = 1,
  DNSEndpoint_Operation_SetDefaultDomainName = 2,
  DNSEndpoint_Operation_GetDefaultDomainName = 3,
  DNSEndpoint_Operation_GetHostByName = 4,
  DNSEndpoint_Operation_GetHostByAddr = 5,
  DNSEndpoint_Operation_GetAddress = 6,
  DNSEndpoint_Operation_GetAlias = 7,
  DNSEndpoint_Operation_Close = 8
};

/// Copies at most MAXDNAME characters with the end.
inline void btr_copy_name(char* to, const char* from) {
  int i = 0;
  for (; from != 0 && from[i] != 0 && i < MAXDNAME - 1; ++i) to[i] = from[i];
  to[i] = 0;
}

struct DNSEndpointBaseMsg : public antEnvMsg {
  DNSEndpointError error;
  DNSEndpointBaseMsg() : error(DNS_FAIL) {}
  DNSEndpointBaseMsg(antModuleRef& _module, DNSEndpointOperation _operation)
      : antEnvMsg(_module, _operation), error(DNS_FAIL) {}
  antError Reply(DNSEndpointError _error) {
    error = _error;
    return antEnvMsg::Reply();
  }
};

struct DNSEndpointSetServerAddressesMsg : public DNSEndpointBaseMsg {
  int32 nscount;
  IPAddress addrList[MAXNS];
  DNSEndpointSetServerAddressesMsg() : nscount(0) {}
  DNSEndpointSetServerAddressesMsg(antModuleRef& _module, int32 _nscount, IPAddress* _addrList)
      : DNSEndpointBaseMsg(_module, DNSEndpoint_Operation_SetServerAddresses), nscount(_nscount) {
    for (int i = 0; i < _nscount && i < MAXNS; ++i) addrList[i] = _addrList[i];
  }
};

struct DNSEndpointGetServerAddressesMsg : public DNSEndpointBaseMsg {
  int32 nscount;
  IPAddress addrList[MAXNS];
  DNSEndpointGetServerAddressesMsg() : nscount(0) {}
  DNSEndpointGetServerAddressesMsg(antModuleRef& _module)
      : DNSEndpointBaseMsg(_module, DNSEndpoint_Operation_GetServerAddresses), nscount(0) {}
};

struct DNSEndpointSetDefaultDomainNameMsg : public DNSEndpointBaseMsg {
  char name[MAXDNAME];
  DNSEndpointSetDefaultDomainNameMsg() { name[0] = 0; }
  DNSEndpointSetDefaultDomainNameMsg(antModuleRef& _module, const char* _name)
      : DNSEndpointBaseMsg(_module, DNSEndpoint_Operation_SetDefaultDomainName) {
    btr_copy_name(name, _name);
  }
};

struct DNSEndpointGetDefaultDomainNameMsg : public DNSEndpointBaseMsg {
  char name[MAXDNAME];
  DNSEndpointGetDefaultDomainNameMsg() { name[0] = 0; }
  DNSEndpointGetDefaultDomainNameMsg(antModuleRef& _module)
      : DNSEndpointBaseMsg(_module, DNSEndpoint_Operation_GetDefaultDomainName) {
    name[0] = 0;
  }
};

struct DNSEndpointGetHostByNameMsg : public DNSEndpointBaseMsg {
  char name[MAXDNAME];
  IPAddress server_address;
  IPAddress host_address;
  int n_address;  ///< 0: nobody has that name
  int n_alias;
  DNSEndpointGetHostByNameMsg() : n_address(0), n_alias(0) { name[0] = 0; }
  DNSEndpointGetHostByNameMsg(antModuleRef& _module, const char* _name)
      : DNSEndpointBaseMsg(_module, DNSEndpoint_Operation_GetHostByName), n_address(0), n_alias(0) {
    btr_copy_name(name, _name);
  }
};

struct DNSEndpointGetHostByAddrMsg : public DNSEndpointBaseMsg {
  char name[MAXDNAME];
  IPAddress server_address;
  IPAddress host_address;
  int n_address;
  int n_alias;
  DNSEndpointGetHostByAddrMsg() : n_address(0), n_alias(0) { name[0] = 0; }
  DNSEndpointGetHostByAddrMsg(antModuleRef& _module, IPAddress _address)
      : DNSEndpointBaseMsg(_module, DNSEndpoint_Operation_GetHostByAddr),
        host_address(_address),
        n_address(0),
        n_alias(0) {
    name[0] = 0;
  }
};

/// The address number `index` of the endpoint's last answer.
struct DNSEndpointGetAddressMsg : public DNSEndpointBaseMsg {
  int index;
  IPAddress address;
  DNSEndpointGetAddressMsg() : index(0) {}
  DNSEndpointGetAddressMsg(antModuleRef& _module, int _index)
      : DNSEndpointBaseMsg(_module, DNSEndpoint_Operation_GetAddress), index(_index) {}
};

struct DNSEndpointGetAliasMsg : public DNSEndpointBaseMsg {
  int index;
  char name[MAXDNAME];
  DNSEndpointGetAliasMsg() : index(0) { name[0] = 0; }
  DNSEndpointGetAliasMsg(antModuleRef& _module, int _index)
      : DNSEndpointBaseMsg(_module, DNSEndpoint_Operation_GetAlias), index(_index) {
    name[0] = 0;
  }
};

struct DNSEndpointCloseMsg : public DNSEndpointBaseMsg {
  DNSEndpointCloseMsg() {}
  DNSEndpointCloseMsg(antModuleRef& _module) : DNSEndpointBaseMsg(_module, DNSEndpoint_Operation_Close) {}
};

#endif
