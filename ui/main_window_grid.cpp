// The whole kick in the window: its page is filled from the database that is open; kicks are played in the 3D view.
#include <QCoreApplication>
#include <QDockWidget>
#include <QFile>
#include <QStandardPaths>

#include "core/run/grid_cells.h"
#include "core/run/grid_kicks.h"
#include "core/spec/json_reader.h"
#include "ui/common/message_banner.h"
#include "ui/common/resources.h"
#include "ui/experiment/experiment_tree.h"
#include "ui/experiment/run_panel.h"
#include "ui/grid/grid_form.h"
#include "ui/grid/grid_page.h"
#include "ui/main_window.h"
#include "ui/scene3d/replay_job.h"
#include "ui/scene3d/replay_panel.h"

namespace btr::ui {
namespace {

QString changedGridFile() {
  return QStringLiteral("%1/uchilsim-%2-grid.json")
      .arg(QStandardPaths::writableLocation(QStandardPaths::TempLocation))
      .arg(QCoreApplication::applicationPid());
}

}  // namespace

void MainWindow::makeGridPage() {
  gridPage_ = new GridPage(launcher_.program(), this);
  layout_.addPage("grid", tr("The whole kick"), "view-grid", gridPage_, {"tree", "replay"});
}

void MainWindow::connectGrid() {
  connect(gridPage_, &GridPage::failed, this, &MainWindow::report);
  connect(tree_, &ExperimentTree::gridRequested, this, &MainWindow::showGrid);
  connect(gridPage_, &GridPage::kickRequested, this, &MainWindow::playKick);
  connect(gridPage_, &GridPage::newRequested, this, &MainWindow::describeGrid);
  connect(gridPage_, &GridPage::stopRequested, this, &MainWindow::stopGrid);
  connect(gridPage_, &GridPage::continueRequested, this, [this](Id grid) {
    if (isGridLearning()) return;
    if (launcher_.continueGrid(databasePath(), grid, panel_->jobs())) watchGrid();
  });
  connect(&watcher_, &DatabaseWatcher::activeChanged, this, [this] {
    if (gridPage_->isVisible()) readGrids();
  });
  connect(gridPage_, &GridPage::replayRequested, this, [this](Id run, Id individual) {
    selectRun(run);
    replayIndividual(individual);
  });
  connect(&watcher_, &DatabaseWatcher::runsChanged, this, [this] {
    if (gridPage_->isVisible()) readGrids();
  });
}

std::vector<RunGroup> MainWindow::gridsInTree() const {
  std::vector<RunGroup> groups;
  for (const auto& [grid, cellOfRun] : watcher_.grids()) groups.push_back({grid.id, GridPage::nameOf(grid), cellOfRun});
  return groups;
}

void MainWindow::readGrids() {
  if (!watcher_.isOpen()) return;
  guard([this] {
    std::vector<GridSummary> grids;
    for (const DatabaseWatcher::Grid& grid : watcher_.grids())
      grids.push_back(summaryOf(watcher_.database(), *host_, grid.record.id));
    gridPage_->setGrids(databasePath(), grids);
    std::map<Id, GridState> states;
    for (const GridSummary& grid : grids) states[grid.grid.id] = stateOf(grid);
    gridPage_->setStates(states);
  });
}

GridState MainWindow::stateOf(const GridSummary& grid) const {
  GridState state;
  state.isActive = watcher_.activeGrids().count(grid.grid.id) > 0;
  state.isFinished = isGridFinished(watcher_.database(), grid.grid.id);
  if (state.isFinished) return state;
  const auto each = static_cast<int>(valueOf(gridParameters(), grid.spec.settings, "generations"));
  state.total = grid.learning * each;
  const DatabaseWatcher::Grid* watched = watcher_.grid(grid.grid.id);
  if (!watched) return state;
  const std::vector<GridCell> cells = cellsOf(grid.spec);
  for (const RunRecord& run : watcher_.runs())
    if (const auto cell = watched->cellOfRun.find(run.id);
        cell != watched->cellOfRun.end() && !cells[static_cast<std::size_t>(cell->second - 1)].mirrorOf)
      state.done += std::min(each, run.generation);
  return state;
}

/// Says so, too.
bool MainWindow::isGridLearning() {
  if (!launcher_.isGridAlive()) return false;
  report(tr("A grid is being learned; stop it, or wait until it is done."));
  return true;
}

void MainWindow::describeGrid() {
  if (!watcher_.isOpen()) return;
  if (isGridLearning()) return;
  auto* form = new GridForm(this);
  form->setAttribute(Qt::WA_DeleteOnClose);
  if (const QStringList examples = exampleGrids(); !examples.isEmpty())
    guard([&] { form->openFile(examples.first()); });
  connect(form, &GridForm::startRequested, this, [this, form] { startGrids(*form); });
  form->open();
}

// A form that was changed is read from a file of its own; what is stored needs none afterwards.
void MainWindow::startGrids(const GridForm& form) {
  guard([&] {
    QString file = form.file();
    if (form.isModified()) {
      file = changedGridFile();
      writeFile(file.toStdString(), form.portableText());
    }
    if (!launcher_.learnGrids(databasePath(), file, panel_->jobs())) return;
    watchGrid();
    inform(tr("The grid is learned in a process of its own; it goes on without the window."));
  });
}

void MainWindow::watchGrid() {
  gridLaunched_ = true;
  processes_.start();
  banner_->clear();
  watcher_.poll();
}

void MainWindow::stopGrid(Id grid) {
  guard([&] {
    if (const DatabaseWatcher::Grid* watched = watcher_.grid(grid))
      for (const auto& [run, cell] : watched->cellOfRun)
        if (watcher_.activeRuns().count(run) > 0) writer().requestStop(run, true);
    watcher_.poll();
    inform(tr("Asked the grid to stop; what it has done is kept."));
  });
}

// A process that ended while its grid is not finished and nobody stopped it has something to say.
void MainWindow::checkGridProcess() {
  if (!gridLaunched_ || launcher_.isGridAlive()) return;
  gridLaunched_ = false;
  QFile::remove(changedGridFile());
  const QString words = launcher_.lastGridWords();
  if (!words.isEmpty() && !words.contains(QStringLiteral("btr: stopped"))) report(words);
  if (gridPage_->isVisible()) readGrids();
}

void MainWindow::showGridPage(bool on) {
  if (on) readGrids();
  layout_.showPage(on ? QStringLiteral("grid") : QString());
}

void MainWindow::showGrid(Id grid) {
  showGridPage(true);
  gridPage_->choose(grid);
}

// Interpolated and simulated in a thread of its own, from a connection of its own.
void MainWindow::playKick(Id grid, double distance_m, double bearing_rad, double direction_rad) {
  if (!watcher_.isOpen()) return;
  layout_.raise("replay");
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
