#include "core/cluster/parts.h"

#include <cstdint>
#include <cstring>

#include "core/spec/error.h"

namespace btr {

std::string pack(const Parts& parts) {
  std::size_t size = 0;
  for (const std::string& part : parts) size += sizeof(std::uint64_t) + part.size();
  std::string bytes;
  bytes.reserve(size);
  for (const std::string& part : parts) {
    const std::uint64_t length = part.size();
    bytes.append(reinterpret_cast<const char*>(&length), sizeof length);
    bytes += part;
  }
  return bytes;
}

Parts unpack(const std::string& bytes) {
  Parts parts;
  std::size_t at = 0;
  while (at < bytes.size()) {
    std::uint64_t length = 0;
    if (bytes.size() - at < sizeof length) throw InputError("a message between ranks is cut short");
    std::memcpy(&length, bytes.data() + at, sizeof length);
    at += sizeof length;
    if (length > bytes.size() - at) throw InputError("a message between ranks is cut short");
    parts.push_back(bytes.substr(at, length));
    at += length;
  }
  return parts;
}

}  // namespace btr
