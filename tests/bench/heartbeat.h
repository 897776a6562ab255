#pragma once
#include <execinfo.h>
#include <pthread.h>
#include <unistd.h>
#include <QTimer>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include "core/sim/bench/bench.h"

namespace btr::bench {

/// Beats every millisecond in the window's event loop and keeps the longest pause between two beats: for so long the
/// window would not have answered. Beside it the processor time that its thread used meanwhile: on a machine with other
/// work the pause is longer than that.
class Heartbeat : public QObject {
 public:
  struct Freeze {
    double pause_ms = 0, busy_ms = 0;
    long beats = 0;
  };
  Heartbeat() {
    timer_.setTimerType(Qt::PreciseTimer);
    timer_.setInterval(1);
    connect(&timer_, &QTimer::timeout, this, &Heartbeat::beat);
    timer_.start();
    begin();
  }
  void begin() {
    longest_ = {};
    last_ = wall_ms();
    cpu_ = busy_ms();
  }
  /// The longest pause since begin(), and the most processor time between two beats.
  Freeze longest() {
    beat();
    return longest_;
  }
  double last_ms() const { return last_; }
  static double wall_ms() {
    return 1e-6 * static_cast<double>(std::chrono::steady_clock::now().time_since_epoch().count());
  }

 private:
  static double busy_ms() { return 1e3 * threadSeconds(); }
  void beat() {
    const double wall = wall_ms(), cpu = busy_ms();
    longest_.pause_ms = std::max(longest_.pause_ms, wall - last_);
    longest_.busy_ms = std::max(longest_.busy_ms, cpu - cpu_);
    ++longest_.beats;
    last_ = wall;
    cpu_ = cpu;
  }
  QTimer timer_;
  Freeze longest_;
  std::atomic<double> last_ = 0;
  double cpu_ = 0;
};

/// Writes to stderr, again and again, what the window's thread is doing while it has not beaten for `limit_ms`.
class FreezeWitness {
 public:
  FreezeWitness(const Heartbeat& heart, double limit_ms) {
    std::signal(SIGUSR1, [](int) {
      void* frames[60];
      const int count = backtrace(frames, 60);
      backtrace_symbols_fd(frames, count, STDERR_FILENO);
      static constexpr char end[] = "--\n";
      if (write(STDERR_FILENO, end, sizeof end - 1) < 0) return;
    });
    watcher_ = std::thread([this, &heart, limit_ms, window = pthread_self()] {
      while (!over_) {
        std::this_thread::sleep_for(std::chrono::milliseconds(4));
        if (Heartbeat::wall_ms() - heart.last_ms() >= limit_ms) pthread_kill(window, SIGUSR1);
      }
    });
  }
  ~FreezeWitness() {
    over_ = true;
    watcher_.join();
  }
  FreezeWitness(const FreezeWitness&) = delete;
  FreezeWitness& operator=(const FreezeWitness&) = delete;

 private:
  std::atomic<bool> over_ = false;
  std::thread watcher_;
};

}  // namespace btr::bench
