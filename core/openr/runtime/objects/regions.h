#pragma once
#include <OPENR/OPENR.h>

namespace btr::openr {

/// Memory that the robot gives out by number.
struct RegionMemory {
  void* address = nullptr;
  std::size_t size = 0;
};

/// Zeroed memory of `size` bytes, aligned to 16; its number is not 0. Writing to one that is `readOnly` is a fault.
MemoryRegionID newRegion(std::size_t size, bool readOnly = false);
/// Nothing if there is no such region.
RegionMemory regionMemory(MemoryRegionID id);
/// It is gone once nobody holds it. False if there is none.
bool deleteRegion(MemoryRegionID id);
void holdRegion(MemoryRegionID id);
void releaseRegion(MemoryRegionID id);
/// The region that begins at `address`; 0 if none does.
MemoryRegionID regionAt(const void* address);

}  // namespace btr::openr
