#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "core/spec/random.h"

namespace btr {

/// `fitness` with each value that is not finite replaced by the worst finite one; all 0 if none is finite.
std::vector<double> finiteFitness(std::span<const double> fitness);

/// Linear scaling (Goldberg 1989): f' = a·f + b keeps the average and makes the best C times the average, so that an
/// early genius does not take over and a late population still feels pressure. Where that would make the worst
/// negative, f' runs from 0 at the worst through the average instead. The result is f'/average = the expected number of
/// copies: mean 1, largest C (or less in the second case), none negative. Fitness may be of any sign and size; negative
/// fitness is shifted so that the worst is 0. All equal gives all 1.
std::vector<double> linearScaling(std::span<const double> fitness, double largestCopies);

/// Roulette wheel: draws indices with probability in proportion to their weight. Weights ≥ 0, at least one > 0.
class Roulette {
 public:
  explicit Roulette(std::span<const double> weights);
  std::size_t spin(Random& random) const;

 private:
  std::vector<double> cumulative_;
};

}  // namespace btr
