#include "core/gap/recordings/table/text_source.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <streambuf>
#include <string_view>
#include <utility>
#include <vector>

#include "core/spec/error.h"
#include "core/spec/sha256.h"

namespace btr {
namespace {

enum class ByteOrder { none, littleFirst, bigFirst };

/// UTF-16 shows itself by its mark or, as columns are mostly digits, by every other byte being zero.
ByteOrder byteOrderOf(std::string_view beginning) {
  if (beginning.starts_with("\xff\xfe")) return ByteOrder::littleFirst;
  if (beginning.starts_with("\xfe\xff")) return ByteOrder::bigFirst;
  std::array<std::size_t, 2> zeros{};
  const std::size_t looked = std::min<std::size_t>(beginning.size(), 512);
  for (std::size_t i = 0; i < looked; ++i) zeros[i % 2] += beginning[i] == '\0';
  if (looked >= 16 && zeros[0] == 0 && 5 * zeros[1] > 2 * looked) return ByteOrder::littleFirst;
  if (looked >= 16 && zeros[1] == 0 && 5 * zeros[0] > 2 * looked) return ByteOrder::bigFirst;
  return ByteOrder::none;
}

}  // namespace

/// Hands a file's bytes on and hashes them on the way.
class TextSource::Bytes : public std::streambuf {
 public:
  explicit Bytes(const std::string& path) : file_(path, std::ios::binary), buffer_(1 << 16) {}
  bool isOpen() const { return file_.is_open(); }
  std::uintmax_t total() const { return total_; }
  bool endsWithLine() const {
    const auto isEnd = [](char byte) { return byte == '\n' || byte == '\r'; };
    return isEnd(last_[1]) || (last_[1] == '\0' && isEnd(last_[0]));
  }
  std::string finish() { return hash_.finish(); }
  std::string_view ahead() {
    sgetc();
    return {gptr(), static_cast<std::size_t>(egptr() - gptr())};
  }

 protected:
  int_type underflow() override {
    file_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    const auto count = static_cast<std::size_t>(std::max<std::streamsize>(0, file_.gcount()));
    if (file_.bad()) throw std::ios_base::failure("read error");  // the stream above sets its badbit
    if (count == 0) return traits_type::eof();
    hash_.add({buffer_.data(), count});
    total_ += count;
    last_ = {count > 1 ? buffer_[count - 2] : last_[1], buffer_[count - 1]};
    setg(buffer_.data(), buffer_.data(), buffer_.data() + count);
    return traits_type::to_int_type(buffer_[0]);
  }

 private:
  std::ifstream file_;
  std::vector<char> buffer_;
  Sha256 hash_;
  std::uintmax_t total_ = 0;
  std::array<char, 2> last_{};
};

/// UTF-16 in, UTF-8 out (RFC 2781, RFC 3629).
class TextSource::Wide : public std::streambuf {
 public:
  Wide(std::streambuf& bytes, ByteOrder order) : bytes_(bytes), bigFirst_(order == ByteOrder::bigFirst) {}

 protected:
  int_type underflow() override {
    text_.clear();
    while (text_.size() < (1 << 15)) {
      const long unit = nextUnit();
      if (unit == ended) break;
      if (!begun_ && unit == 0xFEFF) {
        begun_ = true;
        continue;
      }
      begun_ = true;
      append(unit);
    }
    if (text_.empty()) return traits_type::eof();
    setg(text_.data(), text_.data(), text_.data() + text_.size());
    return traits_type::to_int_type(text_[0]);
  }

 private:
  static constexpr long ended = -1, half = -2;

  long nextUnit() {
    if (kept_ != ended) return std::exchange(kept_, ended);
    const int_type first = bytes_.sbumpc(), second = bytes_.sbumpc();
    if (first == traits_type::eof()) return ended;
    if (second == traits_type::eof()) return half;
    return bigFirst_ ? first << 8 | second : second << 8 | first;
  }

  void append(long unit) {
    constexpr char invalid = '\xff';
    if (unit >= 0xD800 && unit < 0xDC00) {  // the first half of a pair
      const long low = nextUnit();
      if (low >= 0xDC00 && low < 0xE000) {
        unit = 0x10000 + ((unit - 0xD800) << 10) + (low - 0xDC00);
      } else {
        kept_ = low;
        unit = half;
      }
    } else if (unit >= 0xDC00 && unit < 0xE000) {
      unit = half;
    }
    const auto more = [&](int shift) { text_ += static_cast<char>(0x80 | ((unit >> shift) & 0x3F)); };
    if (unit == half) {
      text_ += invalid;
    } else if (unit < 0x80) {
      text_ += static_cast<char>(unit);
    } else if (unit < 0x800) {
      text_ += static_cast<char>(0xC0 | unit >> 6);
      more(0);
    } else if (unit < 0x10000) {
      text_ += static_cast<char>(0xE0 | unit >> 12);
      more(6), more(0);
    } else {
      text_ += static_cast<char>(0xF0 | unit >> 18);
      more(12), more(6), more(0);
    }
  }

  std::streambuf& bytes_;
  bool bigFirst_, begun_ = false;
  long kept_ = ended;
  std::string text_;
};

TextSource::TextSource(const std::string& path) : bytes_(std::make_unique<Bytes>(path)) {
  if (!bytes_->isOpen()) throw InputError(path + ": the file cannot be read");
  std::streambuf* text = bytes_.get();
  if (const ByteOrder order = byteOrderOf(bytes_->ahead()); order != ByteOrder::none) {
    wide_ = std::make_unique<Wide>(*bytes_, order);
    text = wide_.get();
  }
  stream_ = std::make_unique<std::istream>(text);
}

TextSource::~TextSource() = default;
std::uintmax_t TextSource::bytesRead() const { return bytes_->total(); }
bool TextSource::endsWithLine() const { return bytes_->endsWithLine(); }
std::string TextSource::finish() { return bytes_->finish(); }

}  // namespace btr
