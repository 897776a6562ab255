#pragma once
#include <IPAddress.h>

#include <map>
#include <string>
#include <vector>

namespace btr::openr {

/// What OPEN-R/SYSTEM/CONF/WLANCONF.TXT of a stick says: lines KEY=VALUE; what stands behind # or has no = is left out.
class NetworkSettings {
 public:
  /// Without the file everything is empty.
  explicit NetworkSettings(const std::string& stick);

  /// "" for what is not set.
  std::string value(const std::string& key) const;
  bool has(const std::string& key) const { return values_.count(key) > 0; }
  void set(const std::string& key, const std::string& value) { values_[key] = value; }

  /// Those of DNS_SERVER_1, DNS_SERVER_2 … that are addresses, MAXNS at most.
  std::vector<IPAddress> nameServers() const;
  /// Keeps at most MAXNS.
  void setNameServers(const std::vector<IPAddress>& servers);

 private:
  std::map<std::string, std::string> values_;
};

/// The address that `text` is written as, "10.0.1.100"; false if it is none.
bool readAddress(const std::string& text, IPAddress& address);

}  // namespace btr::openr
