// The geometry of a grid: neighbours, mirror images, the order in which contamination spreads.
#include "core/run/grid/grid_cells.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/plugin/plugin_host.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/error.h"

namespace btr {
namespace {

using ::testing::ElementsAre;

const GridCell& at(const std::vector<GridCell>& cells, int number) {
  return cells[static_cast<std::size_t>(number - 1)];
}

TEST(GridCells, ThePapersGridHasThirtyCellsOfWhichSixteenLearn) {
  const std::vector<GridCell> cells = cellsOf(loadGrid(SOURCE_DIR "/resources/grids/kick-grid.json"));
  ASSERT_EQ(cells.size(), 30u);
  int learning = 0;
  for (const GridCell& cell : cells) {
    EXPECT_EQ(cell.number, &cell - cells.data() + 1);
    learning += cell.mirrorOf == 0;
    if (cell.mirrorOf == 0) continue;
    const GridCell& source = at(cells, cell.mirrorOf);
    EXPECT_EQ(source.mirrorOf, 0);
    EXPECT_EQ(source.task[0], cell.task[0]);
    EXPECT_EQ(source.task[1], -cell.task[1]);
    EXPECT_EQ(source.task[2], -cell.task[2]);
  }
  EXPECT_EQ(learning, 16);
}

TEST(GridCells, NeighboursAreOneStepAwayAndMutual) {
  const std::vector<GridCell> cells = cellsOf(loadGrid(SOURCE_DIR "/resources/grids/kick-grid.json"));
  EXPECT_THAT(at(cells, 1).neighbours, ElementsAre(2, 6, 16));
  std::size_t edges = 0;
  for (const GridCell& cell : cells)
    for (const int n : cell.neighbours) {
      EXPECT_THAT(at(cells, n).neighbours, testing::Contains(cell.number));
      int steps = 0;
      for (std::size_t axis = 0; axis < 3; ++axis)
        steps += std::abs(static_cast<int>(at(cells, n).index[axis]) - static_cast<int>(cell.index[axis]));
      EXPECT_EQ(steps, 1);
      ++edges;
    }
  EXPECT_EQ(edges / 2, 15u + 2 * 10 + 2 * 12);
}

TEST(GridCells, ContaminationSpreadsFromStraightAheadAndReachesEveryLearningCellOnce) {
  const std::vector<GridCell> cells = cellsOf(loadGrid(SOURCE_DIR "/resources/grids/kick-grid.json"));
  const auto waves = wavesOf(cells);
  ASSERT_EQ(waves.front().size(), 1u);
  EXPECT_EQ(at(cells, waves.front().front()).task, (std::array{0.14, 0.0, 0.0}));
  std::set<int> seen;
  for (const auto& wave : waves)
    for (const int number : wave) {
      EXPECT_EQ(at(cells, number).mirrorOf, 0);
      EXPECT_TRUE(seen.insert(number).second);
    }
  EXPECT_EQ(seen.size(), 16u);
  // About a centre that is its own image, cells of one wave never touch.
  for (const auto& wave : waves)
    for (const int number : wave)
      for (const int n : at(cells, number).neighbours)
        EXPECT_THAT(wave, testing::Not(testing::Contains(at(cells, n).mirrorOf ? at(cells, n).mirrorOf : n)));
}

TEST(GridCells, TasksAreNamedForPeople) {
  EXPECT_EQ(nameOfTask(std::array{0.14, 0.0, -1.0471975511965976}), "d 0.14 m, β 0°, α −60°");
  EXPECT_EQ(taskOf(std::array{0.14, 0.5, -1.0}),
            (Values{{"distance_m", 0.14}, {"bearing_rad", 0.5}, {"direction_rad", -1}}));
}

TEST(GridCells, AMirrorImageExchangesTheLegsAndTwiceIsTheSame) {
  const PluginHost host(PLUGIN_DIR);
  const std::vector<Parameter> genotype = host.controller("kick")->genotype();
  std::vector<double> vector;
  for (std::size_t i = 0; i < genotype.size(); ++i) vector.push_back(static_cast<double>(i) / 100);
  const std::vector<double> image = mirrorImage(genotype, vector);
  EXPECT_EQ(mirrorImage(genotype, image), vector);
  // LF, RF, LR, RR with three joints each, twice, then the number of points.
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(image[i], vector[i % 6 < 3 ? i + 3 : i - 3]) << genotype[i].name;
  EXPECT_EQ(image[24], vector[24]);
}

TEST(GridCells, AControllerWithoutLegsInItsParametersHasNoMirrorImage) {
  const PluginHost host(PLUGIN_DIR);
  const std::vector<Parameter> genotype = host.controller("walk")->genotype();
  EXPECT_THROW(mirrorImage(genotype, std::vector<double>(genotype.size())), InputError);
  const std::vector<Parameter> lame{{"a_LF_rad", "", "", 0, 1, 0}};
  EXPECT_THROW(mirrorImage(lame, std::vector<double>{0.5}), InputError);
}

TEST(GridCells, AMirroredKickOfTheSimulatorIsTheMirrorImage) {
  const PluginHost host(PLUGIN_DIR);
  const PreparedExperiment kick = prepareFromFiles(loadExperiment(SOURCE_DIR "/resources/experiments/kick.json"), host);
  // The front left leg sweeps a ball that lies on its side.
  std::vector<double> sweep;
  for (const Parameter& p : kick.genotype) sweep.push_back(p.byDefault);
  for (const auto& [name, value] : {std::pair("accumulation_LF_J1_rad", -0.9),
                                    {"accumulation_LF_J3_rad", 1.8},
                                    {"release_LF_J1_rad", 1.6},
                                    {"release_LF_J3_rad", 0.6}})
    sweep[static_cast<std::size_t>(find(kick.genotype, name) - kick.genotype.data())] = value;
  const auto way = [&](std::array<double, 3> task, const std::vector<double>& parameters) {
    const PreparedExperiment at = kick.withTask(taskOf(task));
    const TrialResult result = at.trial(at.scene(at.spec.simulator), parameters, 1, false);
    return std::pair(Eigen::Vector3d(result.balls[0].rest_m - result.balls[0].start_m), at.fitnessOf(result));
  };
  const auto [left, leftFitness] = way({0.14, 0.35, 0.3}, sweep);
  const auto [right, rightFitness] = way({0.14, -0.35, -0.3}, mirrorImage(kick.genotype, sweep));
  EXPECT_GT(left.norm(), 0.05);
  EXPECT_NEAR(left.x(), right.x(), 0.01 * left.norm());
  EXPECT_NEAR(left.y(), -right.y(), 0.01 * left.norm());
  EXPECT_NEAR(leftFitness, rightFitness, 0.03 * leftFitness);
}

}  // namespace
}  // namespace btr
