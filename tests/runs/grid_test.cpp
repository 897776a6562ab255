// Grids: learned cell by cell in the database, the same bits whatever happens, and every number follows from what is
// stored.
#include "core/run/grid/grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <map>
#include <nlohmann/json.hpp>

#include "core/run/grid/grid_cells.h"
#include "core/run/grid/grid_kicks.h"
#include "core/run/grid/grid_table.h"
#include "core/spec/error.h"
#include "core/spec/experiment_spec.h"
#include "core/spec/json_reader.h"
#include "tests/runs/child_program.h"
#include "tests/temporary_folder.h"

namespace btr {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

/// Two distances, three bearings, one direction: four cells learn, two are mirrored. Populations of four.
class SmallGrid : public testing::Test {
 protected:
  SmallGrid() {
    json experiment = json::parse(readFile(SOURCE_DIR "/resources/experiments/kick-short.json"));
    experiment["scene"] = SOURCE_DIR "/resources/scenes/kick.json";
    experiment["learner"]["settings"]["population"] = 4;
    folder_.write("kick.json", experiment.dump());
    text_ = {{"format", "uchilsim-grid-1"},
             {"name", "small"},
             {"experiment", "kick.json"},
             {"distances_m", {0.14, 0.16}},
             {"bearings_rad", {-0.3, 0, 0.3}},
             {"directions_rad", {0}},
             {"methods", {"independent", "contamination", "similarity"}},
             {"seeds", {3}},
             {"settings", {{"generations", 3}, {"failure_threshold", 0.05}, {"points", 3}}}};
  }
  GridSpec spec() { return loadGrid(folder_.write("grid.json", text_.dump())); }
  Database open(const std::string& name) { return Database::open(folder_.file(name), Database::Mode::create); }
  Id run(Database& database, GridSpec::Method method, int workers = 2) {
    const Id grid = startGrid(database, host_, spec(), method, 3);
    EXPECT_EQ(continueGrid(database, host_, grid, StopFlag{false},
                           {.workers = workers, .workforce = nullptr, .progress = {}}),
              RunEnd::finished);
    return grid;
  }
  /// All results of a database's grids as text; times are none.
  static std::string results(const std::string& path) {
    const Database db = Database::open(path, Database::Mode::readOnly);
    json all;
    for (const GridRecord& grid : db.grids()) {
      for (const GridCellRecord& c : db.gridCells(grid.id)) {
        all["cells"].push_back({c.number, c.task, c.mirrorOf, c.run, c.begunAt, c.begunAtIndividual});
        if (c.run == 0) continue;
        const RunRecord run = db.run(c.run);
        all["runs"].push_back({run.seed, run.specSha256, toText(run.state), run.generation});
        for (const IndividualRecord& i : db.individuals(c.run))
          all["individuals"].push_back({i.id, i.generation, i.slot, i.chromosome, i.parameters, i.fitness, i.outcome,
                                        i.detail, i.sameAs, i.trialSeed, i.traceSha256});
        if (const auto last = db.lastGeneration(c.run))
          all["states"].push_back({last->randomState, last->learnerState});
      }
      for (const GridBest& b : db.gridBests(grid.id))
        all["bests"].push_back({b.cell, b.generation, b.individual, b.similarity});
      for (const GridSolution& s : db.gridSolutions(grid.id))
        all["solutions"].push_back({s.cell, s.individual, s.own, s.failed, s.takenFrom, s.takenIndividual});
      for (const GridPoint& p : db.gridPoints(grid.id))
        all["points"].push_back({p.number, p.task, p.parameters, p.fitness, p.outcome, p.figures});
    }
    return all.dump();
  }

