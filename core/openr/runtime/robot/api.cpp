// The calls of OPENR:: and the small ones around them.
#include <AnalyzerAPI.h>
#include <MCOOP.h>
#include <OPENR/OCalendarTime.h>
#include <OPENR/OFbkImage.h>
#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <SystemTime.h>
#include <Time_a.h>
#include <apsys.h>
#include <malloc.h>

#include <cstdarg>
#include <cstring>
#include <iostream>

#include "core/openr/runtime/objects/regions.h"
#include "core/openr/runtime/objects/system.h"
#include "core/openr/runtime/robot/services.h"
#include "core/openr/runtime/robot/vectors.h"

using btr::openr::deleteRegion;
using btr::openr::JointGain;
using btr::openr::newRegion;
using btr::openr::regionMemory;
using btr::openr::Services;
using btr::openr::System;

namespace {

constexpr std::size_t mostInVector = 1000, mostSoundBytes = 1u << 24;

Services& services() { return System::instance().services(); }

template <class T>
OStatus newVector(std::size_t bytes, MemoryRegionID* memID, T** baseAddr) {
  if (memID == nullptr || baseAddr == nullptr) return oINVALID_ARG;
  *memID = newRegion(bytes);
  if (*memID == 0) return oNO_MEMORY;
  *baseAddr = static_cast<T*>(regionMemory(*memID).address);
  return oSUCCESS;
}

OStatus deleteVector(MemoryRegionID memID) { return deleteRegion(memID) ? oSUCCESS : oINVALID_DATA_VECTOR_ID; }

OStatus giveGain(OPrimitiveID id, bool byDefault, word* pg, word* ig, word* dg, word* ps, word* is, word* ds) {
  JointGain gain;
  const OStatus status = services().gain(id, byDefault, &gain);
  if (status != oSUCCESS) return status;
  *pg = gain.p;
  *ig = gain.i;
  *dg = gain.d;
  *ps = gain.pShift;
  *is = gain.iShift;
  *ds = gain.dShift;
  return oSUCCESS;
}

}  // namespace

