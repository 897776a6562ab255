#pragma once
#include <OPENR/OPENR.h>

#include <cstdint>
#include <map>
#include <memory>

namespace btr::openr {

class System;

/// Messages that objects asked for at a later time.
class Timers {
 public:
  /// The first at `first_us` of simulated time, the others `period_us` apart; 0: only once. `message` has `size` bytes.
  longword set(const OServiceEntry& to, std::int64_t first_us, std::int64_t period_us, const void* message,
               std::size_t size);
  /// False if there is none.
  bool cancel(longword number) { return timers_.erase(number) > 0; }
  /// Sends what is due, at most one message of each timer.
  void send(System& system);

 private:
  struct Timer {
    OServiceEntry to;
    std::int64_t due_us, period_us;
    std::shared_ptr<void> message;
    std::size_t size;
  };
  std::map<longword, Timer> timers_;
  longword next_ = 1;
};

}  // namespace btr::openr
