#ifndef BTR_OPENR_OSHMPTR_H
#define BTR_OPENR_OSHMPTR_H

#include <OPENR/OShmPtrBase.h>

/// Elements of type T in a region that can be sent to other objects. Writing to one that others hold too makes a copy
/// of the region first, so that they go on to see what was sent.
template <class T>
class OShmPtr : public OShmPtrBase {
 public:
  /// An element: read as a T, written by assignment.
  class Proxy {
   public:
    Proxy(OShmPtr& owner, int index) : owner_(owner), index_(index) {}
    Proxy& operator=(const T& value) {
      owner_.own();
      owner_.elements()[index_] = value;
      return *this;
    }
    Proxy& operator=(const Proxy& other) { return *this = static_cast<T>(other); }
    operator T() const { return owner_.elements()[index_]; }

   private:
    OShmPtr& owner_;
    int index_;
  };

  OShmPtr() {}
  /// Of `count` elements, zeroed.
  explicit OShmPtr(size_t count) { Allocate(static_cast<int>(count)); }
  OShmPtr(const OShmPtrBase& other) : OShmPtrBase(other) {}
  explicit OShmPtr(RCRegion* region) : OShmPtrBase(region) {}

  const T& operator*() const { return elements()[0]; }
  const T& operator[](int index) const { return elements()[index]; }
  Proxy operator*() { return Proxy(*this, 0); }
  Proxy operator[](int index) { return Proxy(*this, index); }
  const T* operator->() const { return elements(); }

  int NumOfElement() const { return static_cast<int>(OShmPtrBase::Size() / sizeof(T)); }
  int Size() const { return NumOfElement(); }  ///< elements, not bytes

  /// A new region of `count` elements.
  void Allocate(int count = 1) {
    Deallocate();
    pointee_ = new RCRegion(static_cast<size_t>(count) * sizeof(T));
  }
  /// A new region with a copy of `size` bytes.
  void AllocateCopy(size_t size, const void* from) {
    RCRegion* const made = new RCRegion(size);
    ::memcpy(made->Base(), from, size);
    Deallocate();
    pointee_ = made;
  }
  /// Into its region, as many bytes as that has.
  void Copy(const void* from, size_t size) {
    if (pointee_ == 0) return;
    own();
    ::memcpy(Base(), from, size < OShmPtrBase::Size() ? size : OShmPtrBase::Size());
  }

 private:
  friend class Proxy;
  T* elements() const { return reinterpret_cast<T*>(Base()); }
  void own() {
    if (pointee_ != 0 && pointee_->NumberOfReference() > 1) AllocateCopy(OShmPtrBase::Size(), Base());
  }
};

template <class T>
void memcpy(OShmPtr<T>& to, const void* from, size_t size) {
  to.Copy(from, size);
}

#endif
