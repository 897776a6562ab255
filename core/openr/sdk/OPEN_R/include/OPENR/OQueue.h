// What came first goes first; room for `MaxSize` elements.
#ifndef BTR_OPENR_OQUEUE_H
#define BTR_OPENR_OQUEUE_H

#include <OPENR/OList.h>

template <class T, int MaxSize>
class OQueue {
 public:
  OTLStatus PushBack(const T& item) { return values_.PushBack(item); }
  OTLStatus PopFront() { return values_.PopFront(); }
  T& Front() { return values_.Front(); }
  void Clear() { values_.Clear(); }
  int GetSize() const { return values_.GetSize(); }
  int GetMaxSize() const { return MaxSize; }

 private:
  OList<T, MaxSize> values_;
};

#endif
