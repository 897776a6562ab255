#include "core/sim/trace.h"

#include <openssl/evp.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "core/spec/csv.h"
#include "core/spec/error.h"
#include "core/spec/parameter.h"

namespace btr {
namespace {

static_assert(std::endian::native == std::endian::little, "packed traces are little-endian");
constexpr char magic[8] = {'b', 't', 'r', 't', 'r', 'a', 'c', '1'};
constexpr std::uint64_t largest = std::uint64_t{1} << 33;  ///< bytes of an unpacked trace

void append(std::string& bytes, std::uint64_t number) {
  for (int i = 0; i < 8; ++i) bytes.push_back(static_cast<char>(number >> (8 * i)));
}

std::uint64_t number(const std::string& bytes, std::size_t at) {
  std::uint64_t result = 0;
  for (int i = 7; i >= 0; --i)
    result = result << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
  return result;
}

[[noreturn]] void damaged(const std::string& why) { throw InputError("packed trace: damaged (" + why + ")"); }

// Names one a line, then the bytes of all numbers regrouped: all first bytes of a column's numbers together, then all
// second ones, which compresses well because neighbouring numbers share their high bytes.
std::string regrouped(const Trace& trace) {
  const std::size_t rows = trace.rows(), columns = trace.channels.size();
  std::string bytes(rows * columns * 8, '\0');
  std::size_t to = 0;
  for (std::size_t column = 0; column < columns; ++column)
    for (int part = 0; part < 8; ++part)
      for (std::size_t row = 0; row < rows; ++row)
        bytes[to++] = static_cast<char>(std::bit_cast<std::uint64_t>(trace.at(row, column)) >> (8 * part));
  return bytes;
}

std::string joined(const std::vector<std::string>& names, char separator) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : std::string(1, separator)) + name;
  return text;
}

}  // namespace

int Trace::column(const std::string& name) const {
  const auto found = std::find(channels.begin(), channels.end(), name);
  return found == channels.end() ? -1 : static_cast<int>(found - channels.begin());
}

std::string Trace::sha256() const {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  EVP_DigestInit_ex(context, EVP_sha256(), nullptr);
  const std::string names = joined(channels, '\n') + '\n';
  EVP_DigestUpdate(context, names.data(), names.size());
  EVP_DigestUpdate(context, values.data(), values.size() * sizeof(double));
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  EVP_DigestFinal_ex(context, digest.data(), &length);
  EVP_MD_CTX_free(context);
  std::string text;
  for (unsigned int i = 0; i < length; ++i) {
    constexpr char digits[] = "0123456789abcdef";
    text += digits[digest[i] >> 4];
    text += digits[digest[i] & 15];
  }
  return text;
}

std::string Trace::toCsv() const {
  std::vector<std::string> headings;
  for (const std::string& channel : channels) headings.push_back(csvField(channel));
  std::string text = joined(headings, ',') + '\n';
  for (std::size_t row = 0; row < rows(); ++row)
    for (std::size_t column = 0; column < channels.size(); ++column) {
      text += btr::toText(at(row, column));
      text += column + 1 < channels.size() ? ',' : '\n';
    }
  return text;
}

std::string Trace::pack() const {
  const std::string names = joined(channels, '\n');
  const std::string body = names + regrouped(*this);
  std::string bytes(magic, sizeof magic);
  append(bytes, names.size());
  append(bytes, channels.size());
  append(bytes, rows());
  append(bytes, ::crc32_z(0, reinterpret_cast<const Bytef*>(body.data()), body.size()));
  const std::size_t head = bytes.size();
  uLongf size = compressBound(body.size());
  bytes.resize(head + size);
  compress2(reinterpret_cast<Bytef*>(bytes.data() + head), &size, reinterpret_cast<const Bytef*>(body.data()),
            body.size(), 6);
  bytes.resize(head + size);
  return bytes;
}

Trace Trace::unpack(const std::string& bytes) {
  constexpr std::size_t head = sizeof magic + 32;
  if (bytes.size() < head || std::memcmp(bytes.data(), magic, sizeof magic) != 0) damaged("no head");
  const std::uint64_t nameBytes = number(bytes, 8), columns = number(bytes, 16), rows = number(bytes, 24);
  // Deflate cannot shrink further than 1:1032, so a head that claims more is false: no memory is taken for it.
  const std::uint64_t most = std::min<std::uint64_t>(largest, 1040 * static_cast<std::uint64_t>(bytes.size()));
  if (nameBytes > most || columns > most || rows > most || (columns > 0 && rows > most / 8 / columns)) damaged("sizes");
  const std::uint64_t total = nameBytes + rows * columns * 8;
  std::string body(total, '\0');
  uLongf size = total;
  const int result = uncompress(reinterpret_cast<Bytef*>(body.data()), &size,
                                reinterpret_cast<const Bytef*>(bytes.data() + head), bytes.size() - head);
  if (result != Z_OK || size != total) damaged("compressed bytes");
  if (::crc32_z(0, reinterpret_cast<const Bytef*>(body.data()), body.size()) != number(bytes, 32)) damaged("check sum");

  Trace trace;
  const std::string names = body.substr(0, nameBytes);
  for (std::size_t begin = 0; columns > 0 && begin <= names.size();) {
    const std::size_t end = std::min(names.find('\n', begin), names.size());
    trace.channels.push_back(names.substr(begin, end - begin));
    begin = end + 1;
  }
  if (trace.channels.size() != columns) damaged("names");
  trace.values.resize(rows * columns);
  std::size_t from = nameBytes;
  std::vector<std::uint64_t> numbers(rows);
  for (std::size_t column = 0; column < columns; ++column) {
    std::fill(numbers.begin(), numbers.end(), 0);
    for (int part = 0; part < 8; ++part)
      for (std::size_t row = 0; row < rows; ++row)
        numbers[row] |= static_cast<std::uint64_t>(static_cast<unsigned char>(body[from++])) << (8 * part);
    for (std::size_t row = 0; row < rows; ++row)
      trace.values[row * columns + column] = std::bit_cast<double>(numbers[row]);
  }
  return trace;
}

}  // namespace btr
