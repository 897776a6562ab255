#ifndef BTR_OPENR_OMEMORYLOCATOR_H
#define BTR_OPENR_OMEMORYLOCATOR_H

#include <Types.h>

#include <iostream>

using std::cout;
using std::endl;
using std::ostream;

/// A place in a shared memory region.
struct OMemoryLocator {
  MemoryRegionID mid;
  u_int offset;
  OMemoryLocator() : mid(UNDEF), offset(UNDEF) {}
  OMemoryLocator(MemoryRegionID m, u_int o) : mid(m), offset(o) {}
  void Set(MemoryRegionID m, u_int o) {
    mid = m;
    offset = o;
  }
  bool IsInvalid() const { return mid == UNDEF && offset == UNDEF; }
  void MakeInvalid() { Set(UNDEF, UNDEF); }
};

inline bool operator==(const OMemoryLocator& a, const OMemoryLocator& b) {
  return a.mid == b.mid && a.offset == b.offset;
}
inline bool operator<(const OMemoryLocator& a, const OMemoryLocator& b) {
  return a.mid < b.mid || (a.mid == b.mid && a.offset < b.offset);
}
inline ostream& operator<<(ostream& out, const OMemoryLocator& at) {
  return out << "mid = " << at.mid << ", offset = " << at.offset;
}

#endif
