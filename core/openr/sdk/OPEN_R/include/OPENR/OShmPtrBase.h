#ifndef BTR_OPENR_OSHMPTRBASE_H
#define BTR_OPENR_OSHMPTRBASE_H

#include <OPENR/RCRegion.h>

#include <string.h>

/// Holds one reference of a region.
class OShmPtrBase {
 public:
  OShmPtrBase() : pointee_(0) {}
  explicit OShmPtrBase(RCRegion* region) : pointee_(region) { hold(); }
  OShmPtrBase(const OShmPtrBase& other) : pointee_(other.pointee_) { hold(); }
  virtual ~OShmPtrBase() { Deallocate(); }
  const OShmPtrBase& operator=(const OShmPtrBase& other) {
    RCRegion* const now = other.pointee_;
    if (now != 0) now->AddReference();
    Deallocate();
    pointee_ = now;
    return *this;
  }

  void Deallocate() {
    if (pointee_ != 0) pointee_->RemoveReference();
    pointee_ = 0;
  }
  /// Where its bytes begin; 0 without a region.
  char* BaseAddress() const { return pointee_ == 0 ? 0 : pointee_->Base(); }
  char* Base() const { return BaseAddress(); }
  size_t Size() const { return pointee_ == 0 ? 0 : pointee_->Size(); }  ///< bytes
  RCRegion* RCRPtr() const { return pointee_; }
  MemoryRegionID MemID() const { return pointee_ == 0 ? 0 : pointee_->MemID(); }
  unsigned int Offset() const { return pointee_ == 0 ? 0 : pointee_->Offset(); }

 protected:
  void hold() {
    if (pointee_ != 0) pointee_->AddReference();
  }
  RCRegion* pointee_;
};

inline void memcpy(void* to, const OShmPtrBase& from, size_t size) { ::memcpy(to, from.Base(), size); }

#endif
