#pragma once
#include <chrono>
#include <functional>

namespace btr {

/// While it lives, what takes long in this thread — each replay of a segment, each job, each wait for worker
/// processes — asks `goesOn` now and then, ten times a second at most, and ends with Cancelled when that says no.
/// Worker processes do not ask: whoever waits for them does. The innermost counts. Changes no
/// result but where it says that it is enough.
class Interruptible {
 public:
  /// `isEnough`: asked with it; see unlessEnough.
  explicit Interruptible(std::function<bool()> goesOn, std::function<bool()> isEnough = {});
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

  /// Throws Cancelled where the work is not to go on; does nothing where none lives.
  static void ask();

 private:
  std::function<bool()> goesOn_, isEnough_;
  Interruptible* outer_;
  std::chrono::steady_clock::time_point asked_;
};

/// Does work that is worth having unfinished. Where the innermost Interruptible says that it is enough, the work ends
/// there, and with it all that was begun in this call; false then. (Elsewhere that is not asked.)
bool unlessEnough(const std::function<void()>& work);

}  // namespace btr
