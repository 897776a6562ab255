// Power and who wants to be told of it, time, design data.
#include <OPENR/OPENRMessages.h>

#include <algorithm>
#include <utility>

#include "core/openr/runtime/objects/system.h"
#include "core/openr/runtime/robot/gunzip.h"
#include "core/openr/runtime/robot/services.h"

namespace btr::openr {
namespace {

/// As Sony published it.
OCPUInfo processorOf(const std::string& design) {
  constexpr longword bus_hz = 96000000, fast_hz = 576000000, slow_hz = 192000000;
  OCPUInfo info{};
  info.sclk = bus_hz;
  info.pclk = design == "ERS-7" ? fast_hz : slow_hz;
  return info;
}

}  // namespace

void Services::setMotorPower(bool on) {
  motorPower_ = on;
  motorPowerChanged_ = true;
}

OPowerStatus Services::powerStatus() const {
  const PowerReading& power = system_.sensed().power;
  OPowerStatus status;
  status.robotStatus = orsbBATTERY_CONNECTED | orsbOPEN_R_POWER_GOOD;
  if (power.pausePressed) status.robotStatus |= orsbPAUSE;
  if (motorPower_) status.robotStatus |= orsbMOTOR_POWER;
  if (power.remaining_percent >= 95) status.robotStatus |= orsbBATTERY_CAPACITY_FULL;
  if (power.remaining_percent <= 10) status.robotStatus |= orsbBATTERY_CAPACITY_LOW;
  status.batteryStatus = obsbINITIALIZED | obsbDISCHARGING;
  if (power.remaining_percent == 0) status.batteryStatus |= obsbFULLY_DISCHARGED;
  if (power.remaining_percent <= 10) status.batteryStatus |= obsbREMAINING_CAPACITY_ALARM;
  status.remainingCapacity = power.remaining_percent;
  status.temperature = power.temperature_dk;
  status.fullyChargedCapacity = 2200;  // mAh, of the ERS-7's battery
  status.voltage = power.voltage_mv;
  status.current = power.current_ma;
  status.timeDif = timeDifference_;
  status.volume = static_cast<byte>(std::max(volume_, 0));
  return status;
}

OStatus Services::observePower(const OPowerStatus& wanted, const OServiceEntry& entry) {
  for (const PowerWatch& watch : watches_)
    if (watch.entry == entry) return oALREADY_REGISTERED;
  watches_.push_back({wanted, entry, powerStatus()});
  return oSUCCESS;
}

OStatus Services::unobservePower(const OServiceEntry& entry) {
  const auto at = std::find_if(watches_.begin(), watches_.end(), [&](const PowerWatch& w) { return w.entry == entry; });
  if (at == watches_.end()) return oNOT_REGISTERED;
  watches_.erase(at);
  return oSUCCESS;
}

/// Both edges are told, also those between two methods of one frame: who watches before the motors are switched on
/// hears of it, and some programs wait for that.
void Services::watchPower() {
  const OPowerStatus now = powerStatus();
  const auto number = [](int was, int is, int wanted, int everyChange, int never) {
    if (wanted == never || was == is) return false;
    return wanted == everyChange || (was < wanted) != (is < wanted);
  };
  for (PowerWatch& watch : watches_) {
    const OPowerStatus& w = watch.wanted;
    const OPowerStatus before = std::exchange(watch.seen, now);
    const bool tell =
        ((now.robotStatus ^ before.robotStatus) & w.robotStatus) != 0 ||
        ((now.batteryStatus ^ before.batteryStatus) & w.batteryStatus) != 0 ||
        number(before.remainingCapacity, now.remainingCapacity, w.remainingCapacity,
               opsoREMAINING_CAPACITY_NOTIFY_EVERY_CHANGE, opsoREMAINING_CAPACITY_NOT_NOTIFY) ||
        number(before.temperature, now.temperature, w.temperature, opsoTEMPERATURE_NOTIFY_EVERY_CHANGE,
               opsoTEMPERATURE_NOT_NOTIFY) ||
        number(before.timeDif, now.timeDif, w.timeDif, opsoTIME_DIF_NOTIFY_EVERY_CHANGE, opsoTIME_DIF_NOT_NOTIFY) ||
        number(before.volume, now.volume, w.volume, opsoVOLUME_NOTIFY_EVERY_CHANGE, opsoVOLUME_NOT_NOTIFY);
    if (!tell) continue;
    auto message = std::make_shared<OPowerStatusMessage>();
    message->msgType = 0;
    message->powerStatus = now;
    system_.send(watch.entry, message);
  }
}

OTime Services::time() const {
  return OTime(epoch_s - startYear_s + clockOffset_s_ + system_.readClock_us() / 1000000, timeDifference_);
}

void Services::setTime(const OTime& time) {
  clockOffset_s_ = time.GetClock() + startYear_s - epoch_s - system_.time_us() / 1000000;
  timeDifference_ = time.GetTimeDif();
}

OStatus Services::findDesignData(const std::string& keyword, ODesignDataID* id, byte** data, std::size_t* size) {
  if (keyword == odesignkeywordCPUINFO) {
    const OCPUInfo info = processorOf(system_.design.name);
    const auto* bytes = reinterpret_cast<const char*>(&info);
    return keepDesignData({bytes, bytes + sizeof(info)}, id, data, size);
  }
  const auto entry = system_.config.designData.find(keyword);
  if (entry == system_.config.designData.end()) return oNOT_FOUND;
  const OwnAccess own;
  const std::string path = onStick(system_.stick, entry->second);
  std::vector<char> content;
  if (path.empty() || !unpackedFile(path, content)) return oOPEN_FAILURE;
  if (content.empty()) return oDESIGNDATA_SIZE_ZERO;
  return keepDesignData(std::move(content), id, data, size);
}

OStatus Services::keepDesignData(std::vector<char> content, ODesignDataID* id, byte** data, std::size_t* size) {
  *id = nextDesignData_++;
  auto& kept = designData_[*id] = std::move(content);
  *data = reinterpret_cast<byte*>(kept.data());
  *size = kept.size();
  return oSUCCESS;
}

OStatus Services::deleteDesignData(ODesignDataID id) { return designData_.erase(id) > 0 ? oSUCCESS : oNOT_FOUND; }

}  // namespace btr::openr