namespace OPENR {

OStatus OpenPrimitive(const char* locator, OPrimitiveID* primitiveID) {
  return locator == nullptr ? oINVALID_ARG : services().openPrimitive(locator, primitiveID);
}
OStatus ClosePrimitive(OPrimitiveID primitiveID) { return services().closePrimitive(primitiveID); }
OStatus ControlPrimitive(OPrimitiveID primitiveID, OPrimitiveRequest request, void* param, size_t paramSize,
                         void* result, size_t resultSize) {
  return services().control(primitiveID, request, param, paramSize, result, resultSize);
}

OStatus NewCommandVectorData(size_t numCommands, MemoryRegionID* memID, OCommandVectorData** baseAddr) {
  if (numCommands == 0 || numCommands > mostInVector) return oINVALID_ARG;
  const OStatus status = newVector(btr::openr::commandVectorBytes(numCommands), memID, baseAddr);
  if (status == oSUCCESS) btr::openr::initCommandVector(*baseAddr, *memID, numCommands);
  return status;
}
OStatus DeleteCommandVectorData(MemoryRegionID memID) { return deleteVector(memID); }

OStatus NewSoundVectorData(size_t numSounds, size_t dataSize, MemoryRegionID* memID, OSoundVectorData** baseAddr) {
  if (numSounds == 0 || numSounds > mostInVector || dataSize > mostSoundBytes) return oINVALID_ARG;
  const OStatus status = newVector(btr::openr::soundVectorBytes(numSounds, dataSize), memID, baseAddr);
  if (status == oSUCCESS) btr::openr::initSoundVector(*baseAddr, *memID, numSounds, dataSize);
  return status;
}
OStatus DeleteSoundVectorData(MemoryRegionID memID) { return deleteVector(memID); }

OStatus NewCdtVectorData(MemoryRegionID* memID, OCdtVectorData** baseAddr) {
  const OStatus status = newVector(sizeof(OCdtVectorData), memID, baseAddr);
  if (status == oSUCCESS) btr::openr::initCdtVector(*baseAddr, *memID);
  return status;
}
OStatus DeleteCdtVectorData(MemoryRegionID memID) { return deleteVector(memID); }
OStatus SetCdtVectorData(MemoryRegionID memID) { return services().setColours(memID); }

OStatus NewSensorFrameVectorData(size_t numSensors, MemoryRegionID* memID, OSensorFrameVectorData** baseAddr) {
  if (numSensors == 0 || numSensors > mostInVector) return oINVALID_ARG;
  const OStatus status = newVector(btr::openr::sensorVectorBytes(numSensors), memID, baseAddr);
  if (status == oSUCCESS) btr::openr::initSensorVector(*baseAddr, *memID, numSensors);
  return status;
}
OStatus DeleteSensorFrameVectorData(MemoryRegionID memID) { return deleteVector(memID); }

OStatus NewFbkImageVectorData(MemoryRegionID* memID, OFbkImageVectorData** baseAddr) {
  const auto& design = System::instance().design;
  const OStatus status =
      newVector(btr::openr::imageVectorBytes(design.imageWidth, design.imageHeight), memID, baseAddr);
  if (status == oSUCCESS) btr::openr::initImageVector(*baseAddr, *memID, design.imageWidth, design.imageHeight);
  return status;
}
OStatus DeleteFbkImageVectorData(MemoryRegionID memID) { return deleteVector(memID); }

OStatus EnableJointGain(OPrimitiveID primitiveID) { return services().enableGain(primitiveID, true); }
OStatus DisableJointGain(OPrimitiveID primitiveID) { return services().enableGain(primitiveID, false); }
OStatus SetJointGain(OPrimitiveID primitiveID, word pg, word ig, word dg, word ps, word is, word ds) {
  return services().setGain(primitiveID, {pg, ig, dg, ps, is, ds});
}
OStatus RegisterDefaultJointGain(OPrimitiveID primitiveID, word pg, word ig, word dg, word ps, word is, word ds) {
  return services().registerDefaultGain(primitiveID, {pg, ig, dg, ps, is, ds});
}
OStatus GetJointGain(OPrimitiveID primitiveID, word* pg, word* ig, word* dg, word* ps, word* is, word* ds) {
  return giveGain(primitiveID, false, pg, ig, dg, ps, is, ds);
}
OStatus GetDefaultJointGain(OPrimitiveID primitiveID, word* pg, word* ig, word* dg, word* ps, word* is, word* ds) {
  return giveGain(primitiveID, true, pg, ig, dg, ps, is, ds);
}
OStatus SetDefaultJointGain(OPrimitiveID primitiveID) { return services().applyDefaultGain(primitiveID); }
OStatus GetJointValue(OPrimitiveID primitiveID, OJointValue* value) {
  return services().jointValue(primitiveID, value);
}
OStatus GetSensorValue(OPrimitiveID primitiveID, OSensorValue* value) {
  return services().sensorValue(primitiveID, value);
}

OStatus NewSyncKey(OVRSyncKey* key) { return services().keys.make(key); }
OStatus CancelSyncKey(OVRSyncKey key) { return services().keys.cancel(key); }
OStatus DivideSyncKey(OVRSyncKey key, OVRSyncKey* key1, OVRSyncKey* key2) {
  return services().keys.divide(key, key1, key2);
}

OStatus SetMotorPower(OPower power) {
  services().setMotorPower(power);
  return oSUCCESS;
}
OStatus Shutdown(const OBootCondition&) {
  System::instance().shutDown();
  return oSUCCESS;
}
OStatus GetBootCondition(OBootCondition* bootCondition) {
  *bootCondition = OBootCondition(obcbPAUSE_SW);
  return oSUCCESS;
}
OStatus GetPowerStatus(OPowerStatus* powerStatus) {
  *powerStatus = services().powerStatus();
  return oSUCCESS;
}
OStatus ObservePowerStatus(const OPowerStatus& notifyStatus, const OServiceEntry& entry) {
  return services().observePower(notifyStatus, entry);
}
OStatus UnobservePowerStatus(const OServiceEntry& entry) { return services().unobservePower(entry); }

OStatus FindDesignData(const char* keyword, ODesignDataID* dataID, byte** data, size_t* size) {
  return services().findDesignData(keyword, dataID, data, size);
}
OStatus DeleteDesignData(ODesignDataID dataID) { return services().deleteDesignData(dataID); }
OStatus GetRobotDesign(char* robotDesign) {
  std::strcpy(robotDesign, System::instance().design.name.c_str());
  return oSUCCESS;
}
OStatus GetMemoryStickStatus(OMemoryStickStatus* status) {
  *status = omemorystickWRITABLE;
  return oSUCCESS;
}

OStatus Fatal(OFatal fatal) {
  System& system = System::instance();
  if (fatal == ofatalPAUSE_SW) return Shutdown(OBootCondition(obcbPAUSE_SW));
  if (auto* object = system.current())
    system.end(btr::openr::Ended::Why::crash, object->name, object->methodName(object->running.selector),
               "it called OPENR::Fatal(" + std::to_string(fatal) + ")");
  return oSUCCESS;
}

OStatus SetTime(const OTime& time) {
  services().setTime(time);
  return oSUCCESS;
}
OStatus GetTime(OTime* time) {
  *time = services().time();
  return oSUCCESS;
}
OStatus SetTimeDifference(sbyte timeDifference) {
  services().setTimeDifference(timeDifference);
  return oSUCCESS;
}
OStatus GetTimeDifference(sbyte* timeDifference) {
  *timeDifference = services().timeDifference();
  return oSUCCESS;
}
OStatus SetVolumeSwitch(OVolumeSwitch volSW) {
  if (volSW > ovolumeSW3) return oINVALID_ARG;
  services().setVolume(volSW);
  return oSUCCESS;
}
OStatus GetVolumeSwitch(OVolumeSwitch* volSW) {
  *volSW = static_cast<OVolumeSwitch>(services().volume() < 0 ? ovolumeSW3 : services().volume());
  return oSUCCESS;
}

// There is no other middleware to tell of.
OStatus RequireMWInfo(MWIID) { return oNOT_SUPPORTED; }
OStatus CancelMWInfo(MWIID) { return oNOT_SUPPORTED; }
OStatus IsMWInfoRequired(MWIID, bool* required) {
  *required = false;
  return oSUCCESS;
}

}  // namespace OPENR

