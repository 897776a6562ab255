#pragma once
#include <vector>

namespace btr {

/// Adjusted p-values of tests that were made together, in their order: whoever believes those up to q is wrong in a
/// share q of them on average. After Benjamini and Hochberg, J. R. Stat. Soc. B 57 (1995) 289: the least of p·m/rank
/// over the ranks from one's own on, at most 1.
std::vector<double> falseDiscoveryRates(const std::vector<double>& pValues);

}  // namespace btr
