#include "core/gap/fit/interruptible.h"

#include <utility>

#include "core/sim/worker_pool.h"
#include "core/spec/system/cancelled.h"

namespace btr {
namespace {

thread_local Interruptible* innermost = nullptr;
thread_local int unfinished = 0;  ///< calls of unlessEnough

/// Ends the work of the innermost of those.
struct Enough {};

}  // namespace

Interruptible::Interruptible(std::function<bool()> goesOn, std::function<bool()> isEnough)
    : goesOn_(std::move(goesOn)),
      isEnough_(std::move(isEnough)),
      outer_(innermost),
      asked_(std::chrono::steady_clock::now()) {
  innermost = this;
}

Interruptible::~Interruptible() { innermost = outer_; }

void Interruptible::ask() {
  constexpr std::chrono::milliseconds between{100};
  if (innermost == nullptr || WorkerPool::inWorker()) return;
  const auto now = std::chrono::steady_clock::now();
  if (now - innermost->asked_ < between) return;
  innermost->asked_ = now;
  if (!innermost->goesOn_()) throw Cancelled{};
  if (unfinished > 0 && innermost->isEnough_ && innermost->isEnough_()) throw Enough{};
}

bool unlessEnough(const std::function<void()>& work) {
  struct Depth {
    Depth() { ++unfinished; }
    ~Depth() { --unfinished; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;
  } const depth;
  try {
    work();
    return true;
  } catch (const Enough&) {
    return false;
  }
}

}  // namespace btr
