// The wireless network card as programs see it.
#include <ERA201D1.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>

#include "core/openr/runtime/network/ip_stack.h"
#include "core/openr/runtime/objects/system.h"
#include "core/openr/runtime/robot/services.h"

namespace {

/// Of the range that anybody may use within a network of his own.
constexpr EtherMACAddress ownAddress = {{0x02, 0x00, 0x00, 0x00, 0x00, 0x01}};
constexpr uint8 percent = 100;

const btr::openr::NetworkSettings& settings() { return btr::openr::System::instance().services().ip().settings(); }

void copyText(char* to, const std::string& from, std::size_t room) { std::snprintf(to, room, "%s", from.c_str()); }

}  // namespace

const char* etherStatusStr(EtherStatus status) { return status == ETHER_OK ? "ETHER_OK" : "ETHER_FAIL"; }

std::ostream& operator<<(std::ostream& out, const EtherMACAddress& address) {
  char text[18];
  std::snprintf(text, sizeof(text), "%02x:%02x:%02x:%02x:%02x:%02x", address.octet[0], address.octet[1],
                address.octet[2], address.octet[3], address.octet[4], address.octet[5]);
  return out << text;
}

extern "C" {

EtherStatus ERA201D1_GetMACAddress(EtherDriverGetMACAddressMsg* msg) {
  msg->port = 0;
  msg->address = ownAddress;
  return msg->status = ETHER_OK;
}

EtherStatus ERA201D1_GetEtherStatistics(EtherDriverGetStatisticsMsg* msg) {
  *msg = EtherDriverGetStatisticsMsg();
  return msg->status = ETHER_OK;
}

EtherStatus ERA201D1_GetWLANSettings(EtherDriverGetWLANSettingsMsg* msg) {
  *msg = EtherDriverGetWLANSettingsMsg();
  // APMODE 0 is from one to another, 1 by an access point, 2 as it comes.
  msg->mode = settings().value("APMODE") == "0" ? ETHER_WLAN_MODE_ADHOC : ETHER_WLAN_MODE_AP;
  copyText(msg->essid, settings().value("ESSID"), sizeof(msg->essid));
  copyText(msg->stationName, settings().value("HOSTNAME"), sizeof(msg->stationName));
  msg->channel = static_cast<uint32>(std::atoi(settings().value("CHANNEL").c_str()));
  msg->encryption = settings().value("WEPENABLE") == "1" ? ETHER_WLAN_ENC_WEP : ETHER_WLAN_ENC_OFF;
  msg->rate = ETHER_WLAN_RATE_11MB;
  msg->sensitivity = ETHER_WLAN_DENSITY_LOW;
  return msg->status = ETHER_OK;
}

EtherStatus ERA201D1_GetWLANStatistics(EtherDriverGetWLANStatisticsMsg* msg) {
  *msg = EtherDriverGetWLANStatisticsMsg();
  msg->statistics.link = msg->statistics.signal = percent;
  return msg->status = ETHER_OK;
}

}  // extern "C"
