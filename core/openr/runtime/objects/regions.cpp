#include "core/openr/runtime/objects/regions.h"

#include <cstdlib>
#include <cstring>
#include <map>

namespace btr::openr {
namespace {

struct Region {
  void* address;
  std::size_t size;
  int holders = 0;
  bool deleted = false;
};

std::map<MemoryRegionID, Region>& regions() {
  static std::map<MemoryRegionID, Region> all;
  return all;
}

void freeIfUnused(MemoryRegionID id) {
  const auto at = regions().find(id);
  if (at == regions().end() || !at->second.deleted || at->second.holders > 0) return;
  std::free(at->second.address);
  regions().erase(at);
}

}  // namespace

MemoryRegionID newRegion(std::size_t size) {
  static MemoryRegionID last = 0;
  const std::size_t rounded = (size + 15) / 16 * 16;
  void* address = std::aligned_alloc(16, rounded == 0 ? 16 : rounded);
  if (address == nullptr) return 0;
  std::memset(address, 0, rounded);
  regions()[++last] = {address, size};
  return last;
}

RegionMemory regionMemory(MemoryRegionID id) {
  const auto at = regions().find(id);
  if (at == regions().end() || at->second.deleted) return {};
  return {at->second.address, at->second.size};
}

bool deleteRegion(MemoryRegionID id) {
  const auto at = regions().find(id);
  if (at == regions().end() || at->second.deleted) return false;
  at->second.deleted = true;
  freeIfUnused(id);
  return true;
}

void holdRegion(MemoryRegionID id) {
  const auto at = regions().find(id);
  if (at != regions().end()) ++at->second.holders;
}

void releaseRegion(MemoryRegionID id) {
  const auto at = regions().find(id);
  if (at == regions().end()) return;
  --at->second.holders;
  freeIfUnused(id);
}

MemoryRegionID regionAt(const void* address) {
  for (const auto& [id, region] : regions())
    if (region.address == address && !region.deleted) return id;
  return 0;
}

}  // namespace btr::openr
