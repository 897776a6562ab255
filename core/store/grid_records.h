#pragma once
#include <array>

#include "core/store/records.h"

// A grid of experiments that differ in their task, as plain values. Cells are numbered 1, 2, … in the order of the
// grid's points, the last axis running fastest; 0 means none. Every cell has a run of its own, an ordinary one.
namespace btr {

struct GridRecord {
  Id id = 0;
  Id experiment = 0;  ///< that its cells' runs belong to
  std::string name;
  std::string method;  ///< "independent", "contamination", "similarity"
  std::uint64_t seed = 0;
  std::string specJson;  ///< toJsonText(GridSpec): without methods and seeds
  std::string
      specSha256;  ///< of specJson and of what its runs depend on: the same with method and seed is the same grid
  std::string createdAt;
};

struct GridCellRecord {
  int number = 0;
  std::array<double, 3> task{};  ///< distance [m], bearing and direction [rad]
  int mirrorOf = 0;              ///< the cell whose mirror image it is; 0: it learns by itself
  Id run = 0;                    ///< 0: not begun
  int begunAt = 0;               ///< the cell whose good point its population began around
  Id begunAtIndividual = 0;      ///< that point; if that cell is a mirrored one, the individual that was mirrored
};

/// A run that begins for a cell.
struct GridStart {
  int cell = 0;
  int begunAt = 0;  ///< as in GridCellRecord
  Id begunAtIndividual = 0;
  RunRecord run;
  SimulatorRecord simulator;
  std::string note;
};

/// The best that a cell has after a generation.
struct GridBest {
  int cell = 0;
  int generation = 0;
  Id individual = 0;
  double similarity = 1;  ///< mean to the neighbours' bests of the round before; 1 if there were none
};

/// A cell's next generation; its best is an earlier individual or, with the id 0, the one in `slot`.
struct GridStep {
  GenerationRecord generation;
  GridBest best;
  int slot = -1;
};

/// What a cell ends with.
struct GridSolution {
  int cell = 0;
  Id individual = 0;       ///< of the cell's own run
  Id own = 0;              ///< the best that the cell learned; 0 of a mirrored cell
  bool failed = false;     ///< that one stayed below the threshold; of a mirrored cell: its source's did
  int takenFrom = 0;       ///< the cell whose solution it took; 0: it kept its own, or the image of its source's
  Id takenIndividual = 0;  ///< what was taken; if that cell is a mirrored one, the individual that was mirrored
};

/// A solution and, where it had to be simulated, the generation that holds it: then its individual is that in `slot`.
struct GridSettlement {
  GridSolution solution;
  std::optional<GenerationRecord> generation;
  int slot = -1;
};

/// A kick between the cells.
struct GridPoint {
  int number = 0;  ///< 1, 2, …
  std::array<double, 3> task{};
  std::vector<double> parameters;
  double fitness = 0;
  std::string outcome = "finished";
  Values figures;  ///< what else the fitness plugin tells of it
};

}  // namespace btr
