#pragma once
#include <vector>

#include "core/spec/parameter.h"
#include "core/spec/random.h"

namespace btr::test {

/// Halfway between the bounds of each locus.
inline std::vector<double> middleOf(const std::vector<Parameter>& loci) {
  std::vector<double> middle;
  for (const Parameter& p : loci) middle.push_back((p.minimum + p.maximum) / 2);
  return middle;
}

/// Anywhere between the bounds of each locus.
inline std::vector<double> drawnFrom(const std::vector<Parameter>& loci, Random& random) {
  std::vector<double> drawn;
  for (const Parameter& p : loci) drawn.push_back(random.uniform(p.minimum, p.maximum));
  return drawn;
}

}  // namespace btr::test
