#include "core/openr/runtime/objects/region_pool.h"

#include "core/openr/runtime/objects/regions.h"

namespace btr::openr {

RCRegion* RegionPool::take(std::size_t size) {
  for (RCRegion* region : regions_)
    if (region->NumberOfReference() == 1 && region->Size() == size) return region;
  const MemoryRegionID id = newRegion(size);
  regions_.push_back(new RCRegion(id, 0, regionMemory(id).address, size));
  return regions_.back();
}

}  // namespace btr::openr
