// Trilinear interpolation against the functions that it reproduces, and similarity against arithmetic.
#include "core/learn/vector_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/spec/error.h"

namespace btr {
namespace {

using ::testing::HasSubstr;

constexpr std::array<const char*, 3> names{"distance_m", "bearing_rad", "direction_rad"};

Parameter parameter(const std::string& name, bool whole = false) { return {name, "", "", -1000, 1000, 0, {}, whole}; }

/// A grid of unequal steps whose vectors are `values(x, y, z)`.
template <class Function>
VectorGrid gridOf(const Function& values, std::vector<Parameter> genotype) {
  const std::array<std::vector<double>, 3> axes{{{0.14, 0.18}, {-0.5, 0.1, 0.5}, {-1, -0.3, 0, 0.8, 1}}};
  std::vector<std::vector<double>> vectors;
  for (const double x : axes[0])
    for (const double y : axes[1])
      for (const double z : axes[2]) vectors.push_back(values(x, y, z));
  return VectorGrid(axes, std::move(genotype), std::move(vectors));
}

TEST(VectorGrid, IsExactAtItsPoints) {
  const auto wild = [](double x, double y, double z) {
    return std::vector{std::sin(1e3 * x) / 3, std::exp(5 * y), std::cbrt(z)};
  };
  const VectorGrid grid = gridOf(wild, {parameter("a"), parameter("b"), parameter("c")});
  for (const double x : grid.axes()[0])
    for (const double y : grid.axes()[1])
      for (const double z : grid.axes()[2]) EXPECT_EQ(grid.at({x, y, z}, names), wild(x, y, z));
}

TEST(VectorGrid, ReproducesWhatIsLinearAlongEachAxis) {
  const auto multilinear = [](double x, double y, double z) {
    return std::vector{1 + 2 * x - 3 * y + 0.5 * z, x * y - y * z + 2 * x * z, 7 * x * y * z};
  };
  const VectorGrid grid = gridOf(multilinear, {parameter("a"), parameter("b"), parameter("c")});
  for (double x = 0.14; x < 0.18; x += 0.007)
    for (double y = -0.5; y < 0.5; y += 0.09)
      for (double z = -1; z < 1; z += 0.13) {
        const std::vector<double> found = grid.at({x, y, z}, names), wanted = multilinear(x, y, z);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], wanted[i], 1e-14);
      }
}

TEST(VectorGrid, IsContinuousAcrossItsPlanes) {
  const VectorGrid grid =
      gridOf([](double x, double y, double z) { return std::vector{x * x + y * y * y - z * z}; }, {parameter("a")});
  for (const double y : {-0.49, 0.3}) {
    const double below = grid.at({0.15, y, std::nextafter(0.0, -1.0)}, names)[0];
    EXPECT_NEAR(below, grid.at({0.15, y, 0}, names)[0], 1e-15);
  }
}

TEST(VectorGrid, WholeParametersAreRoundedToTheNearest) {
  const VectorGrid grid = gridOf(
      [](double, double, double z) {
        return std::vector{z > 0.5 ? 4.0 : 3.0, z};
      },
      {parameter("points", true), parameter("b")});
  EXPECT_EQ(grid.at({0.14, 0.1, 0.39}, names)[0], 3);  // 3.4875
  EXPECT_EQ(grid.at({0.14, 0.1, 0.4}, names)[0], 4);   // halves go up, as in std::lround
  EXPECT_NEAR(grid.at({0.14, 0.1, 0.4}, names)[1], 0.4, 1e-15);
}

std::string complaint(const VectorGrid& grid, const VectorGrid::Point& point) {
  try {
    grid.at(point, names);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(VectorGrid, APointOutsideIsRefusedWithItsAxisAndRange) {
  const VectorGrid grid = gridOf([](double, double, double) { return std::vector{0.0}; }, {parameter("a")});
  EXPECT_EQ(complaint(grid, {0.18, 0.5, -1}), "accepted");
  EXPECT_THAT(complaint(grid, {0.13, 0, 0}), HasSubstr("distance_m: 0.13 is not allowed; 0.14 to 0.18"));
  EXPECT_THAT(complaint(grid, {0.15, 0.51, 0}), HasSubstr("bearing_rad"));
  EXPECT_THAT(complaint(grid, {0.15, 0, NAN}), HasSubstr("direction_rad"));
}

TEST(VectorGrid, AnAxisOfOneValueHasNothingBetween) {
  const VectorGrid grid({{{0.14}, {0}, {-1, 1}}}, {parameter("a")}, {{2.0}, {4.0}});
  EXPECT_EQ(grid.at({0.14, 0, 0}, names)[0], 3);
  EXPECT_THAT(complaint(grid, {0.15, 0, 0}), HasSubstr("only 0.14"));
}

TEST(Similarity, IsOneMinusTheRootOfTheMeanSquareInRanges) {
  const std::vector<Parameter> genotype{{"a", "", "", 0, 10, 0}, {"b", "", "", -1, 1, 0}, {"fixed", "", "", 3, 3, 3}};
  const std::vector<double> low{0, -1, 3}, high{10, 1, 3}, middle{5, 0, 3};
  EXPECT_EQ(similarity(genotype, low, low), 1);
  EXPECT_EQ(similarity(genotype, low, high), 0);
  EXPECT_EQ(similarity(genotype, low, middle), 0.5);
  EXPECT_NEAR(similarity(genotype, low, std::vector<double>{10, -1, 3}), 1 - std::sqrt(0.5), 1e-15);
}

TEST(Similarity, WeighsFitnessSoThatBeingAlikeIsNeverWorse) {
  EXPECT_EQ(weightedFitness(2, 1, 5), 2);
  EXPECT_EQ(weightedFitness(2, 0.5, 2), 0.5);
  EXPECT_EQ(weightedFitness(2, 0.5, 0), 2);
  EXPECT_EQ(weightedFitness(-2, 1, 5), -2);
  EXPECT_EQ(weightedFitness(-2, 0.5, 1), -3);
  for (const double fitness : {-1.0, 1.0})
    EXPECT_GT(weightedFitness(fitness, 0.7, 2), weightedFitness(fitness, 0.6, 2));
}

}  // namespace
}  // namespace btr
