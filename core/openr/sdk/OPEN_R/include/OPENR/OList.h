// A list with room for a number of elements that is fixed when it is compiled.
#ifndef BTR_OPENR_OLIST_H
#define BTR_OPENR_OLIST_H

#include <OPENR/ODebug.h>
#include <OPENR/OTLStatus.h>

#include <list>

const int olistNULL = -1;

/// At most `MaxSize` elements; 0: as many as Init() says.
template <class T, int MaxSize = 0>
class OList {
  typedef std::list<T> Values;

 public:
  /// Stands at an element or, behind the last one, at none. It goes back from there to the last.
  class Iterator {
   public:
    Iterator() : list_(0) {}
    Iterator(OList* list, typename Values::iterator at) : list_(list), at_(at) {}
    bool operator==(const Iterator& other) const { return list_ == other.list_ && (list_ == 0 || at_ == other.at_); }
    bool operator!=(const Iterator& other) const { return !(*this == other); }
    /// An element of its own with T's default value where there is none.
    T& operator*() const {
      static T none;
      if (list_ != 0 && at_ != list_->values_.end()) return *at_;
      none = T();
      return none;
    }
    T* operator->() const { return &**this; }
    Iterator& operator++() {
      if (list_ != 0 && at_ != list_->values_.end()) ++at_;
      return *this;
    }
    Iterator& operator--() {
      if (list_ == 0) return *this;
      if (at_ == list_->values_.begin())
        at_ = list_->values_.end();
      else
        --at_;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    Iterator operator--(int) {
      const Iterator before = *this;
      --*this;
      return before;
    }

   private:
    friend class OList;
    OList* list_;
    typename Values::iterator at_;
  };

  OList() : room_(MaxSize) {}
  OList(const OList& other) : values_(other.values_), room_(other.room_) {}
  OList& operator=(const OList& other) {
    values_ = other.values_;
    room_ = other.room_;
    return *this;
  }

  /// How many elements an OList<T> may have. otlFAIL while one is in it.
  OTLStatus Init(int maxSize) {
    if (!values_.empty() || maxSize < 0) return otlFAIL;
    room_ = maxSize;
    return otlSUCCESS;
  }
  OTLStatus PushFront(const T& item) { return Insert(Begin(), item); }
  OTLStatus PushBack(const T& item) { return Insert(End(), item); }
  OTLStatus PopFront() { return Erase(Begin()); }
  OTLStatus PopBack() { return Erase(--End()); }
  T& Front() { return *Begin(); }
  T& Back() { return *--End(); }
  void Clear() { values_.clear(); }
  int GetSize() const { return static_cast<int>(values_.size()); }
  int GetMaxSize() const { return room_; }

  Iterator Begin() { return Iterator(this, values_.begin()); }
  Iterator End() { return Iterator(this, values_.end()); }
  /// Before `at`.
  OTLStatus Insert(Iterator at, const T& item) {
    if (GetSize() >= room_) return otlOVERFLOW;
    values_.insert(at.list_ == 0 ? values_.end() : at.at_, item);
    return otlSUCCESS;
  }
  OTLStatus Erase(Iterator at) {
    if (values_.empty()) return otlUNDERFLOW;
    if (at.list_ == 0 || at.at_ == values_.end()) return otlFAIL;
    values_.erase(at.at_);
    return otlSUCCESS;
  }

 private:
  Values values_;
  int room_;
};

#endif
