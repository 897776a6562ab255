#ifndef BTR_OPENR_ANTMODULEREF_H
#define BTR_OPENR_ANTMODULEREF_H

#include <antTypes.h>

/// An endpoint of the IP stack.
class antModuleRef {
 public:
  antModuleRef() : ptr_(0), index_(0) {}
  antModuleRef(void* _ptr, uint32 _index) : ptr_(_ptr), index_(_index) {}
  ~antModuleRef() {}
  OSTREAM& Print(OSTREAM& _os) const { return _os << "endpoint " << index_; }
  uint32 GetIndex() const { return index_; }
  bool IsValid() const { return index_ != 0; }

 private:
  void* ptr_;
  uint32 index_;
};

inline bool operator==(const antModuleRef& a, const antModuleRef& b) { return a.GetIndex() == b.GetIndex(); }
inline bool operator!=(const antModuleRef& a, const antModuleRef& b) { return a.GetIndex() != b.GetIndex(); }
inline OSTREAM& operator<<(OSTREAM& os, const antModuleRef& ref) { return ref.Print(os); }

#endif
