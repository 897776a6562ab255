// What came last goes first; room for `MaxSize` elements.
#ifndef BTR_OPENR_OSTACK_H
#define BTR_OPENR_OSTACK_H

#include <OPENR/OList.h>

template <class T, int MaxSize>
class OStack {
 public:
  OTLStatus Push(const T& item) { return values_.PushBack(item); }
  OTLStatus Pop() { return values_.PopBack(); }
  T& Top() { return values_.Back(); }
  void Clear() { values_.Clear(); }
  int GetSize() const { return values_.GetSize(); }
  int GetMaxSize() const { return MaxSize; }

 private:
  OList<T, MaxSize> values_;
};

#endif
