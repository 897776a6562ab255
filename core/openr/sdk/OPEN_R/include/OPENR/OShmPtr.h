#ifndef BTR_OPENR_OSHMPTR_H
#define BTR_OPENR_OSHMPTR_H

#include <OPENR/RCRegion.h>

#include <new>

/// Holds one reference of a region.
class OShmPtrBase {
 public:
  OShmPtrBase() : region_(0) {}
  /// Takes the first reference of a new region over, adds one to others.
  explicit OShmPtrBase(RCRegion* region) : region_(region) {
    if (region_ != 0) region_->AddReference();
  }
  OShmPtrBase(const OShmPtrBase& other) : region_(other.region_) {
    if (region_ != 0) region_->AddReference();
  }
  ~OShmPtrBase() { Release(); }
  OShmPtrBase& operator=(const OShmPtrBase& other) {
    if (other.region_ != 0) other.region_->AddReference();
    Release();
    region_ = other.region_;
    return *this;
  }

  RCRegion* GetRCRegion() const { return region_; }
  RCRegion* Region() const { return region_; }
  int NumberOfReference() const { return region_ == 0 ? 0 : region_->NumberOfReference(); }
  bool IsNull() const { return region_ == 0; }
  bool IsValid() const { return region_ != 0; }
  void Release() {
    if (region_ != 0) region_->RemoveReference();
    region_ = 0;
  }

 protected:
  void make(size_t size) {
    Release();
    region_ = new RCRegion(size);
  }
  RCRegion* region_;
};

/// A T in a region that can be sent to other objects.
template <class T>
class OShmPtr : public OShmPtrBase {
 public:
  OShmPtr() {}
  explicit OShmPtr(RCRegion* region) : OShmPtrBase(region) {}
  /// Room for `size` bytes that begin with a T.
  explicit OShmPtr(size_t size) { make(size); }
  explicit OShmPtr(const T& value) {
    make(sizeof(T));
    new (region_->Base()) T(value);
  }
  void New() {
    make(sizeof(T));
    new (region_->Base()) T;
  }

  T* Get() const { return region_ == 0 ? 0 : reinterpret_cast<T*>(region_->Base()); }
  T* operator->() const { return Get(); }
  T& operator*() const { return *Get(); }
  operator T*() const { return Get(); }
};

#endif
