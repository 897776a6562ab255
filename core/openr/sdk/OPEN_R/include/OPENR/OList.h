#ifndef BTR_OPENR_OLIST_H
#define BTR_OPENR_OLIST_H

#include <OPENR/OPENR.h>

#include <list>

/// A list with at most `MAXIMUM` elements; 0: any number.
template <class T, size_t MAXIMUM = 0>
class OList {
 public:
  typedef typename std::list<T>::iterator Iterator;
  typedef typename std::list<T>::const_iterator ConstIterator;
  typedef typename std::list<T>::iterator iterator;
  typedef typename std::list<T>::const_iterator const_iterator;

  OStatus Add(const T& value) {
    if (MAXIMUM != 0 && values_.size() >= MAXIMUM) return oFULL_OF_QUEUE;
    values_.push_back(value);
    return oSUCCESS;
  }
  OStatus Append(const T& value) { return Add(value); }
  OStatus Insert(const T& value) { return Add(value); }
  OStatus Remove(const T& value) {
    for (iterator i = values_.begin(); i != values_.end(); ++i)
      if (*i == value) {
        values_.erase(i);
        return oSUCCESS;
      }
    return oITEM_NOT_FOUND;
  }
  OStatus Find(const T& value, T* found) const {
    for (const_iterator i = values_.begin(); i != values_.end(); ++i)
      if (*i == value) {
        *found = *i;
        return oSUCCESS;
      }
    return oITEM_NOT_FOUND;
  }
  T* Find(const T& value) {
    for (iterator i = values_.begin(); i != values_.end(); ++i)
      if (*i == value) return &*i;
    return 0;
  }
  OStatus Get(size_t index, T* value) const {
    if (index >= values_.size()) return oITEM_NOT_FOUND;
    *value = (*this)[index];
    return oSUCCESS;
  }
  T& operator[](size_t index) {
    iterator i = values_.begin();
    while (index-- > 0) ++i;
    return *i;
  }
  const T& operator[](size_t index) const {
    const_iterator i = values_.begin();
    while (index-- > 0) ++i;
    return *i;
  }
  size_t Size() const { return values_.size(); }
  size_t GetSize() const { return values_.size(); }
  size_t NumberOfItems() const { return values_.size(); }
  bool IsEmpty() const { return values_.empty(); }
  bool IsFull() const { return MAXIMUM != 0 && values_.size() >= MAXIMUM; }
  void Clear() { values_.clear(); }

  iterator begin() { return values_.begin(); }
  iterator end() { return values_.end(); }
  const_iterator begin() const { return values_.begin(); }
  const_iterator end() const { return values_.end(); }
  bool empty() const { return values_.empty(); }
  size_t size() const { return values_.size(); }
  void push_back(const T& value) { values_.push_back(value); }
  void push_front(const T& value) { values_.push_front(value); }
  void pop_front() { values_.pop_front(); }
  void pop_back() { values_.pop_back(); }
  T& front() { return values_.front(); }
  T& back() { return values_.back(); }
  iterator erase(iterator i) { return values_.erase(i); }
  void clear() { values_.clear(); }

 private:
  std::list<T> values_;
};

#endif
