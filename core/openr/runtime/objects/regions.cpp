#include "core/openr/runtime/objects/regions.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <map>

namespace btr::openr {
namespace {

struct Region {
  void* address = nullptr;
  std::size_t size = 0;
  int holders = 0;
  bool deleted = false;
  bool readOnly = false;
};

constexpr std::size_t alignment = 16;
/// Memory is protected by whole pages.
std::size_t pageSize() { return static_cast<std::size_t>(sysconf(_SC_PAGESIZE)); }
std::size_t roundedUp(std::size_t size, std::size_t unit) {
  return std::max<std::size_t>((size + unit - 1) / unit, 1) * unit;
}

std::map<MemoryRegionID, Region>& regions() {
  static std::map<MemoryRegionID, Region> all;
  return all;
}

void freeIfUnused(MemoryRegionID id) {
  const auto at = regions().find(id);
  if (at == regions().end() || !at->second.deleted || at->second.holders > 0) return;
  if (at->second.readOnly) mprotect(at->second.address, roundedUp(at->second.size, pageSize()), PROT_READ | PROT_WRITE);
  std::free(at->second.address);
  regions().erase(at);
}

}  // namespace

MemoryRegionID newRegion(std::size_t size, bool readOnly) {
  static MemoryRegionID last = 0;
  const std::size_t unit = readOnly ? pageSize() : alignment;
  const std::size_t rounded = roundedUp(size, unit);
  void* address = std::aligned_alloc(unit, rounded);
  if (address == nullptr) return 0;
  std::memset(address, 0, rounded);
  if (readOnly && mprotect(address, rounded, PROT_READ) != 0) {
    std::free(address);
    return 0;
  }
  Region region;
  region.address = address;
  region.size = size;
  region.readOnly = readOnly;
  regions()[++last] = region;
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
