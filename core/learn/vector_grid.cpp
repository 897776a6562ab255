#include "core/learn/vector_grid.h"

#include <algorithm>
#include <cmath>

#include "core/spec/error.h"
#include "core/spec/require.h"

namespace btr {
namespace {

/// Between which two values of an axis a coordinate lies, and where between them.
struct Place {
  std::size_t lower = 0, upper = 0;
  double share = 0;  ///< 0 at the lower, 1 at the upper one
};

Place placeOn(const std::vector<double>& axis, double value, const char* name) {
  if (!(value >= axis.front() && value <= axis.back()))
    throw InputError(name, toText(value),
                     axis.size() == 1 ? "only " + toText(axis.front()) + ", the one value of the grid"
                                      : toText(axis.front()) + " to " + toText(axis.back()) + ", inside the grid");
  const auto upper = static_cast<std::size_t>(std::ranges::lower_bound(axis, value) - axis.begin());
  if (axis[upper] == value) return {upper, upper, 0};
  return {upper - 1, upper, (value - axis[upper - 1]) / (axis[upper] - axis[upper - 1])};
}

}  // namespace

VectorGrid::VectorGrid(std::array<std::vector<double>, 3> axes, std::vector<Parameter> genotype,
                       std::vector<std::vector<double>> vectors)
    : axes_(std::move(axes)), genotype_(std::move(genotype)), vectors_(std::move(vectors)) {
  require(vectors_.size() == axes_[0].size() * axes_[1].size() * axes_[2].size(),
          "a vector for each point of the grid");
}

std::vector<double> VectorGrid::at(const Point& point, std::span<const char* const, 3> names) const {
  std::array<Place, 3> places;
  for (std::size_t axis = 0; axis < 3; ++axis) places[axis] = placeOn(axes_[axis], point[axis], names[axis]);
  std::vector<double> result(genotype_.size(), 0.0);
  for (unsigned corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::size_t index = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool upper = (corner >> axis & 1u) != 0;
      weight *= upper ? places[axis].share : 1 - places[axis].share;
      index = index * axes_[axis].size() + (upper ? places[axis].upper : places[axis].lower);
    }
    if (weight == 0) continue;
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += weight * vectors_[index][i];
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (genotype_[i].integer || !genotype_[i].choices.empty()) result[i] = std::round(result[i]);
    result[i] = std::clamp(result[i], genotype_[i].minimum, genotype_[i].maximum);
  }
  return result;
}

double similarity(std::span<const Parameter> genotype, std::span<const double> a, std::span<const double> b) {
  require(a.size() == genotype.size() && b.size() == genotype.size(), "a value for each gene");
  double squares = 0;
  int counted = 0;
  for (std::size_t i = 0; i < genotype.size(); ++i) {
    const double range = genotype[i].maximum - genotype[i].minimum;
    if (!(range > 0)) continue;
    const double difference = (a[i] - b[i]) / range;
    squares += difference * difference;
    ++counted;
  }
  return counted == 0 ? 1 : 1 - std::sqrt(squares / counted);
}

double weightedFitness(double fitness, double similarity, double strength) {
  const double factor = std::pow(std::max(similarity, 0.0), strength);
  return fitness >= 0 ? fitness * factor : fitness * (2 - factor);
}

}  // namespace btr
