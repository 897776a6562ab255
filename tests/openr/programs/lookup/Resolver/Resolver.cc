#include <string.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <EndpointTypes.h>
#include <DNSEndpointMsg.h>
#include "Resolver.h"
#include "entry.h"

static char* names[] = { "localhost", "AIBO.lab.example.", "www.example.com.", "192.168.0.7", 0 };

Resolver::Resolver() : asked(0) {}
OStatus Resolver::DoInit(const OSystemEvent& event) { return oSUCCESS; }
OStatus Resolver::DoStart(const OSystemEvent& event)
{
    ipstackRef = antStackRef("IPStack");
    antEnvCreateEndpointMsg create(EndpointType_DNS, 16*1024);
    create.Call(ipstackRef, sizeof(create));
    if (create.error != ANT_SUCCESS) { OSYSLOG1((osyslogERROR, "no endpoint %d", create.error)); return oFAIL; }
    dns = create.moduleRef;

    DNSEndpointGetServerAddressesMsg servers(dns);
    servers.Call(ipstackRef, sizeof(servers));
    OSYSPRINT(("servers %d error %d first %x\n", servers.nscount, servers.error, servers.addrList[0].Address()));
    DNSEndpointGetDefaultDomainNameMsg domain(dns);
    domain.Call(ipstackRef, sizeof(domain));
    OSYSPRINT(("domain [%s] %d\n", domain.name, domain.error));
    IPAddress mine[MAXNS];
    mine[0] = IPAddress("10.0.1.5"); mine[1] = IPAddress(10, 0, 1, 6);
    DNSEndpointSetServerAddressesMsg set(dns, 2, mine);
    set.Call(ipstackRef, sizeof(set));
    DNSEndpointSetDefaultDomainNameMsg setname(dns, "lab.example");
    setname.Call(ipstackRef, sizeof(setname));
    servers.Call(ipstackRef, sizeof(servers));
    domain.Call(ipstackRef, sizeof(domain));
    char a[16];
    servers.addrList[1].GetAsString(a);
    OSYSPRINT(("now %d %s in %s\n", (int)servers.nscount, a, domain.name));

    DNSEndpointGetHostByAddrMsg by(dns, IPAddress(127, 0, 0, 1));
    by.Send(ipstackRef, myOID_, Extra_Entry[entryServerCont], sizeof(by));
    return oSUCCESS;
}
OStatus Resolver::DoStop(const OSystemEvent& event) { return oSUCCESS; }
OStatus Resolver::DoDestroy(const OSystemEvent& event) { return oSUCCESS; }

void Resolver::ServerCont(ANTENVMSG msg)
{
    DNSEndpointGetHostByAddrMsg* host = (DNSEndpointGetHostByAddrMsg*)antEnvMsg::Receive(msg);
    char addr[16];
    host->host_address.GetAsString(addr);
    if (host->n_address > 0) OSYSPRINT(("%s is %s\n", addr, host->name));
    else OSYSPRINT(("%s is nobody\n", addr));
    Ask();
}
void Resolver::Ask()
{
    if (names[asked] == 0) return;
    DNSEndpointGetHostByNameMsg m(dns, names[asked++]);
    antError e = m.Send(ipstackRef, myOID_, Extra_Entry[entryHostCont], sizeof(m));
    if (e != ANT_SUCCESS) OSYSLOG1((osyslogERROR, "%s %d", "Send", e));
}
void Resolver::HostCont(ANTENVMSG msg)
{
    DNSEndpointGetHostByNameMsg* host = (DNSEndpointGetHostByNameMsg*)antEnvMsg::Receive(msg);
    char addr[16], server[16];
    host->host_address.GetAsString(addr); host->server_address.GetAsString(server);
    if (host->error == DNS_SUCCESS && host->n_address > 0) {
        DNSEndpointGetAddressMsg first(dns, 0);
        first.Call(ipstackRef, sizeof(first));
        OSYSPRINT(("name %s address %s aliases %d again %d\n", host->name, addr, host->n_alias, first.error == DNS_SUCCESS && first.address == host->host_address));
    } else OSYSPRINT(("%s unknown (%d)\n", host->name, host->error));
    Ask();
}
