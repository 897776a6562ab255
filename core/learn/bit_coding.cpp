#include "core/learn/bit_coding.h"

#include <algorithm>
#include <cmath>

#include "core/spec/require.h"

namespace btr {

std::uint32_t geneNumber(std::string_view gene, BitCoding::Kind kind) {
  std::uint32_t number = 0;
  std::uint32_t bit = 0;
  for (const char letter : gene) {
    const std::uint32_t given = letter == '1' ? 1u : 0u;
    // Gray: each bit says whether the binary digit changes.
    bit = kind == BitCoding::Kind::gray ? bit ^ given : given;
    number = number << 1 | bit;
  }
  return number;
}

BitCoding::BitCoding(std::vector<Parameter> genotype, int bits, Kind kind)
    : genotype_(std::move(genotype)), bits_(static_cast<std::size_t>(bits)), kind_(kind) {
  require(bits >= 1 && bits <= 32, "1 to 32 bits a gene");
}

bool BitCoding::fits(std::string_view text) const {
  return text.size() == length() && text.find_first_not_of("01") == std::string_view::npos;
}

std::vector<double> BitCoding::decode(std::string_view chromosome) const {
  require(fits(chromosome), "a chromosome of the genotype's length");
  const double largest = std::exp2(static_cast<double>(bits_)) - 1;
  std::vector<double> parameters;
  parameters.reserve(genotype_.size());
  for (std::size_t i = 0; i < genotype_.size(); ++i) {
    const Parameter& p = genotype_[i];
    const double number = geneNumber(chromosome.substr(i * bits_, bits_), kind_);
    double value = p.minimum + (p.maximum - p.minimum) * (number / largest);
    if (p.integer || !p.choices.empty()) value = std::round(value);
    parameters.push_back(std::clamp(value, p.minimum, p.maximum));
  }
  return parameters;
}

std::string BitCoding::encode(std::span<const double> parameters) const {
  require(parameters.size() == genotype_.size(), "a value for each gene");
  const double largest = std::exp2(static_cast<double>(bits_)) - 1;
  std::string chromosome;
  chromosome.reserve(length());
  for (std::size_t i = 0; i < genotype_.size(); ++i) {
    const Parameter& p = genotype_[i];
    const double range = p.maximum - p.minimum;
    const double share = range > 0 ? std::clamp((parameters[i] - p.minimum) / range, 0.0, 1.0) : 0;
    auto number = static_cast<std::uint32_t>(std::lround(share * largest));
    if (kind_ == Kind::gray) number ^= number >> 1;
    for (std::size_t bit = bits_; bit-- > 0;) chromosome += (number >> bit & 1u) != 0 ? '1' : '0';
  }
  return chromosome;
}

std::string BitCoding::draw(Random& random) const {
  std::string chromosome(length(), '0');
  for (char& bit : chromosome) bit = random.next() >> 63 ? '1' : '0';
  return chromosome;
}

}  // namespace btr
