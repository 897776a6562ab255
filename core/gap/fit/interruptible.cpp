#include "core/gap/fit/interruptible.h"

#include <utility>

#include "core/sim/worker_pool.h"
#include "core/spec/system/cancelled.h"

namespace btr {
namespace {

thread_local Interruptible* innermost = nullptr;

}  // namespace

Interruptible::Interruptible(std::function<bool()> goesOn)
    : goesOn_(std::move(goesOn)), outer_(innermost), asked_(std::chrono::steady_clock::now()) {
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
}

}  // namespace btr
