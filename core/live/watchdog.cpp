#include "core/live/watchdog.h"

#include <algorithm>
#include <utility>

namespace btr {

Watchdog::Watchdog(double patience_s, Teller hangs, Teller gaveUp)
    : patience_s_(patience_s), hangs_(std::move(hangs)), gaveUp_(std::move(gaveUp)), thread_([this] { watch(); }) {}

Watchdog::~Watchdog() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  ended_.notify_all();
  thread_.join();
}

void Watchdog::asks(const std::string& who) {
  const std::lock_guard lock(mutex_);
  who_ = who;
  since_ = Clock::now();
  told_ = 0;
}

void Watchdog::answered() {
  const std::lock_guard lock(mutex_);
  who_.clear();
}

void Watchdog::watch() {
  constexpr double least_s = 0.01, most_s = 0.25;
  const auto pause = std::chrono::duration<double>(std::clamp(patience_s_ / 4, least_s, most_s));
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, pause, [this] { return ends_; })) {
    if (who_.empty()) continue;
    const double seconds = std::chrono::duration<double>(Clock::now() - since_).count();
    const bool gives = told_ == 1 && seconds >= giveUpAfter * patience_s_;
    if (!gives && (told_ > 0 || seconds < patience_s_)) continue;
    ++told_;
    // Who answers meanwhile need not wait for what is told.
    const std::string who = who_;
    lock.unlock();
    (gives ? gaveUp_ : hangs_)(who, seconds);
    lock.lock();
  }
}

}  // namespace btr
