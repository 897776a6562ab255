#pragma once
#include <chrono>
#include <functional>

namespace btr {

/// While it lives, what takes long in this thread — each replay of a segment, each job, each wait for worker
/// processes — asks `goesOn` now and then, ten times a second at most, and ends with Cancelled when that says no.
/// Worker processes do not ask: whoever waits for them does. The innermost counts. Changes no result.
class Interruptible {
 public:
  explicit Interruptible(std::function<bool()> goesOn);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  /// Throws Cancelled where the work is not to go on; does nothing where none lives.
  static void ask();

 private:
  std::function<bool()> goesOn_;
  Interruptible* outer_;
  std::chrono::steady_clock::time_point asked_;
};

}  // namespace btr
