#pragma once
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace btr {

/// Notices that somebody does not answer, from a thread of its own. Nothing can be taken from him: it only tells.
class Watchdog {
 public:
  /// Called from the watchdog's thread with who has not answered and for how long.
  using Teller = std::function<void(const std::string& who, double seconds)>;

  /// `hangs` is called once when somebody has taken longer than `patience_s`, `gaveUp` after `giveUpAfter` times that.
  Watchdog(double patience_s, Teller hangs, Teller gaveUp);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  static constexpr double giveUpAfter = 10;

  /// Somebody is asked; one at a time.
  void asks(const std::string& who);
  void answered();

 private:
  using Clock = std::chrono::steady_clock;
  void watch();

  double patience_s_;
  Teller hangs_, gaveUp_;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::string who_;  ///< "": nobody is asked
  Clock::time_point since_;
  int told_ = 0;
  bool ends_ = false;
  std::thread thread_;  ///< last: begins when all else is there
};

/// Somebody is asked as long as this lives. Without a watchdog nothing happens.
class Asked {
 public:
  Asked(Watchdog* dog, const std::string& who) : dog_(dog) {
    if (dog_) dog_->asks(who);
  }
  ~Asked() {
    if (dog_) dog_->answered();
  }
  Asked(const Asked&) = delete;
  Asked& operator=(const Asked&) = delete;

 private:
  Watchdog* dog_;
};

}  // namespace btr