// ---- console ----------------------------------------------------------------------------------------------------

namespace {

constexpr std::size_t longestLine = 243;

void print(const std::string& begin, const char* format, va_list arguments, bool line) {
  char text[longestLine + 1];
  vsnprintf(text, sizeof(text), format, arguments);
  const std::string all = begin + text + (line ? "\n" : "");
  System& system = System::instance();
  system.write(system.current(), all.data(), all.size());
}

}  // namespace

void OSyslog1(longword priority, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  auto* object = System::instance().current();
  char begin[64];
  std::snprintf(begin, sizeof(begin), "[oid:%08lx,prio:%u] ",
                reinterpret_cast<unsigned long>(object == nullptr ? nullptr : object->oid.GetAddress()), priority);
  print(begin, format, arguments, true);
  va_end(arguments);
}

void OSysprint(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  print("", format, arguments, false);
  va_end(arguments);
}

std::ostream& operator<<(std::ostream& out, const OID& id) { return out << "OID(" << id.GetAddress() << ")"; }
std::ostream& operator<<(std::ostream& out, const OServiceEntry& entry) {
  return out << entry.oid << ", entry " << entry.selector;
}

void OPowerStatus::Print() const {
  OSysprint("robotStatus %08x batteryStatus %04x\n", robotStatus, batteryStatus);
  OSysprint("remainingCapacity %d temperature %d volume %d\n", remainingCapacity, temperature, volume);
}

void OPowerStatus::PrintDetail() const {
  Print();
  OSysprint("fullyChargedCapacity %d voltage %d current %d timeDif %d\n", fullyChargedCapacity, voltage, current,
            timeDif);
}

// ---- pictures ---------------------------------------------------------------------------------------------------

OFbkImage::OFbkImage(OFbkImageInfo* info, byte* data, OFbkImageBand band)
    : pixels_(nullptr), tag_(nullptr), width_(0), height_(0), skip_(0) {
  // Places of the bands Y, Cr, Cb, CDT, LH, HL, HH in a row.
  static const int places[] = {0, 1, 2, 0, 3, 4, 5};
  if (info == nullptr || data == nullptr || band < ofbkimageBAND_Y || band > ofbkimageBAND_Y_HH) return;
  const int bands = info->type == odataFBK_CDT ? 1 : (info->type == odataFBK_YCrCb_HPF ? 6 : 3);
  if ((info->type == odataFBK_CDT) != (band == ofbkimageBAND_CDT) || places[band] >= bands) return;
  width_ = static_cast<int>(info->width);
  height_ = static_cast<int>(info->height);
  skip_ = (bands - 1) * width_;
  pixels_ = data + places[band] * width_;
  tag_ = data + static_cast<std::size_t>(height_ - 1) * static_cast<std::size_t>(bands * width_);
}

byte OFbkImage::ColorFrequency(OCdtChannel chan) const {
  if (tag_ == nullptr) return 0;
  for (int i = 0; i < ocdtNUM_CHANNELS; ++i)
    if (chan == (1u << i)) return tag_[i < 4 ? 8 + i : i];
  return 0;
}

