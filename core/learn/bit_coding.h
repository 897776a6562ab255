#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/spec/parameter.h"
#include "core/spec/random.h"

namespace btr {

/// A parameter vector as one string of '0' and '1': the same number of bits for each parameter, most significant first.
/// A gene of b bits with the number v means p = minimum + (maximum − minimum)·v/(2^b − 1), whole parameters are
/// rounded.
class BitCoding {
 public:
  enum class Kind { binary, gray };

  BitCoding() = default;
  /// `bits` 1 … 32 for each parameter.
  BitCoding(std::vector<Parameter> genotype, int bits, Kind kind);

  std::size_t length() const { return genotype_.size() * bits_; }  ///< bits of a chromosome
  /// True if `text` is a chromosome of this coding.
  bool fits(std::string_view text) const;
  /// The parameters, each within its bounds. `chromosome` must fit.
  std::vector<double> decode(std::string_view chromosome) const;
  /// The chromosome that decodes nearest to `parameters`, one for each of the genotype; what is out of bounds counts as
  /// the bound.
  std::string encode(std::span<const double> parameters) const;
  /// A chromosome of independent fair bits.
  std::string draw(Random& random) const;

 private:
  std::vector<Parameter> genotype_;
  std::size_t bits_ = 8;
  Kind kind_ = Kind::binary;
};

/// The number that a gene stands for.
std::uint32_t geneNumber(std::string_view gene, BitCoding::Kind kind);

}  // namespace btr
