// What the wireless network card is set to, and how well it hears.
#ifndef BTR_OPENR_WLANDRIVERMSG_H
#define BTR_OPENR_WLANDRIVERMSG_H

#include <EtherTypes.h>

typedef enum { ETHER_WLAN_MODE_ADHOC = 0, ETHER_WLAN_MODE_AP = 1 } EtherWLANMode;
typedef enum { ETHER_WLAN_ENC_OFF = 0, ETHER_WLAN_ENC_WEP = 1 } EtherWLANEncryption;
typedef enum {
  ETHER_WLAN_RATE_1MB = 0,
  ETHER_WLAN_RATE_2MB = 1,
  ETHER_WLAN_RATE_5_5MB = 2,
  ETHER_WLAN_RATE_11MB = 3,
  ETHER_WLAN_RATE_AUTO = 4
} EtherWLANRate;
typedef enum {
  ETHER_WLAN_DENSITY_LOW = 0,
  ETHER_WLAN_DENSITY_MED = 1,
  ETHER_WLAN_DENSITY_HIGH = 2
} EtherWLANSensitivity;

#define ETHER_WLAN_ESSID_MAX 32
#define ETHER_WLAN_STATIONNAME_MAX 32
#define ETHER_WLAN_ENC_MAX 5
#define ETHER_WLAN_ENC_128_MAX 13

typedef struct {
  uint8 link; /* percent, as the next two */
  uint8 signal;
  uint8 noise;
  uint32 invalidIDCount;
  uint32 invalidEncCount;
  uint32 invalidMiscCount;
} EtherWLANStatistics;

typedef struct EtherDriverGetWLANSettingsMsg {
  uint32 port;
  EtherWLANMode mode;
  char essid[ETHER_WLAN_ESSID_MAX + 1];
  char stationName[ETHER_WLAN_STATIONNAME_MAX + 1];
  uint32 channel;
  EtherWLANEncryption encryption;
  EtherWLANRate rate;
  uint32 rts;
  uint32 fragmentation;
  EtherWLANSensitivity sensitivity;
  EtherStatus status;
} EtherDriverGetWLANSettingsMsg;

typedef struct EtherDriverGetWLANStatisticsMsg {
  uint32 port;
  EtherWLANStatistics statistics;
  EtherStatus status;
} EtherDriverGetWLANStatisticsMsg;

#endif