  TemporaryFolder folder_;
  PluginHost host_{PLUGIN_DIR};
  const std::vector<Parameter> genotype_ = host_.controller("kick")->genotype();
  json text_;
};

TEST_F(SmallGrid, IsFoundAgainAndItsRunsAreOrdinaryOnes) {
  Database db = open("a.db");
  const Id grid = run(db, GridSpec::Method::independent);
  EXPECT_TRUE(isGridFinished(db, grid));
  EXPECT_EQ(run(db, GridSpec::Method::independent), grid);
  EXPECT_EQ(db.runs().size(), 6u);
  EXPECT_EQ(db.experiments().size(), 1u);
  const std::vector<GridCellRecord> cells = db.gridCells(grid);
  for (const GridSolution& s : db.gridSolutions(grid)) {
    const GridCellRecord& cell = cells[static_cast<std::size_t>(s.cell - 1)];
    EXPECT_EQ(db.run(cell.run).state, RunState::finished);
    EXPECT_TRUE(replay(db, host_, cell.run, s.individual).identical) << "cell " << s.cell;
    const ExperimentSpec of = experimentFromJson(db.run(cell.run).specJson, "run", "");
    EXPECT_EQ(of.controller.settings.at("bearing_rad"), cell.task[1]);
    if (cell.mirrorOf == 0) {
      EXPECT_GE(db.generations(cell.run).size(), 3u);
      continue;
    }
    // The image of its source's solution.
    const Id source = db.gridSolutions(grid)[static_cast<std::size_t>(cell.mirrorOf - 1)].individual;
    EXPECT_EQ(db.individual(s.individual).parameters, mirrorImage(genotype_, db.individual(source).parameters));
  }
}

TEST_F(SmallGrid, ACellKeepsItsBestAndAFailedOneTakesTheNeighboursThatDoesBestInIt) {
  // So near to each other that a kick which is good at one place is at the next.
  text_["distances_m"] = {0.14, 0.142};
  text_["bearings_rad"] = {-0.02, 0, 0.02};
  text_["settings"]["generations"] = 1;
  text_["settings"]["points"] = 0;
  // First which fitness the cells reach, then a threshold that the best alone passes.
  Database first = open("first.db");
  std::vector<double> own;
  for (const GridRow& row : summaryOf(first, host_, run(first, GridSpec::Method::independent)).rows)
    if (row.mirrorOf == 0) own.push_back(row.ownFitness);
  std::ranges::sort(own);
  const auto good = std::ranges::lower_bound(own, own.back());
  ASSERT_NE(good, own.begin()) << "all cells are equally good";
  const double threshold = (good[-1] + own.back()) / 2;
  text_["settings"]["failure_threshold"] = threshold;
  Database db = open("a.db");
  const Id grid = run(db, GridSpec::Method::independent);
  const GridSummary summary = summaryOf(db, host_, grid);
  const std::vector<GridCell> cells = cellsOf(spec());
  int failed = 0, taken = 0;
  for (const GridRow& row : summary.rows) {
    if (row.mirrorOf != 0) continue;
    // Its own best is the best of its generations of learning.
    double best = -1;
    for (const IndividualRecord& i : db.individuals(row.run))
      if (i.generation == 1) best = std::max(best, i.fitness);
    EXPECT_EQ(row.ownFitness, best);
    EXPECT_EQ(row.failed, best < threshold);
    if (!row.failed) {
      EXPECT_EQ(row.takenFrom, 0);
      EXPECT_EQ(row.fitness, row.ownFitness);
      continue;
    }
    ++failed;
    // Every neighbour that has not failed was tried; the best of them is taken if it is better.
    const auto& neighbours = cells[static_cast<std::size_t>(row.cell - 1)].neighbours;
    const std::vector<IndividualRecord> tried = db.individuals(row.run, 2);
    EXPECT_EQ(std::ssize(tried), std::ranges::count_if(neighbours, [&](int n) {
                const int source = cells[static_cast<std::size_t>(n - 1)].mirrorOf;
                return !summary.rows[static_cast<std::size_t>((source ? source : n) - 1)].failed;
              }));
    double highest = -1;
    for (const IndividualRecord& i : tried) highest = std::max(highest, i.fitness);
    EXPECT_EQ(row.fitness, std::max(highest, best));
    EXPECT_EQ(row.takenFrom != 0, highest > best);
    if (row.takenFrom == 0) continue;
    const GridRow& from = summary.rows[static_cast<std::size_t>(row.takenFrom - 1)];
    ++taken;
    EXPECT_THAT(neighbours, testing::Contains(row.takenFrom));
    EXPECT_EQ(row.parameters, from.parameters);
  }
  for (const GridRow& row : summary.rows) {
    const int source = row.mirrorOf;
    EXPECT_EQ(row.sourceTookFrom, source ? summary.rows[static_cast<std::size_t>(source - 1)].takenFrom : 0);
  }
  EXPECT_EQ(failed, good - own.begin());
  EXPECT_GE(taken, 1);
  EXPECT_EQ(summary.spec.axes, spec().axes);
}

TEST_F(SmallGrid, ContaminationBeginsAroundTheBestGoodNeighbour) {
  text_["settings"]["failure_threshold"] = 1e-9;  // every ball that moved was kicked well
  text_["settings"]["points"] = 0;
  Database db = open("a.db");
  const Id grid = run(db, GridSpec::Method::contamination);
  const std::vector<GridCell> cells = cellsOf(spec());
  const auto waves = wavesOf(cells);
  const std::vector<GridCellRecord> stored = db.gridCells(grid);
  const std::vector<GridSolution> solutions = db.gridSolutions(grid);
  EXPECT_EQ(stored[static_cast<std::size_t>(waves[0][0] - 1)].begunAt, 0);
  int begun = 0;
  for (std::size_t w = 1; w < waves.size(); ++w)
    for (const int number : waves[w]) {
      const GridCellRecord& cell = stored[static_cast<std::size_t>(number - 1)];
      if (cell.begunAt == 0) continue;
      ++begun;
      EXPECT_THAT(cells[static_cast<std::size_t>(number - 1)].neighbours, testing::Contains(cell.begunAt));
      // The first individual is that point, as near as 8 bits come, and the run says so itself.
      const GridCellRecord& from = stored[static_cast<std::size_t>(cell.begunAt - 1)];
      std::vector<double> point = db.individual(cell.begunAtIndividual).parameters;
      if (from.mirrorOf) point = mirrorImage(genotype_, point);
      EXPECT_EQ(db.individuals(cell.run, 1)[0].parameters, point);
      const ExperimentSpec of = experimentFromJson(db.run(cell.run).specJson, "run", "");
      ASSERT_TRUE(of.start);
      EXPECT_EQ(of.start->share, 0.8);
    }
  EXPECT_GE(begun, 1);
  // The seeds of the cells are those of the other methods.
  Database other = open("b.db");
  const Id plain = run(other, GridSpec::Method::independent);
  for (std::size_t k = 0; k < stored.size(); ++k)
    EXPECT_EQ(db.run(stored[k].run).seed, other.run(other.gridCells(plain)[k].run).seed);
}

TEST_F(SmallGrid, SimilarityToTheNeighboursBestsIsAFactorOfWhatTheLearnerIsTold) {
  text_["settings"]["points"] = 0;
  text_["settings"]["similarity_strength"] = 3;
  Database db = open("a.db");
  const Id grid = run(db, GridSpec::Method::similarity);
  const std::vector<GridCell> cells = cellsOf(spec());
  const std::vector<GridCellRecord> stored = db.gridCells(grid);
  // The bests after the second generation, of cells and of their images.
  std::map<int, std::vector<double>> bests;
  std::map<int, Id> last;
  for (const GridBest& b : db.gridBests(grid)) {
    if (b.generation == 2) bests[b.cell] = db.individual(b.individual).parameters;
    last[b.cell] = b.individual;
  }
  for (const GridCell& cell : cells)
    if (cell.mirrorOf) bests[cell.number] = mirrorImage(genotype_, bests.at(cell.mirrorOf));
  int cellsSeen = 0;
  for (const GridCell& cell : cells) {
    if (cell.mirrorOf) continue;
    const Id runId = stored[static_cast<std::size_t>(cell.number - 1)].run;
    const auto third = db.individuals(runId, 3);
    const auto weighted = [&](const IndividualRecord& i) {
      double sum = 0;
      for (const int n : cell.neighbours) sum += similarity(genotype_, i.parameters, bests.at(n));
      return weightedFitness(i.fitness, sum / static_cast<double>(cell.neighbours.size()), 3);
    };
    // A later generation of a failed cell carries the learner's last state on.
    const json told = json::parse(db.lastGeneration(runId)->learnerState)["fitness"];
    ASSERT_EQ(told.size(), third.size());
    for (std::size_t k = 0; k < third.size(); ++k) EXPECT_NEAR(told[k].get<double>(), weighted(third[k]), 1e-15);
    // The cell's best is the one so far that is worth most, not the one with the highest fitness.
    double highest = -1;
    for (int generation = 1; generation <= 3; ++generation)
      for (const IndividualRecord& i : db.individuals(runId, generation)) highest = std::max(highest, weighted(i));
    EXPECT_EQ(weighted(db.individual(last.at(cell.number))), highest);
    ++cellsSeen;
  }
  EXPECT_EQ(cellsSeen, 4);
}

TEST_F(SmallGrid, KicksBetweenTheCellsAreInterpolatedAndTheSameForAllMethods) {
  Database db = open("a.db");
  const Id one = run(db, GridSpec::Method::independent), other = run(db, GridSpec::Method::similarity);
  const std::vector<GridPoint> points = db.gridPoints(one), others = db.gridPoints(other);
  ASSERT_EQ(points.size(), 3u);
  const VectorGrid kicks = solvedGrid(db, host_, one);
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_EQ(points[k].task, others[k].task);
    EXPECT_EQ(points[k].parameters, kicks.at(points[k].task, GridSpec::axisNames));
    const GridKick again = gridKick(db, host_, one, points[k].task);
    EXPECT_EQ(again.replay.fitness, points[k].fitness);
    EXPECT_EQ(again.figures, points[k].figures);
  }
  // At a cell it is the cell's solution, and beyond the middle mirrored points have mirrored kicks.
  const GridSummary summary = summaryOf(db, host_, one);
  for (const GridRow& row : summary.rows) EXPECT_EQ(kicks.at(row.task, GridSpec::axisNames), row.parameters);
  const std::vector<double> left = kicks.at({0.15, 0.3, 0}, GridSpec::axisNames);
  const std::vector<double> right = mirrorImage(genotype_, kicks.at({0.15, -0.3, 0}, GridSpec::axisNames));
  for (std::size_t i = 0; i < left.size(); ++i) EXPECT_NEAR(left[i], right[i], 1e-14);
  EXPECT_THROW(gridKick(db, host_, one, {0.17, 0, 0}), InputError);

