#pragma once
#include <OPENR/RCRegion.h>

#include <vector>

namespace btr::openr {

/// Regions of one size that are used again once nobody else has a reference; more are made while all are in use.
class RegionPool {
 public:
  /// A free region of `size` bytes, its content of before still in it, or zeroes.
  RCRegion* take(std::size_t size);

 private:
  std::vector<RCRegion*> regions_;
};

}  // namespace btr::openr