longword OFbkImage::GetTagInfo() {
  longword value = 0;
  if (tag_ != nullptr) std::memcpy(&value, tag_, sizeof(value));
  return value;
}

// ---- time -------------------------------------------------------------------------------------------------------

sError GetSystemTime(structSystemTime* time) {
  const auto now = System::instance().readClock_us();
  time->seconds = static_cast<longword>(now / 1000000);
  time->useconds = static_cast<longword>(now % 1000000);
  return sSUCCESS;
}
sError GetSystemTime(SystemTime* time) { return GetSystemTime(static_cast<structSystemTime*>(time)); }

std::ostream& operator<<(std::ostream& out, const OTime& time) { return out << OCalendarTime(time); }

OStatus OCalendarTime::Set(const OTime& time) {
  const time_t seconds = Services::startYear_s + time.GetLocalTime();
  struct tm parts {};
  if (gmtime_r(&seconds, &parts) == nullptr || parts.tm_year < otimeSTART_YEAR - 1900 ||
      parts.tm_year > otimeSTART_YEAR - 1900 + 255)
    return oOUT_OF_RANGE;
  year_ = parts.tm_year + 1900 - otimeSTART_YEAR;
  month_ = parts.tm_mon + 1;
  day_ = parts.tm_mday;
  hour_ = parts.tm_hour;
  min_ = parts.tm_min;
  sec_ = parts.tm_sec;
  dow_ = parts.tm_wday;
  timeDif_ = time.GetTimeDif();
  return oSUCCESS;
}

OStatus OCalendarTime::Set(int year, int month, int day, int hour, int minute, int second) {
  struct tm parts {};
  parts.tm_year = year < otimeSTART_YEAR ? year + otimeSTART_YEAR - 1900 : year - 1900;
  parts.tm_mon = month - 1;
  parts.tm_mday = day;
  parts.tm_hour = hour;
  parts.tm_min = minute;
  parts.tm_sec = second;
  const struct tm given = parts;
  OTime time;
  time.SetTimeDif(timeDif_);
  time.SetLocalTime(timegm(&parts) - Services::startYear_s);
  const bool same = given.tm_mon == parts.tm_mon && given.tm_mday == parts.tm_mday && given.tm_hour == parts.tm_hour &&
                    given.tm_min == parts.tm_min && given.tm_sec == parts.tm_sec;
  return same ? Set(time) : oINVALID_ARG;
}

time_t OCalendarTime::GetTime() const {
  struct tm parts {};
  parts.tm_year = otimeSTART_YEAR + year_ - 1900;
  parts.tm_mon = month_ - 1;
  parts.tm_mday = day_;
  parts.tm_hour = hour_;
  parts.tm_min = min_;
  parts.tm_sec = sec_;
  OTime time;
  time.SetTimeDif(timeDif_);
  time.SetLocalTime(timegm(&parts) - Services::startYear_s);
  return time.GetClock();
}

bool OCalendarTime::ProperDate() const {
  static const int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  if (year_ < 0 || month_ < 1 || month_ > 12) return false;
  const int last = month_ == 2 && LeapYear(GetYear()) ? 29 : days[month_ - 1];
  return day_ >= 1 && day_ <= last && hour_ >= 0 && hour_ <= 23 && min_ >= 0 && min_ <= 59 && sec_ >= 0 && sec_ <= 59;
}

OStatus OCalendarTime::CorrectDayOfTheWeek() {
  if (!ProperDate()) return oINVALID_ARG;
  OCalendarTime same(*this);
  same.Set(OTime(GetTime(), timeDif_));
  dow_ = same.dow_;
  return oSUCCESS;
}

void OCalendarTime::Print() const {
  OSysprint("%04d-%02d-%02d %02d:%02d:%02d\n", GetYear(), month_, day_, hour_, min_, sec_);
}

void OCalendarTime::Sprint(char* text) const {
  std::sprintf(text, "%04d-%02d-%02d %02d:%02d:%02d", GetYear() % 10000, month_ % 100, day_ % 100, hour_ % 100,
               min_ % 100, sec_ % 100);
}

