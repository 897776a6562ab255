// The identity of an object of the running program.
#ifndef BTR_OPENR_OID_H
#define BTR_OPENR_OID_H

#include <Types.h>

#include <iosfwd>

class OID {
 public:
  OID() : address_(0) {}
  OID(void* address) : address_(address) {}

  void Set(void* address) { address_ = address; }
  void SetAddress(void* address) { address_ = address; }
  void* GetAddress() const { return address_; }
  bool IsValid() const { return address_ != 0; }
  void MakeInvalid() { address_ = 0; }

 private:
  void* address_;
};

inline bool operator==(const OID& a, const OID& b) { return a.GetAddress() == b.GetAddress(); }
inline bool operator!=(const OID& a, const OID& b) { return !(a == b); }
inline bool operator<(const OID& a, const OID& b) { return a.GetAddress() < b.GetAddress(); }
std::ostream& operator<<(std::ostream& out, const OID& id);

class TID {
 public:
  TID() : selector_(UNDEF) {}
  TID(const OID& oid, Selector selector) : oid_(oid), selector_(selector) {}
  OID GetOID() const { return oid_; }
  Selector GetSelector() const { return selector_; }

 protected:
  OID oid_;
  Selector selector_;
};

#endif
