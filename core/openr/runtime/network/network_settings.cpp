#include "core/openr/runtime/network/network_settings.h"

#include <DNSEndpointMsg.h>
#include <arpa/inet.h>

#include <cctype>
#include <fstream>

#include "core/openr/runtime/objects/system.h"
#include "core/openr/stick_config.h"

namespace btr::openr {
namespace {

std::string serverKey(std::size_t number) { return "DNS_SERVER_" + std::to_string(number); }

void trim(std::string& text) {
  const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
  while (!text.empty() && blank(text.back())) text.pop_back();
  std::size_t first = 0;
  while (first < text.size() && blank(text[first])) ++first;
  text.erase(0, first);
}

}  // namespace

bool readAddress(const std::string& text, IPAddress& address) {
  in_addr number{};
  if (inet_pton(AF_INET, text.c_str(), &number) != 1) return false;
  address = IPAddress(ntohl(number.s_addr));
  return true;
}

NetworkSettings::NetworkSettings(const std::string& stick) {
  const OwnAccess own;
  std::ifstream in(onStick(stick, "/MS/OPEN-R/SYSTEM/CONF/WLANCONF.TXT"));
  for (std::string line; std::getline(in, line);) {
    line.resize(std::min(line.size(), line.find('#')));
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos) continue;
    std::string key = line.substr(0, equals), value = line.substr(equals + 1);
    trim(key);
    trim(value);
    if (!key.empty()) values_[key] = value;
  }
}

std::string NetworkSettings::value(const std::string& key) const {
  const auto at = values_.find(key);
  return at == values_.end() ? "" : at->second;
}

std::vector<IPAddress> NetworkSettings::nameServers() const {
  std::vector<IPAddress> servers;
  for (std::size_t number = 1; number <= MAXNS; ++number) {
    IPAddress address;
    if (readAddress(value(serverKey(number)), address)) servers.push_back(address);
  }
  return servers;
}

void NetworkSettings::setNameServers(const std::vector<IPAddress>& servers) {
  for (std::size_t i = 0; i < MAXNS; ++i) {
    char text[16];
    values_.erase(serverKey(i + 1));
    if (i < servers.size()) values_[serverKey(i + 1)] = IPAddress(servers[i]).GetAsString(text);
  }
}

}  // namespace btr::openr
