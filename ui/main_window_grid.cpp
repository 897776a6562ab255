// The whole kick in the window: its page is filled from the database that is open; kicks are played in the 3D view.
#include <QDockWidget>

#include "core/run/grid_cells.h"
#include "core/run/grid_kicks.h"
#include "ui/experiment/experiment_tree.h"
#include "ui/grid/grid_page.h"
#include "ui/main_window.h"
#include "ui/scene3d/replay_job.h"
#include "ui/scene3d/replay_panel.h"

namespace btr::ui {

void MainWindow::makeGridPage() {
  gridPage_ = new GridPage(launcher_.program(), this);
  gridPageDock_ = addDock("grid", tr("The whole kick"), "view-grid", gridPage_);
}

void MainWindow::connectGrid() {
  connect(gridPage_, &GridPage::failed, this, &MainWindow::report);
  connect(tree_, &ExperimentTree::gridRequested, this, &MainWindow::showGrid);
  connect(gridPage_, &GridPage::kickRequested, this, &MainWindow::playKick);
  connect(gridPage_, &GridPage::replayRequested, this, [this](Id run, Id individual) {
    selectRun(run);
    replayIndividual(individual);
  });
  connect(&watcher_, &DatabaseWatcher::runsChanged, this, [this] {
    if (gridPage_->isVisible()) readGrids();
  });
}

std::vector<RunGroup> MainWindow::gridsInTree() {
  std::vector<RunGroup> groups;
  guard([&] {
    for (const GridRecord& grid : watcher_.database().grids()) {
      groups.push_back({grid.id, GridPage::nameOf(grid), {}});
      for (const GridCellRecord& cell : watcher_.database().gridCells(grid.id))
        if (cell.run) groups.back().cells[cell.run] = cell.number;
    }
  });
  return groups;
}

void MainWindow::readGrids() {
  if (!watcher_.isOpen()) return;
  guard([this] {
    std::vector<GridSummary> grids;
    for (const GridRecord& grid : watcher_.database().grids())
      grids.push_back(summaryOf(watcher_.database(), *host_, grid.id));
    gridPage_->setGrids(databasePath(), grids);
  });
}

void MainWindow::showGridPage(bool on) {
  if (on) readGrids();
  givePage(gridPageDock_, gridAction_, on);
}

void MainWindow::showGrid(Id grid) {
  showGridPage(true);
  gridPage_->choose(grid);
}

// Interpolated and simulated in a thread of its own, from a connection of its own.
void MainWindow::playKick(Id grid, double distance_m, double bearing_rad, double direction_rad) {
  if (!watcher_.isOpen()) return;
  raiseDock(replayDock_);
  ghosts_ = {};
  const std::array<double, 3> point{distance_m, bearing_rad, direction_rad};
  replayJob_->start([path = databasePath().toStdString(), grid, point, host = host_] {
    const Database database = Database::open(path, Database::Mode::readOnly);
    const GridKick kick = gridKick(database, *host, grid, point);
    std::vector<ReplayBall> balls;
    for (const BallSpec& ball : kick.balls) balls.push_back({ball.name, ball.radius_m});
    ReplayData shown =
        toReplayData(kick.replay, balls,
                     tr("grid %1, interpolated: %2").arg(grid).arg(QString::fromStdString(nameOfTask(point))), tr("m"));
    shown.check = ReplayData::Check::notChecked;
    return shown;
  });
}

}  // namespace btr::ui
