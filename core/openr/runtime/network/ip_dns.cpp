// Names of machines. Nobody outside is asked: every address that a robot's program reaches is this computer, so the
// robot knows this computer, itself, and addresses that are written as numbers.
#include <DNSEndpointMsg.h>

#include <algorithm>
#include <cctype>

#include "core/openr/runtime/network/ip_sockets.h"
#include "core/openr/runtime/network/ip_stack.h"

namespace btr::openr {
namespace {

/// As servers are asked for it: in small letters, without the dot that ends a full name.
std::string plainName(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); });
  if (!name.empty() && name.back() == '.') name.pop_back();
  return name;
}

}  // namespace

bool IpStack::isOwnName(std::string name) const {
  const std::string domain = "." + plainName(settings_.value("DNS_DEFDNAME"));
  if (domain.size() > 1 && name.size() > domain.size() &&
      name.compare(name.size() - domain.size(), std::string::npos, domain) == 0)
    name.resize(name.size() - domain.size());
  return name == "localhost" || (!name.empty() && name == plainName(settings_.value("HOSTNAME")));
}

void IpStack::dns(antEnvMsg* message, Endpoint& endpoint) {
  auto* base = static_cast<DNSEndpointBaseMsg*>(message);
  base->error = DNS_SUCCESS;
  const auto answer = [&](auto* query, bool found) {
    const auto servers = settings_.nameServers();
    query->server_address = servers.empty() ? IPAddress() : servers[0];
    query->n_address = found ? 1 : 0;
    query->n_alias = 0;
    if (!found) base->error = DNS_HOST_NOT_FOUND;
    endpoint.found.clear();
    if (found) endpoint.found.push_back(query->host_address);
  };
  switch (message->dstOperation) {
    case DNSEndpoint_Operation_SetServerAddresses: {
      auto* set = static_cast<DNSEndpointSetServerAddressesMsg*>(base);
      if (set->nscount < 0 || set->nscount > MAXNS)
        base->error = DNS_FAIL;
      else
        settings_.setNameServers({set->addrList, set->addrList + set->nscount});
      return;
    }
    case DNSEndpoint_Operation_GetServerAddresses: {
      auto* get = static_cast<DNSEndpointGetServerAddressesMsg*>(base);
      const auto servers = settings_.nameServers();
      get->nscount = static_cast<int32>(servers.size());
      std::copy(servers.begin(), servers.end(), get->addrList);
      return;
    }
    case DNSEndpoint_Operation_SetDefaultDomainName:
      settings_.set("DNS_DEFDNAME", static_cast<DNSEndpointSetDefaultDomainNameMsg*>(base)->name);
      return;
    case DNSEndpoint_Operation_GetDefaultDomainName:
      btr_copy_name(static_cast<DNSEndpointGetDefaultDomainNameMsg*>(base)->name,
                    settings_.value("DNS_DEFDNAME").c_str());
      return;
    case DNSEndpoint_Operation_GetHostByName: {
      auto* query = static_cast<DNSEndpointGetHostByNameMsg*>(base);
      query->name[MAXDNAME - 1] = '\0';
      const std::string name = plainName(query->name);
      bool found = readAddress(name, query->host_address);
      if (!found && isOwnName(name)) {
        query->host_address = IPAddress(loopbackAddress);
        found = true;
      }
      return answer(query, found);
    }
    case DNSEndpoint_Operation_GetHostByAddr: {
      auto* query = static_cast<DNSEndpointGetHostByAddrMsg*>(base);
      const bool found = query->host_address.InLoop() != 0;
      btr_copy_name(query->name, found ? "localhost" : "");
      return answer(query, found);
    }
    case DNSEndpoint_Operation_GetAddress: {
      auto* get = static_cast<DNSEndpointGetAddressMsg*>(base);
      if (get->index < 0 || static_cast<std::size_t>(get->index) >= endpoint.found.size())
        base->error = DNS_INDEX_INVALID;
      else
        get->address = endpoint.found[static_cast<std::size_t>(get->index)];
      return;
    }
    case DNSEndpoint_Operation_GetAlias:
      base->error = DNS_INDEX_INVALID;
      return;
    case DNSEndpoint_Operation_Close:
      endpoint.found.clear();
      return;
    default:
      base->error = DNS_OPERATION_UNKNOWN;
  }
}

}  // namespace btr::openr
