#include "core/openr/runtime/robot/timers.h"

#include <TimeEventInfo.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "core/openr/runtime/objects/system.h"
#include "core/openr/runtime/robot/services.h"

namespace btr::openr {
namespace {

/// A message has room for at least this, whatever its size.
constexpr std::size_t leastMessage = 256;

std::shared_ptr<void> copyOf(const void* message, std::size_t size) {
  std::shared_ptr<void> copy(std::calloc(1, std::max(leastMessage, size)), std::free);
  if (message != nullptr && size > 0) std::memcpy(copy.get(), message, size);
  return copy;
}

std::int64_t microseconds(const RelativeTime& time) { return std::int64_t{time.sec} * 1000000 + time.msec * 1000LL; }

}  // namespace

longword Timers::set(const OServiceEntry& to, std::int64_t first_us, std::int64_t period_us, const void* message,
                     std::size_t size) {
  timers_[next_] = {to, first_us, period_us, copyOf(message, size), size};
  return next_++;
}

void Timers::send(System& system) {
  const std::int64_t now_us = system.time_us();
  std::vector<std::pair<std::int64_t, longword>> due;
  for (const auto& [number, timer] : timers_)
    if (timer.due_us <= now_us) due.emplace_back(timer.due_us, number);
  std::sort(due.begin(), due.end());
  for (const auto& [at_us, number] : due) {
    Timer& timer = timers_.at(number);
    system.send(timer.to, copyOf(timer.message.get(), timer.size));
    if (timer.period_us == 0) {
      timers_.erase(number);
      continue;
    }
    // What was missed is not made up for.
    timer.due_us += std::max<std::int64_t>((now_us - timer.due_us) / timer.period_us, 0) * timer.period_us;
    timer.due_us += timer.period_us;
  }
}

}  // namespace btr::openr

using btr::openr::System;

sError SetTimeEvent(const TimeEventInfoWithRelativeTime* info, OID object, Selector selector, void* message,
                    size_t size, EventID* id) {
  constexpr std::size_t largest = 65536;
  if (info == nullptr || !object.IsValid() || size > largest) return sINVALID_ARG;
  const bool again = info->eventType == TimeEventInfo::Periodic;
  const std::int64_t period_us = again ? btr::openr::microseconds(info->periodicTime) : 0;
  if (again && period_us == 0) return sINVALID_ARG;
  System& system = System::instance();
  const longword number = system.services().timers.set(OServiceEntry(object, selector),
                                                       system.time_us() + btr::openr::microseconds(info->relativeTime),
                                                       period_us, message, size);
  if (id != nullptr) *id = EventID(number);
  return sSUCCESS;
}

sError CancelTimeEvent(EventID id) {
  return System::instance().services().timers.cancel(id.GetNumber()) ? sSUCCESS : sNOT_FOUND;
}
