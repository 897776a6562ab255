#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/spec/parameter.h"

namespace btr {

/// Parameter vectors at the points of a three-dimensional grid, and between them by trilinear interpolation:
///   p(u) = Σ over the corners c of u's cell of  p_c · Π over the axes a of (t_a or 1 − t_a),
///   t_a = (u_a − lower_a)/(upper_a − lower_a)
/// Exact at the points; inside a cell linear along each axis. A whole parameter is rounded afterwards, halves away from
/// zero, as a controller does that takes the nearest whole number.
class VectorGrid {
 public:
  using Point = std::array<double, 3>;
  /// `axes`: strictly ascending, at least one value each; `vectors`: one for each point, the last axis runs fastest;
  /// all of the genotype's length.
  VectorGrid(std::array<std::vector<double>, 3> axes, std::vector<Parameter> genotype,
             std::vector<std::vector<double>> vectors);

  /// Throws InputError, naming the axis by `names`, for a point outside the grid.
  std::vector<double> at(const Point& point, std::span<const char* const, 3> names) const;
  const std::array<std::vector<double>, 3>& axes() const { return axes_; }

 private:
  std::array<std::vector<double>, 3> axes_;
  std::vector<Parameter> genotype_;
  std::vector<std::vector<double>> vectors_;
};

/// How alike two vectors of a genotype are: 1 − √(mean over the parameters of ((a − b)/range)²). 1: equal; 0: opposite
/// ends of every range; two drawn ones 0.6 on average. A parameter without range does not count.
double similarity(std::span<const Parameter> genotype, std::span<const double> a, std::span<const double> b);

/// Fitness times similarity^strength; negative fitness f becomes f·(2 − similarity^strength), so that being alike is
/// better there, too.
double weightedFitness(double fitness, double similarity, double strength);

}  // namespace btr
