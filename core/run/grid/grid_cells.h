#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/spec/grid_spec.h"

namespace btr {

/// A point of a grid. Numbers begin at 1, the last axis runs fastest.
struct GridCell {
  int number = 0;
  std::array<std::size_t, 3> index{};  ///< on the axes
  std::array<double, 3> task{};        ///< distance [m], bearing and direction [rad]
  int mirrorOf = 0;                    ///< the cell that it is the mirror image of; 0: it learns by itself
  std::vector<int> neighbours;         ///< one step along one axis, ascending
};

/// All cells in the order of their numbers. Where the grid derives mirrored cells, those with the ball to the right
/// (β < 0), or straight ahead and the target to the right (β = 0, α < 0), mirror the cell at (d, −β, −α).
std::vector<GridCell> cellsOf(const GridSpec& grid);

/// The order in which contamination spreads: numbers of learning cells, wave by wave. The first is the cell nearest to
/// straight ahead (|β|, then |α|, then d); a wave holds the neighbours, also by mirror images, of those before it.
std::vector<std::vector<int>> wavesOf(const std::vector<GridCell>& cells);

/// Settings of the controller that are a point's task.
Values taskOf(std::span<const double, 3> point);
/// "d 0.14 m, β 30°, α −60°" for people.
std::string nameOfTask(std::span<const double, 3> point);

/// The mirror image of a motion whose parameters are named after the four legs (…_LF_… and so on), as those of kick:
/// what belongs to a left leg and what belongs to the right one change places, the rest stays. Throws InputError if no
/// parameter is named so, or one has no partner of the same range: then the controller has no such image.
std::vector<double> mirrorImage(std::span<const Parameter> genotype, std::span<const double> parameters);

}  // namespace btr
