#pragma once
#include <atomic>

#include "core/cluster/coordinator.h"

namespace btr::test {

inline const std::atomic<bool> goOn{false};

/// A rank by itself with so many.
inline CoordinatorOptions withForemen(int foremen) {
  CoordinatorOptions options;
  options.foremen = foremen;
  return options;
}

}  // namespace btr::test
