#include <OPENR/RCRegion.h>

#include <algorithm>

#include "core/openr/runtime/objects/regions.h"

RCRegion::RCRegion() : references_(0), base_(nullptr), size_(0), memID_(0), offset_(0), type_(REFERENCE_V10) {}

RCRegion::RCRegion(std::size_t size)
    : references_(1),
      base_(nullptr),
      size_(size),
      memID_(btr::openr::newRegion(size)),
      offset_(0),
      type_(SELF_ALLOCATED) {
  base_ = static_cast<char*>(btr::openr::regionMemory(memID_).address);
}

RCRegion::RCRegion(MemoryRegionID memID, offset_t offset, void* baseAddr, std::size_t size)
    : references_(1),
      base_(static_cast<char*>(baseAddr)),
      size_(size),
      memID_(memID),
      offset_(offset),
      type_(REFERENCE_V20) {
  const auto memory = btr::openr::regionMemory(memID);
  if (memory.address == nullptr) {
    type_ = REFERENCE_V10;  // somebody else's memory
    return;
  }
  if (base_ == nullptr) base_ = static_cast<char*>(memory.address) + offset;
  if (size_ == 0) size_ = memory.size - std::min<std::size_t>(offset, memory.size);
  btr::openr::holdRegion(memID);
}

RCRegion::~RCRegion() {
  if (type_ == SELF_ALLOCATED) btr::openr::deleteRegion(memID_);
  if (type_ == REFERENCE_V20) btr::openr::releaseRegion(memID_);
}

void RCRegion::RemoveReference() {
  if (--references_ <= 0) delete this;
}
