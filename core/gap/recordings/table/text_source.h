#pragma once
#include <cstdint>
#include <istream>
#include <memory>
#include <string>

namespace btr {

/// A file's text in UTF-8, whether its bytes are UTF-8 or UTF-16 (either order, with a byte order mark or without).
/// Hashes the bytes on the way: what was hashed is what was read. A half character becomes the byte 0xFF, which no
/// reader of UTF-8 accepts.
class TextSource {
 public:
  /// Throws InputError for a file that cannot be read.
  explicit TextSource(const std::string& path);
  ~TextSource();

  std::istream& stream() { return *stream_; }
  bool isUtf16() const { return wide_ != nullptr; }
  std::uintmax_t bytesRead() const;  ///< of the file, so far
  bool endsWithLine() const;         ///< the last byte read ends a line
  std::string finish();              ///< SHA-256 of all that was read; once

 private:
  class Bytes;
  class Wide;
  std::unique_ptr<Bytes> bytes_;
  std::unique_ptr<Wide> wide_;
  std::unique_ptr<std::istream> stream_;
};

}  // namespace btr