void OCalendarTime::RFC2822(char* text) const {
  static const char* const days[] = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
  static const char* const months[] = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                       "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  const int ahead = timeDif_ == otimeTIME_DIF_UNDEF ? 0 : timeDif_;
  const bool proper = ProperDate() && dow_ >= 0 && dow_ <= 6;
  std::sprintf(text, "%s, %02d %s %04d %02d:%02d:%02d %c%02d00", proper ? days[dow_] : "???", day_ % 100,
               proper ? months[month_ - 1] : "???", GetYear() % 10000, hour_ % 100, min_ % 100, sec_ % 100,
               ahead < 0 ? '-' : '+', ahead < 0 ? -ahead : ahead);
}

std::ostream& operator<<(std::ostream& out, const OCalendarTime& time) {
  char text[64];
  std::snprintf(text, sizeof(text), "%04d-%02d-%02d %02d:%02d:%02d", time.GetYear(), time.GetMonth(), time.GetDay(),
                time.GetHour(), time.GetMinute(), time.GetSecond());
  return out << text;
}

RelativeTime ConvertToRelativeTime(const SystemTime& time) {
  SystemTime now;
  GetSystemTime(&now);
  const long long us = (static_cast<long long>(time.seconds) - now.seconds) * 1000000 + time.useconds - now.useconds;
  return us < 0 ? RelativeTime()
                : RelativeTime(static_cast<longword>(us / 1000000), static_cast<longword>(us % 1000000 / 1000));
}

SystemTime ConvertToSystemTime(const RelativeTime& time) {
  SystemTime now;
  GetSystemTime(&now);
  const long long us = static_cast<long long>(now.seconds) * 1000000 + now.useconds +
                       static_cast<long long>(time.sec) * 1000000 + time.msec * 1000LL;
  return SystemTime(static_cast<longword>(us / 1000000), static_cast<longword>(us % 1000000));
}

// ---- memory and objects -----------------------------------------------------------------------------------------

sError NewRegion(size_t size, void** address) {
  MemoryRegionID id;
  return NewSharedMemoryRegion(size, MEMPROTINFO_RW, &id, address);
}

sError NewSharedMemoryRegion(size_t size, MemoryProtectionInfo info, MemoryRegionID* id, void** address) {
  constexpr std::size_t largest = 1u << 30;
  if (address == nullptr || id == nullptr || size == 0 || size > largest) return sINVALID_ARG;
  if (info != MEMPROTINFO_R && info != MEMPROTINFO_RW) return sINVALID_ARG;
  const MemoryRegionID made = newRegion(size, info == MEMPROTINFO_R);
  if (made == 0) return sNO_MEMORY;
  *address = regionMemory(made).address;
  *id = made;
  return sSUCCESS;
}

sError AttachMemoryRegion(MemoryRegionID id, MemoryProtectionInfo, void** address) {
  const auto memory = regionMemory(id);
  if (memory.address == nullptr || address == nullptr) return sINVALID_ARG;
  *address = memory.address;
  return sSUCCESS;
}

sError DetachMemoryRegion(MemoryRegionID id) { return regionMemory(id).address == nullptr ? sINVALID_ARG : sSUCCESS; }

sError AllowToAttachMemoryRegion(MemoryRegionID id, MemoryProtectionInfo, OID, bool) { return DetachMemoryRegion(id); }

sError DeleteRegion(void* address) { return deleteRegion(btr::openr::regionAt(address)) ? sSUCCESS : sINVALID_ARG; }
sError DeleteSharedMemoryRegion(MemoryRegionID id) { return deleteRegion(id) ? sSUCCESS : sINVALID_ARG; }

sError GetPageSize(longword* bytes) {
  constexpr longword ofTheRobot = 4096;
  if (bytes == nullptr) return sINVALID_ARG;
  *bytes = ofTheRobot;
  return sSUCCESS;
}

AnalyzerError AnalyzerGetSizeOfFreeMemory(size_t* bytes) {
  constexpr std::size_t ofTheRobot = std::size_t{64} << 20, always = std::size_t{1} << 20;
  if (bytes == nullptr) return azrFAIL;
  const std::size_t held = mallinfo2().uordblks;
  *bytes = held + always < ofTheRobot ? ofTheRobot - held : always;
  return azrSUCCESS;
}

sError WhoAmI(OID* id) {
  auto* object = System::instance().current();
  if (object == nullptr) return sFAIL;
  *id = object->oid;
  return sSUCCESS;
}

extern "C" void Prologue() {}

// For programs with a new and a delete of their own: see mkbin.
extern "C" void* btr_openr_new(std::size_t bytes) { return ::operator new(bytes); }
extern "C" void btr_openr_delete(void* memory) { ::operator delete(memory); }
