#pragma once
#include <span>
#include <vector>

namespace btr {

/// The middle one of the values (the upper of two), 0 for none.
double median(std::vector<double> values);

/// Values on an even grid of `count` points from `start`, straight lines between the finite samples; all 0 where there
/// is none.
std::vector<double> onGrid(std::span<const double> time_s, std::span<const double> values, double start_s,
                           double period_s, std::size_t count);

}  // namespace btr
