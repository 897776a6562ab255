#ifndef BTR_OPENR_RCREGION_H
#define BTR_OPENR_RCREGION_H

#include <OPENR/OPENR.h>

/// Memory that objects share and count. Made by `new` only: it deletes itself when the last reference is removed. Who
/// makes it has the first reference. Written to only while there is no other.
class RCRegion {
 public:
  /// SELF_ALLOCATED: its own memory; REFERENCE_V20: what OPENR::New…VectorData made; REFERENCE_V10: neither.
  enum RegionType { SELF_ALLOCATED, REFERENCE_V20, REFERENCE_V10 };

  /// No memory and no reference.
  RCRegion();
  explicit RCRegion(size_t size);
  /// Wraps what OPENR::New…VectorData made.
  RCRegion(MemoryRegionID memID, offset_t offset, void* baseAddr = 0, size_t size = 0);

  void AddReference() { ++references_; }
  void RemoveReference();
  int NumberOfReference() const { return references_; }
  char* Base() const { return base_; }
  size_t Size() const { return size_; }
  MemoryRegionID MemID() const { return memID_; }
  offset_t Offset() const { return offset_; }
  RegionType GetType() const { return type_; }
  void SetSize(size_t size) { size_ = size; }

  ~RCRegion();

 private:
  RCRegion(const RCRegion&);
  RCRegion& operator=(const RCRegion&);

  int references_;
  char* base_;
  size_t size_;
  MemoryRegionID memID_;
  offset_t offset_;
  RegionType type_;
};

typedef RCRegion RCRegionBase;  // of earlier programs

#endif
