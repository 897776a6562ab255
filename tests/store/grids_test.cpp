// Grids: what is stored comes back, a round is all or nothing, and what was found is kept.
#include <SQLiteCpp/SQLiteCpp.h>

#include "core/store/migrations.h"
#include "tests/store/store_fixture.h"

namespace btr {
namespace {

using testing::HasSubstr;

class Grids : public StoreTest {
 protected:
  Grids() : database_(create()), experiment_(database_.addExperiment(kickExperiment())) {
    grid_ =
        database_.addGrid(record(), {{2, {0.14, 0.5, 0}, 0, 0, 0, 0}, {1, {0.14, -0.5, 0}, 2, 0, 0, 0}}, {start(2)});
  }
  GridRecord record() const { return {0, experiment_, "whole", "similarity", 0xfedcba9876543210u, "{}", "hash", ""}; }
  GridStart start(int cell) const {
    GridStart start;
    start.cell = cell;
    start.run = runOf(experiment_, static_cast<std::uint64_t>(cell));
    start.note = "cell " + std::to_string(cell);
    return start;
  }
  Id runOfCell(int cell) const { return database_.gridCells(grid_)[static_cast<std::size_t>(cell - 1)].run; }
  GridStep step(int cell, int number, int slot) const {
    GridStep step;
    step.generation = generationOf(runOfCell(cell), number, 3, 2);
    step.generation.simulator = database_.latestSimulator(runOfCell(cell)).id;
    step.best = {cell, 0, 0, 0.75};
    step.slot = slot;
    return step;
  }