  // The table is the mean of what stands in the database.
  const GridComparison table = compareGrids(db, host_, db.grid(one).specSha256);
  ASSERT_EQ(table.methods.size(), 2u);
  double sum = 0;
  for (const GridPoint& p : points) sum += p.fitness;
  EXPECT_NEAR(table.methods[0].points.mean, sum / 3, 1e-15);
  EXPECT_NEAR(table.methods[1].cellsDifference.mean, table.methods[1].cells.mean - table.methods[0].cells.mean, 1e-15);
  EXPECT_THAT(methodsCsv(table), HasSubstr("method,seeds,cells_m,cells_ci95_half_m"));
  // A map goes through the same kicks.
  const auto map = gridMap(db, host_, one, 0.16, 3, 1, 1, StopFlag{false});
  ASSERT_TRUE(map);
  EXPECT_EQ(map->points[1].task, (std::array{0.16, 0.0, 0.0}));
  EXPECT_EQ(map->points[1].fitness, summary.rows[4].fitness);
  EXPECT_EQ(toJsonText(gridMapFromJson(toJsonText(*map), "map")), toJsonText(*map));
  EXPECT_FALSE(gridMap(db, host_, one, 0.16, 3, 1, 1, StopFlag{true}));
}

TEST_F(SmallGrid, WhatCannotBeAGridIsRefusedBeforeAnythingIsStored) {
  Database db = open("a.db");
  const auto complaint = [&] {
    try {
      startGrid(db, host_, spec(), GridSpec::Method::independent, 1);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  text_["distances_m"] = {0.14, 0.5};
  EXPECT_THAT(complaint(), HasSubstr("grid.json /distances_m: 0.5 is not allowed; 0.14 to 0.18 m"));
  text_["distances_m"] = {0.14};
  text_["experiment"] = "none.json";
  EXPECT_THAT(complaint(), HasSubstr("none.json"));
  text_["experiment"] = SOURCE_DIR "/resources/experiments/walk-short.json";
  EXPECT_THAT(complaint(), HasSubstr("the setting distance_m"));
  EXPECT_TRUE(db.grids().empty());
  EXPECT_TRUE(db.experiments().empty());
}

TEST_F(SmallGrid, ACellsRunGoesOnWithItsGridAlone) {
  Database db = open("a.db");
  const Id grid = startGrid(db, host_, spec(), GridSpec::Method::independent, 1);
  const Id cell = db.gridCells(grid)[2].run;
  ASSERT_NE(cell, 0);
  try {
    continueRun(db, host_, cell, StopFlag{false}, {});
    FAIL() << "the run went on alone";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cell of grid 1"));
  }
  EXPECT_EQ(continueGrid(db, host_, grid, StopFlag{true}, {}), RunEnd::stopped);
  EXPECT_EQ(db.run(cell).state, RunState::stopped);
}

/// The whole program, killed at random times, on one worker and on three.
class KilledGrid : public SmallGrid {
 protected:
  pid_t start(const std::string& db, const char* workers) {
    const std::string file = folder_.write("grid.json", text_.dump());
    return startBtr({"grid", file, "--db", db, "--workers", workers, "--quiet"});
  }
};

TEST_F(KilledGrid, GoesOnWithTheSameBitsAfterTwelveKillsAndOnAnyNumberOfWorkers) {
  ASSERT_EQ(0, endOf(start(folder_.file("one.db"), "1")));
  const std::string expected = results(folder_.file("one.db"));
  EXPECT_THAT(expected, HasSubstr("\"points\""));
  Random random(20041121);
  int kills = 0;
  for (int runs = 0; kills < 12;) {
    const std::string db = folder_.file("killed" + std::to_string(runs) + ".db");
    const pid_t pid = start(db, kills % 2 ? "3" : "1");
    usleep(static_cast<useconds_t>(random.uniform(0, 700'000)));
    kill(pid, SIGKILL);
    const int end = endOf(pid);
    ASSERT_TRUE(end == 0 || end == -SIGKILL) << end;
    kills += end == -SIGKILL;
    if (end != 0 && kills < 12) continue;
    ASSERT_EQ(0, endOf(start(db, "2")));
    ASSERT_EQ(expected, results(db)) << "after " << kills << " kills";
    ++runs;
  }
}

}  // namespace
}  // namespace btr
