#define OPENR_STUBGEN
#include <MCOOP.h>
#include <OPENR/core_macro.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <ant.h>
#include "CardInfo.h"
#include "entry.h"
CardInfo::CardInfo() {}
OStatus CardInfo::DoInit(const OSystemEvent& e) { NewComData; SetComData; 
    OBootParam* p = (OBootParam*)e.Param(); OSYSPRINT(("boot reason %d stick %d of %d\n", e.Reason(), p ? p->memoryStickStatus : 99, e.ParamSize()));
    return oSUCCESS; }
OStatus CardInfo::DoStart(const OSystemEvent&) {
    ASSERT_TO_ALL_OBSERVER;
    EtherDriverGetMACAddressMsg mac;
    if (ERA201D1_GetMACAddress(&mac) == ETHER_OK) Show(mac);
    cout << "as text " << mac.address << " " << etherStatusStr(mac.status) << endl;
    EtherDriverGetStatisticsMsg st; ERA201D1_GetEtherStatistics(&st); OSYSPRINT(("errors %d\n", st.statistics.fcsErrorCount + st.statistics.frameTooLongCount));
    EtherDriverGetWLANSettingsMsg set; ERA201D1_GetWLANSettings(&set);
    OSYSPRINT(("%s channel %d ap %d wep %d %s\n", set.essid, set.channel, set.mode == ETHER_WLAN_MODE_AP, set.encryption == ETHER_WLAN_ENC_WEP, set.stationName));
    EtherDriverGetWLANStatisticsMsg ws; ERA201D1_GetWLANStatistics(&ws); OSYSPRINT(("link %d noise %d\n", ws.statistics.link, ws.statistics.noise));
    antStackRef ip = antStackRef("IPStack");
    antEnvInitGetParamMsg get("ETHER_IP"); get.Call(ip, sizeof(get));
    if (get.error == ANT_SUCCESS && get.paramType == antEnv_InitParam_String) OSYSPRINT(("[ETHER_IP] %s\n", get.value.str));
    antEnvInitGetParamMsg none("NOTHING"); none.Call(ip, sizeof(none)); OSYSPRINT(("none %d\n", none.error == ANT_REGISTRY_NO_KEY));
    ODesignDataID id; byte* data; size_t size;
    OStatus r = OPENR::FindDesignData(odesignkeywordCPUINFO, &id, &data, &size);
    OCPUInfo* cpu = (OCPUInfo*)data;
    OSYSPRINT(("cpu %d size %d %d MHz\n", r, size, cpu->pclk / 1000000));
    OPowerStatus ps; OPENR::GetPowerStatus(&ps); ps.Print();
    OSYSPRINT(("capacity %d temp %d.%d C volt %d cur %d volume %d\n", ps.remainingCapacity, ps.temperature / 10 - 273, ps.temperature % 10, ps.voltage, ps.current, ps.volume));
    OServiceEntry entry(myOID_, Extra_Entry[entryPower]);
    OSYSPRINT(("entry %d\n", entry.IsValid() && entry.GetOID() == myOID_));
    OPowerStatus watch(orsbPAUSE | orsbMOTOR_POWER, 0, opsoREMAINING_CAPACITY_NOT_NOTIFY, opsoTEMPERATURE_NOT_NOTIFY, 0, 0, 0, opsoTIME_DIF_NOT_NOTIFY, opsoVOLUME_NOT_NOTIFY);
    r = OPENR::ObservePowerStatus(watch, entry);
    OSYSPRINT(("observe %d again %d\n", r, OPENR::ObservePowerStatus(watch, entry)));
    OPENR::SetMotorPower(opowerON);
    return oSUCCESS;
}
void CardInfo::Power(void* msg) {
    const OPowerStatus* result = &((OPowerStatusMessage*)msg)->powerStatus;
    static int n = 0;
    OSYSPRINT(("power notice %d: motor %d pause %d\n", ++n, (result->robotStatus & orsbMOTOR_POWER) != 0, (result->robotStatus & orsbPAUSE) != 0));
    if (n == 1) OPENR::SetMotorPower(opowerOFF);
    if (n == 2) { OSYSPRINT(("unobserve %d\n", OPENR::UnobservePowerStatus(OServiceEntry(myOID_, Extra_Entry[entryPower])))); OPENR::Fatal(ofatalPAUSE_SW); }
}
OStatus CardInfo::DoStop(const OSystemEvent& e) { OSYSPRINT(("stop %d\n", e.Reason() == oreasonSHUTDOWN)); DEASSERT_TO_ALL_OBSERVER; return oSUCCESS; }
OStatus CardInfo::DoDestroy(const OSystemEvent&) { DeleteComData return oSUCCESS; }
void CardInfo::Show(const EtherDriverGetMACAddressMsg& msg) { OSYSPRINT(("[MAC] %02x:%02x:%02x\n", msg.address.octet[0], msg.address.octet[1], msg.address.octet[5])); }
