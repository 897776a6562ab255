#include "core/store/packing.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/learn/bit_coding.h"
#include "core/spec/error.h"
#include "core/store/connection.h"

namespace btr {
namespace {

Cell asText(const std::string& text) { return {Cell::Type::text, 0, text}; }

int hexadecimal(char letter) {
  if (letter >= '0' && letter <= '9') return letter - '0';
  if (letter >= 'a' && letter <= 'f') return letter - 'a' + 10;
  return -1;
}

bool sameBits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(
      a, b, {}, [](double x) { return std::bit_cast<std::uint64_t>(x); },
      [](double x) { return std::bit_cast<std::uint64_t>(x); });
}

}  // namespace

Cell packedBits(const std::string& chromosome) {
  if (chromosome.empty() || chromosome.find_first_not_of("01") != std::string::npos) return asText(chromosome);
  const std::size_t bytes = (chromosome.size() + 7) / 8;
  Cell cell{Cell::Type::blob, 0, std::string(1 + bytes, '\0')};
  cell.bytes[0] = static_cast<char>(8 * bytes - chromosome.size());
  for (std::size_t k = 0; k < chromosome.size(); ++k)
    if (chromosome[k] == '1') cell.bytes[1 + k / 8] = static_cast<char>(cell.bytes[1 + k / 8] | 0x80 >> k % 8);
  return cell;
}

std::string bitsOf(const Cell& cell) {
  if (cell.type != Cell::Type::blob) return cell.bytes;
  const auto unused = cell.bytes.empty() ? 8u : static_cast<unsigned char>(cell.bytes[0]);
  if (cell.bytes.size() < 2 || unused > 7) throw InputError("a packed chromosome: is damaged");
  std::string chromosome(8 * (cell.bytes.size() - 1) - unused, '0');
  for (std::size_t k = 0; k < chromosome.size(); ++k)
    if (static_cast<unsigned char>(cell.bytes[1 + k / 8]) & 0x80 >> k % 8) chromosome[k] = '1';
  return chromosome;
}

Cell packedHash(const std::string& hash) {
  if (hash.size() != 64 || std::ranges::any_of(hash, [](char c) { return hexadecimal(c) < 0; })) return asText(hash);
  Cell cell{Cell::Type::blob, 0, std::string(32, '\0')};
  for (std::size_t k = 0; k < 32; ++k)
    cell.bytes[k] = static_cast<char>(hexadecimal(hash[2 * k]) << 4 | hexadecimal(hash[2 * k + 1]));
  return cell;
}

std::string hashOf(const Cell& cell) {
  if (cell.type != Cell::Type::blob) return cell.bytes;
  static constexpr char digits[] = "0123456789abcdef";
  std::string hash;
  for (const char byte : cell.bytes) {
    hash += digits[static_cast<unsigned char>(byte) >> 4];
    hash += digits[static_cast<unsigned char>(byte) & 15];
  }
  return hash;
}

std::vector<double> decodedGenes(const std::string& chromosome, const std::vector<GeneBounds>& genes, bool gray) {
  if (genes.empty() || chromosome.empty() || chromosome.size() % genes.size() != 0) return {};
  const std::size_t bits = chromosome.size() / genes.size();
  if (bits > 32 || chromosome.find_first_not_of("01") != std::string::npos) return {};
  const double largest = std::exp2(static_cast<double>(bits)) - 1;
  const auto kind = gray ? BitCoding::Kind::gray : BitCoding::Kind::binary;
  std::vector<double> parameters;
  parameters.reserve(genes.size());
  for (std::size_t k = 0; k < genes.size(); ++k) {
    const GeneBounds& gene = genes[k];
    if (!(gene.minimum <= gene.maximum)) return {};
    const double number = geneNumber(std::string_view(chromosome).substr(k * bits, bits), kind);
    double value = gene.minimum + (gene.maximum - gene.minimum) * (number / largest);
    if (gene.whole) value = std::round(value);
    parameters.push_back(std::clamp(value, gene.minimum, gene.maximum));
  }
  return parameters;
}

Cell packedParameters(const std::vector<double>& parameters, const std::string& chromosome,
                      const std::vector<GeneBounds>& genes) {
  if (!parameters.empty() && parameters.size() == genes.size())
    for (const bool gray : {false, true})
      if (sameBits(decodedGenes(chromosome, genes, gray), parameters)) return {Cell::Type::integer, gray ? 1 : 0, ""};
  return {Cell::Type::blob, 0, bytesOf(parameters)};
}

std::vector<double> parametersOf(const Cell& cell, const std::string& chromosome,
                                 const std::vector<GeneBounds>& genes) {
  if (cell.type == Cell::Type::blob) return doublesOf(cell.bytes);
  std::vector<double> parameters = decodedGenes(chromosome, genes, cell.number == 1);
  if (cell.type != Cell::Type::integer || cell.number < 0 || cell.number > 1 || parameters.empty())
    throw InputError("an individual's parameters: are damaged, or the bounds of its genes are");
  return parameters;
}

std::string bytesOf(const std::vector<double>& numbers) {
  std::string bytes;
  bytes.reserve(numbers.size() * 8);
  for (const double number : numbers) {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
  }
  return bytes;
}

std::vector<double> doublesOf(const std::string& bytes) {
  if (bytes.size() % 8 != 0) throw InputError("is damaged: a vector of " + std::to_string(bytes.size()) + " bytes");
  std::vector<double> numbers(bytes.size() / 8);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < 8; ++k) bits |= std::uint64_t{static_cast<unsigned char>(bytes[8 * i + k])} << (8 * k);
    numbers[i] = std::bit_cast<double>(bits);
  }
  return numbers;
}

std::string deflated(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string result(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), 6) != Z_OK)
    throw std::bad_alloc();  // the only way in which it fails when the buffer is of compressBound
  result.resize(size);
  return result;
}

std::string inflated(const std::string& bytes, std::int64_t size) {
  // Deflate cannot shrink further than 1:1032: no memory is taken for a size that is false.
  const bool plausible = size >= 0 && static_cast<std::uint64_t>(size) <= 1040 * std::uint64_t{bytes.size()} + 1040;
  std::string result(plausible ? static_cast<std::size_t>(size) : 0, '\0');
  uLongf got = result.size();
  if (!plausible ||
      uncompress(reinterpret_cast<Bytef*>(result.data()), &got, reinterpret_cast<const Bytef*>(bytes.data()),
                 bytes.size()) != Z_OK ||
      got != result.size())
    throw InputError("is damaged: compressed bytes that cannot be read");
  return result;
}

const std::vector<GeneBounds>& GenesOfRuns::of(Id run) {
  const auto [place, isNew] = known_.try_emplace(run);
  if (!isNew) return place->second;
  Query row(connection_, "SELECT minimum, maximum, whole FROM run_genes WHERE run_id = ?", run);
  if (!row.next()) return place->second;
  std::vector<double> minimum, maximum, whole;
  row.get(minimum, maximum, whole);
  if (minimum.size() != maximum.size() || minimum.size() != whole.size())
    connection_.refuse("is damaged: bounds of genes of run " + std::to_string(run));
  for (std::size_t k = 0; k < minimum.size(); ++k) place->second.push_back({minimum[k], maximum[k], whole[k] != 0});
  return place->second;
}

}  // namespace btr
