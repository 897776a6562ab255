#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

namespace btr {

/// Thins a curve to what can be drawn: of each run of neighbouring points in the same bucket the first, lowest, highest
/// and last are taken, in their order, so that no peak is lost. `bucket(i)` may be of any type that can be compared,
/// `value(i)` is a number; the points are `first` … `last` − 1.
template <class Bucket, class Value, class Take>
void thin(std::size_t first, std::size_t last, const Bucket& bucket, const Value& value, const Take& take) {
  while (first < last) {
    const auto here = bucket(first);
    std::size_t end = first + 1, lowest = first, highest = first;
    for (; end < last && bucket(end) == here; ++end) {
      if (value(end) < value(lowest)) lowest = end;
      if (value(end) > value(highest)) highest = end;
    }
    const std::array<std::size_t, 4> chosen{first, std::min(lowest, highest), std::max(lowest, highest), end - 1};
    for (std::size_t k = 0; k < chosen.size(); ++k)
      if (k == 0 || chosen[k] != chosen[k - 1]) take(chosen[k]);
    first = end;
  }
}

}  // namespace btr
