// A row with two ends and room for `MaxSize` elements.
#ifndef BTR_OPENR_ODEQUE_H
#define BTR_OPENR_ODEQUE_H

#include <OPENR/OList.h>

template <class T, int MaxSize>
class ODeque {
 public:
  OTLStatus PushFront(const T& item) { return values_.PushFront(item); }
  OTLStatus PushBack(const T& item) { return values_.PushBack(item); }
  OTLStatus PopFront() { return values_.PopFront(); }
  OTLStatus PopBack() { return values_.PopBack(); }
  T& Front() { return values_.Front(); }
  T& Back() { return values_.Back(); }
  void Clear() { values_.Clear(); }
  int GetSize() const { return values_.GetSize(); }
  int GetMaxSize() const { return MaxSize; }

 private:
  OList<T, MaxSize> values_;
};

#endif
