#include "core/store/gene_bounds.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <optional>

#include "core/learn/bit_coding.h"
#include "core/store/packing.h"

namespace btr {
namespace {

using Seen = std::map<std::uint32_t, double>;  ///< the gene's number and the parameter it became

double atDigits(double value, int digits, double range) {
  if (std::abs(value) < 1e-12 * range) return 0;
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return std::strtod(text, nullptr);
}

std::string binary(std::uint32_t number, std::size_t bits) {
  std::string text;
  for (std::size_t bit = bits; bit-- > 0;) text += (number >> bit & 1u) != 0 ? '1' : '0';
  return text;
}

bool explains(const GeneBounds& gene, const Seen& seen, std::size_t bits) {
  for (const auto& [number, value] : seen) {
    const std::vector<double> decoded = decodedGenes(binary(number, bits), {gene}, false);
    if (decoded.size() != 1 || decoded[0] != value || std::signbit(decoded[0]) != std::signbit(value)) return false;
  }
  return true;
}

// The line through the outermost points, its ends as the decimal numbers that people write, or as whole ones.
std::optional<GeneBounds> boundsOf(const Seen& seen, std::size_t bits) {
  const auto [firstNumber, first] = *seen.begin();
  const auto [lastNumber, last] = *seen.rbegin();
  if (firstNumber == lastNumber) return GeneBounds{first, first, false};
  const double largest = std::exp2(static_cast<double>(bits)) - 1;
  const double range = (last - first) * largest / (lastNumber - firstNumber);
  const double minimum = first - range * (firstNumber / largest), maximum = minimum + range;
  if (!std::isfinite(range)) return std::nullopt;
  for (const int digits : {6, 9, 12, 15}) {
    const GeneBounds gene{atDigits(minimum, digits, range), atDigits(maximum, digits, range), false};
    if (explains(gene, seen, bits)) return gene;
  }
  constexpr int near = 3;
  for (int low = -near; low <= near; ++low)
    for (int high = -near; high <= near; ++high) {
      const GeneBounds gene{std::round(minimum) + low + 0.0, std::round(maximum) + high + 0.0, true};
      if (explains(gene, seen, bits)) return gene;
    }
  return std::nullopt;
}

}  // namespace

struct GeneBoundsFinder::Genes {
  BitCoding::Kind kind;
  bool fits = true;
  std::vector<Seen> seen;
};

GeneBoundsFinder::GeneBoundsFinder()
    : codings_{{BitCoding::Kind::binary, true, {}}, {BitCoding::Kind::gray, true, {}}} {}
GeneBoundsFinder::~GeneBoundsFinder() = default;

void GeneBoundsFinder::show(const std::string& chromosome, const std::vector<double>& parameters) {
  if (chromosome.empty()) return;
  if (length_ == 0) {
    length_ = chromosome.size();
    parameters_ = parameters.size();
    fits_ = parameters_ > 0 && length_ % parameters_ == 0 && length_ / parameters_ <= 32;
    for (Genes& genes : codings_) genes.seen.resize(parameters_);
  }
  fits_ = fits_ && chromosome.size() == length_ && parameters.size() == parameters_ &&
          chromosome.find_first_not_of("01") == std::string::npos;
  if (!fits_) return;
  const std::size_t bits = length_ / parameters_;
  for (Genes& genes : codings_)
    for (std::size_t k = 0; genes.fits && k < parameters_; ++k) {
      const std::uint32_t number = geneNumber(std::string_view(chromosome).substr(k * bits, bits), genes.kind);
      genes.fits = genes.seen[k].try_emplace(number, parameters[k]).first->second == parameters[k];
    }
}

std::vector<GeneBounds> GeneBoundsFinder::bounds() const {
  if (!fits_ || length_ == 0) return {};
  const std::size_t bits = length_ / parameters_;
  for (const Genes& genes : codings_) {
    std::vector<GeneBounds> all;
    for (std::size_t k = 0; genes.fits && k < parameters_; ++k) {
      const std::optional<GeneBounds> gene = boundsOf(genes.seen[k], bits);
      if (!gene) break;
      all.push_back(*gene);
    }
    if (all.size() == parameters_) return all;
  }
  return {};
}

}  // namespace btr
