// The wireless network card of the robot. The simulated one has a good link, counts no errors, and is set to what
// WLANCONF.TXT says.
#ifndef BTR_OPENR_ERA201D1_H
#define BTR_OPENR_ERA201D1_H

#include <EtherDriverMsg.h>
#include <WLANDriverMsg.h>

#ifdef __cplusplus
extern "C" {
#endif
EtherStatus ERA201D1_GetMACAddress(EtherDriverGetMACAddressMsg* msg);
EtherStatus ERA201D1_GetEtherStatistics(EtherDriverGetStatisticsMsg* msg);
EtherStatus ERA201D1_GetWLANSettings(EtherDriverGetWLANSettingsMsg* msg);
EtherStatus ERA201D1_GetWLANStatistics(EtherDriverGetWLANStatisticsMsg* msg);
#ifdef __cplusplus
}
#endif

#endif
