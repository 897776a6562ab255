#include "core/gap/search/screening/search_discoveries.h"

#include <algorithm>
#include <numeric>

namespace btr {

std::vector<double> falseDiscoveryRates(const std::vector<double>& pValues) {
  std::vector<std::size_t> order(pValues.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return pValues[a] < pValues[b]; });
  std::vector<double> rates(pValues.size(), 1);
  const auto count = static_cast<double>(pValues.size());
  double least = 1;
  for (std::size_t rank = order.size(); rank > 0; --rank) {
    least = std::min(least, pValues[order[rank - 1]] * count / static_cast<double>(rank));
    rates[order[rank - 1]] = least;
  }
  return rates;
}

}  // namespace btr
