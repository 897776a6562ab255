#include "core/learn/variation.h"

#include <algorithm>

#include "core/spec/require.h"

namespace btr {

Cuts drawCuts(std::size_t length, Random& random) {
  require(length >= 3, "cuts of at least 3 bits");
  const std::size_t first = 1 + random.below(length - 1);
  std::size_t second = 1 + random.below(length - 2);
  if (second >= first) ++second;  // never the same place
  return {std::min(first, second), std::max(first, second)};
}

void exchange(std::string& one, std::string& other, const Cuts& cuts) {
  require(one.size() == other.size() && cuts.first <= cuts.second && cuts.second <= one.size(),
          "parents of one length, and cuts within it");
  const auto at = [](std::string& text, std::size_t place) {
    return text.begin() + static_cast<std::ptrdiff_t>(place);
  };
  std::swap_ranges(at(one, cuts.first), at(one, cuts.second), at(other, cuts.first));
}

void mutate(std::string& bits, double probability, Random& random) {
  for (char& bit : bits)
    if (random.chance(probability)) bit = bit == '0' ? '1' : '0';
}

}  // namespace btr
