#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/store/records.h"

// Values that are stored in fewer bytes than they have in memory. SQLite keeps the type of every value: a blob is
// packed, a text is stored as it is. What does not fit a packing is stored whole, so every value comes back unchanged.
namespace btr {

class Connection;

/// A value with the type that SQLite stores it under.
struct Cell {
  enum class Type { null, integer, text, blob };
  Type type = Type::null;
  std::int64_t number = 0;
  std::string bytes;
};

/// "0101…" as bits: a byte that counts the unused bits at the end, then eight bits a byte, first bit highest.
Cell packedBits(const std::string& chromosome);
std::string bitsOf(const Cell& cell);

/// A SHA-256 in lower-case hexadecimal as its 32 bytes.
Cell packedHash(const std::string& hash);
std::string hashOf(const Cell& cell);

/// Parameters that follow, bit for bit, from the chromosome and the genes' bounds are stored as how its bits are read:
/// 0 binary, 1 Gray code. Others are stored as little-endian doubles.
Cell packedParameters(const std::vector<double>& parameters, const std::string& chromosome,
                      const std::vector<GeneBounds>& genes);
/// Throws InputError if the cell does not fit the chromosome and the bounds.
std::vector<double> parametersOf(const Cell& cell, const std::string& chromosome, const std::vector<GeneBounds>& genes);

/// minimum + (maximum − minimum)·v/(2^b − 1), rounded if whole, within the bounds; v is the gene's number, b its bits.
/// Part of the file format, so it stays as it is whatever learners may do. Empty if the chromosome does not divide into
/// the genes.
std::vector<double> decodedGenes(const std::string& chromosome, const std::vector<GeneBounds>& genes, bool gray);

/// Little-endian doubles. Throws InputError for a number of bytes that is not a multiple of 8.
std::string bytesOf(const std::vector<double>& numbers);
std::vector<double> doublesOf(const std::string& bytes);

/// zlib.
std::string deflated(const std::string& bytes);
/// `size`: of what was deflated. Throws InputError if the bytes are damaged.
std::string inflated(const std::string& bytes, std::int64_t size);

/// The genes' bounds of runs, each read once.
class GenesOfRuns {
 public:
  explicit GenesOfRuns(const Connection& connection) : connection_(connection) {}
  const std::vector<GeneBounds>& of(Id run);
  const Connection& connection() const { return connection_; }

 private:
  const Connection& connection_;
  std::map<Id, std::vector<GeneBounds>> known_;
};

}  // namespace btr