  Database database_;
  Id experiment_, grid_ = 0;
};

TEST_F(Grids, AreReadBackAsTheyWereStored) {
  const GridRecord grid = database_.grid(grid_);
  EXPECT_EQ(grid.name, "whole");
  EXPECT_EQ(grid.method, "similarity");
  EXPECT_EQ(grid.seed, 0xfedcba9876543210u);
  EXPECT_EQ(database_.grids().size(), 1u);
  EXPECT_EQ(database_.findGrid("hash", "similarity", grid.seed), grid_);
  EXPECT_FALSE(database_.findGrid("hash", "independent", grid.seed));
  const std::vector<GridCellRecord> cells = database_.gridCells(grid_);
  ASSERT_EQ(cells.size(), 2u);
  EXPECT_EQ(cells[0].number, 1);
  EXPECT_EQ(cells[0].mirrorOf, 2);
  EXPECT_EQ(cells[0].run, 0);
  EXPECT_EQ(cells[0].task[1], -0.5);
  EXPECT_NE(cells[1].run, 0);
  EXPECT_EQ(database_.run(cells[1].run).note, "cell 2");
  EXPECT_EQ(database_.gridOfRun(cells[1].run), grid_);
}

TEST_F(Grids, OneOfASpecMethodAndSeedExists) {
  EXPECT_NE("accepted", refusal([&] { database_.addGrid(record(), {}, {}); }));
  EXPECT_EQ(database_.grids().size(), 1u);
}

TEST_F(Grids, ARunOfACellIsNotFoundAsAnOrdinaryRun) {
  EXPECT_FALSE(database_.findRun("abc", 2));
  const Id ordinary = database_.addRun(runOf(experiment_, 2), SimulatorRecord{});
  EXPECT_EQ(database_.findRun("abc", 2), ordinary);
  EXPECT_FALSE(database_.gridOfRun(ordinary));
}

TEST_F(Grids, ARoundIsStoredWholeOrNotAtAll) {
  std::vector<GridStep> steps{step(2, 1, 1)};
  database_.addGridRound(grid_, steps);
  const std::vector<GridBest> bests = database_.gridBests(grid_);
  ASSERT_EQ(bests.size(), 1u);
  EXPECT_EQ(bests[0].generation, 1);
  EXPECT_EQ(bests[0].individual, steps[0].generation.individuals[1].id);
  EXPECT_EQ(bests[0].individual, steps[0].best.individual);
  EXPECT_EQ(bests[0].similarity, 0.75);

  // An earlier individual stays the best; a second step that is wrong takes the first one with it.
  std::vector<GridStep> next{step(2, 2, -1), step(2, 7, 0)};
  next[0].best.individual = bests[0].individual;
  EXPECT_THAT(refusal([&] { database_.addGridRound(grid_, next); }), HasSubstr("generation 7"));
  EXPECT_EQ(database_.gridBests(grid_).size(), 1u);
  EXPECT_EQ(database_.generations(runOfCell(2)).size(), 1u);
  next.pop_back();
  database_.addGridRound(grid_, next);
  EXPECT_EQ(database_.gridBests(grid_)[1].individual, bests[0].individual);
}

TEST_F(Grids, SolutionsFinishTheirRunsAndSayWhereTheyComeFrom) {
  std::vector<GridStep> steps{step(2, 1, 1)};
  database_.addGridRound(grid_, steps);
  const Id best = steps[0].best.individual;
  std::vector<GridSettlement> own{{{2, best, best, true, 0, 0}, {}, -1}};
  database_.settleGrid(grid_, own);
  EXPECT_EQ(database_.run(runOfCell(2)).state, RunState::finished);

  database_.beginGridCells(grid_, {start(1)});
  GridSettlement mirrored;
  mirrored.solution = {1, 0, 0, true, 2, best};
  mirrored.generation = step(1, 1, 0).generation;
  mirrored.slot = 2;
  std::vector<GridSettlement> settled{mirrored};
  database_.settleGrid(grid_, settled);
  const std::vector<GridSolution> solutions = database_.gridSolutions(grid_);
  ASSERT_EQ(solutions.size(), 2u);
  EXPECT_EQ(solutions[0].individual, settled[0].generation->individuals[2].id);
  EXPECT_EQ(solutions[0].own, 0);
  EXPECT_EQ(solutions[0].takenFrom, 2);
  EXPECT_EQ(solutions[0].takenIndividual, best);
  EXPECT_TRUE(solutions[1].failed);
  EXPECT_EQ(solutions[1].takenFrom, 0);
}

TEST_F(Grids, ASolutionIsAnIndividualOfItsOwnCell) {
  std::vector<GridStep> steps{step(2, 1, 1)};
  database_.addGridRound(grid_, steps);
  database_.beginGridCells(grid_, {start(1)});
  std::vector<GridSettlement> wrong{{{1, steps[0].best.individual, 0, false, 0, 0}, {}, -1}};
  EXPECT_NE("accepted", refusal([&] { database_.settleGrid(grid_, wrong); }));
  EXPECT_TRUE(database_.gridSolutions(grid_).empty());
}

TEST_F(Grids, KicksBetweenTheCellsKeepTheirBitsAndFigures) {
  database_.addGridPoints(grid_, {{1, {0.15, 0.1, -1.0 / 3}, {0.1, 1e-300}, 1.0 / 7, "finished", {{"falls", 1}}}});
  const std::vector<GridPoint> points = database_.gridPoints(grid_);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].task[2], -1.0 / 3);
  EXPECT_EQ(points[0].parameters, (std::vector{0.1, 1e-300}));
  EXPECT_EQ(points[0].fitness, 1.0 / 7);
  EXPECT_EQ(points[0].figures, (Values{{"falls", 1}}));
}

TEST_F(Grids, WhatWasFoundIsKept) {
  std::vector<GridStep> steps{step(2, 1, 1)};
  database_.addGridRound(grid_, steps);
  SQLite::Database raw(file(), SQLite::OPEN_READWRITE);
  for (const char* table : {"grid", "grid_cell", "grid_run", "grid_best"})
    EXPECT_THROW(raw.exec(std::string("DELETE FROM ") + table), SQLite::Exception) << table;
  EXPECT_THROW(raw.exec("UPDATE grid_best SET similarity = 1"), SQLite::Exception);
}

TEST_F(StoreTest, ADatabaseFromBeforeGridsIsBroughtUpToDate) {
  {
    SQLite::Database raw(file(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    migrate(raw, migrations().first(2));
  }
  EXPECT_THAT(refusal([&] { Database::open(file(), Database::Mode::readOnly); }), HasSubstr("older UCHILSIM"));
  EXPECT_TRUE(Database::open(file(), Database::Mode::readWrite).grids().empty());
}

}  // namespace
}  // namespace btr
