#ifndef BTR_OPENR_ANTSHAREDBUFFER_H
#define BTR_OPENR_ANTSHAREDBUFFER_H

#include <antTypes.h>

/// Memory from which the IP stack sends and into which it receives.
class antSharedBuffer {
 public:
  antSharedBuffer() : address_(0), size_(0), id_(0) {}
  antSharedBuffer(void* address, int size, uint32 id) : address_(address), size_(size), id_(id) {}
  antError Map() { return address_ == 0 ? ANT_FAIL : ANT_SUCCESS; }
  antError UnMap() { return address_ == 0 ? ANT_FAIL : ANT_SUCCESS; }
  void* GetAddress() const { return address_; }
  int GetSize() const { return size_; }
  uint32 GetID() const { return id_; }

 private:
  void* address_;
  int size_;
  uint32 id_;
};

#endif
