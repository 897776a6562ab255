#ifndef BTR_OPENR_IPADDRESS_H
#define BTR_OPENR_IPADDRESS_H

#include <antTypes.h>

/// An address in the host's order of bytes: 10.0.1.100 is 0x0a000164.
class IPAddress {
 public:
  IPAddress() : address_(0) {}
  IPAddress(const IPAddress& _address) : address_(_address.address_) {}
  IPAddress(uint32 _address) : address_(_address) {}
  IPAddress(int _address) : address_(static_cast<uint32>(_address)) {}
  IPAddress(byte _b1, byte _b2, byte _b3, byte _b4)
      : address_((static_cast<uint32>(_b1) << 24) | (static_cast<uint32>(_b2) << 16) | (static_cast<uint32>(_b3) << 8) |
                 static_cast<uint32>(_b4)) {}
  /// "10.0.1.100"; 0.0.0.0 for what is no address.
  IPAddress(const char* str);
  IPAddress& operator=(const IPAddress& _address) {
    address_ = _address.address_;
    return *this;
  }

  boolean InMulticast() const { return (address_ >> 28) == 0xe; }
  boolean InBroadcast() const { return address_ == 0xffffffffu; }
  boolean InLoop() const { return (address_ >> 24) == 127; }
  boolean AllHostsGroup() const { return address_ == 0xe0000001u; }
  uint32 Address() const { return address_; }
  /// Writes at most 16 characters.
  char* GetAsString(char* text) const;
  OSTREAM& print(OSTREAM& os) const;

 private:
  uint32 address_;
};

inline bool operator==(const IPAddress& a, const IPAddress& b) { return a.Address() == b.Address(); }
inline bool operator!=(const IPAddress& a, const IPAddress& b) { return a.Address() != b.Address(); }
inline bool operator<(const IPAddress& a, const IPAddress& b) { return a.Address() < b.Address(); }
inline OSTREAM& operator<<(OSTREAM& os, const IPAddress& address) { return address.print(os); }

#define IP_ADDR_ANY IPAddress(0)
#define IP_ADDR_LOOPBACK IPAddress(127, 0, 0, 1)
#define IP_ADDR_BROADCAST IPAddress(0xffffffffu)
#define IP_PORT_ANY 0

#endif
