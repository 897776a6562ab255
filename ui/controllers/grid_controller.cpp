#include "ui/controllers/grid_controller.h"

#include <QCoreApplication>
#include <QFile>
#include <QStandardPaths>
#include <algorithm>
#include <utility>

#include "core/run/grid/grid.h"
#include "core/run/grid/grid_cells.h"
#include "core/run/grid/grid_kicks.h"
#include "core/spec/json_reader.h"
#include "ui/common/resources.h"
#include "ui/controllers/run_controller.h"
#include "ui/experiment/experiment_tree.h"
#include "ui/grid/grid_form.h"
#include "ui/grid/grid_page.h"

namespace btr::ui {
namespace {

QString changedGridFile() {
  return QStringLiteral("%1/uchilsim-%2-grid.json")
      .arg(QStandardPaths::writableLocation(QStandardPaths::TempLocation))
      .arg(QCoreApplication::applicationPid());
}

}  // namespace

GridController::GridController(Workbench& bench, RunController& runs, GridPage& page)
    : QObject(&bench), bench_(bench), runs_(runs), page_(page) {
  process_.setInterval(500);
  connect(&process_, &QTimer::timeout, this, &GridController::checkProcess);
  connect(&page_, &GridPage::failed, &bench_, &Workbench::report);
  connect(&page_, &GridPage::kickRequested, this, &GridController::kickWanted);
  connect(&page_, &GridPage::newRequested, this, &GridController::describe);
  connect(&page_, &GridPage::stopRequested, this, &GridController::stop);
  connect(&page_, &GridPage::continueRequested, this, [this](Id grid) {
    if (isLearning()) return;
    if (bench_.launcher().continueGrid(bench_.path(), grid, runs_.jobs())) watch();
  });
  connect(&page_, &GridPage::replayRequested, this, [this](Id run, Id individual) {
    bench_.selectRun(run);
    bench_.whenSelected([this, individual] { emit bench_.replayWanted(individual); });
  });
  connect(&bench_.watcher(), &DatabaseWatcher::activeChanged, this, [this] {
    checkProcess();
    if (page_.isVisible()) read();
  });
  connect(&bench_.watcher(), &DatabaseWatcher::runsChanged, this, [this] {
    if (page_.isVisible()) read();
  });
}

std::vector<RunGroup> GridController::groups() const {
  std::vector<RunGroup> groups;
  for (const auto& [grid, cellOfRun] : bench_.watcher().grids())
    groups.push_back({grid.id, GridPage::nameOf(grid), cellOfRun});
  return groups;
}

void GridController::read() {
  if (!bench_.watcher().isOpen()) return;
  std::vector<Id> ids;
  for (const DatabaseWatcher::Grid& grid : bench_.watcher().grids()) ids.push_back(grid.record.id);
  struct Read {
    std::vector<GridSummary> grids;
    std::set<Id> finished;
  };
  bench_.reader().read(
      this, "grids", tr("the grids"),
      [ids, host = bench_.host()](const Database& database) {
        Read read;
        for (const Id grid : ids) {
          read.grids.push_back(summaryOf(database, *host, grid));
          if (isGridFinished(database, grid)) read.finished.insert(grid);
        }
        return read;
      },
      [this](const Read& read) {
        page_.setGrids(bench_.path(), read.grids);
        std::map<Id, GridState> states;
        for (const GridSummary& grid : read.grids)
          states[grid.grid.id] = stateOf(grid, read.finished.contains(grid.grid.id));
        page_.setStates(states);
        if (const Id wanted = std::exchange(wanted_, 0)) page_.choose(wanted);
      });
}

GridState GridController::stateOf(const GridSummary& grid, bool isFinished) const {
  GridState state;
  state.isActive = bench_.watcher().activeGrids().count(grid.grid.id) > 0;
  state.isFinished = isFinished;
  if (state.isFinished) return state;
  const auto each = static_cast<int>(valueOf(gridParameters(), grid.spec.settings, "generations"));
  state.total = grid.learning * each;
  const DatabaseWatcher::Grid* watched = bench_.watcher().grid(grid.grid.id);
  if (!watched) return state;
  const std::vector<GridCell> cells = cellsOf(grid.spec);
  for (const RunRecord& run : bench_.watcher().runs())
    if (const auto cell = watched->cellOfRun.find(run.id);
        cell != watched->cellOfRun.end() && !cells[static_cast<std::size_t>(cell->second - 1)].mirrorOf)
      state.done += std::min(each, run.generation);
  return state;
}

/// Says so, too.
bool GridController::isLearning() {
  if (!bench_.launcher().isGridAlive()) return false;
  bench_.report(tr("A grid is being learned; stop it, or wait until it is done."));
  return true;
}

void GridController::describe() {
  if (!bench_.watcher().isOpen()) return;
  if (isLearning()) return;
  auto* form = new GridForm(bench_.window());
  form->setAttribute(Qt::WA_DeleteOnClose);
  form->setBounds([host = bench_.host()](const GridSpec& grid) { return axisParameters(*host, grid); });
  if (const QStringList examples = exampleGrids(); !examples.isEmpty())
    bench_.guard([&] { form->openFile(examples.first()); });
  connect(form, &GridForm::startRequested, this, [this, form] { start(*form); });
  form->open();
}

// A form that was changed is read from a file of its own; what is stored needs none afterwards.
void GridController::start(const GridForm& form) {
  bench_.guard([&] {
    QString file = form.file();
    if (form.isModified()) {
      file = changedGridFile();
      writeFile(file.toStdString(), form.portableText());
    }
    if (!bench_.launcher().learnGrids(bench_.path(), file, runs_.jobs())) return;
    watch();
    bench_.inform(tr("The grid is learned in a process of its own; it goes on without the window."));
  });
}

void GridController::watch() {
  launched_ = true;
  process_.start();
  emit bench_.messagesOver();
  bench_.watcher().poll();
}

void GridController::stop(Id grid) {
  bench_.guard([&] {
    if (const DatabaseWatcher::Grid* watched = bench_.watcher().grid(grid))
      for (const auto& [run, cell] : watched->cellOfRun)
        if (bench_.watcher().activeRuns().count(run) > 0) bench_.writer().requestStop(run, true);
    bench_.watcher().poll();
    bench_.inform(tr("Asked the grid to stop; what it has done is kept."));
  });
}

// A process that ended while its grid is not finished and nobody stopped it has something to say.
void GridController::checkProcess() {
  if (!launched_ || bench_.launcher().isGridAlive()) return;
  launched_ = false;
  process_.stop();
  QFile::remove(changedGridFile());
  const QString words = bench_.launcher().lastGridWords();
  if (!words.isEmpty() && !words.contains(QStringLiteral("btr: stopped"))) bench_.report(words);
  if (page_.isVisible()) read();
}

void GridController::show(Id grid) {
  wanted_ = grid;
  read();
  emit bench_.dockWanted("grid");
}

}  // namespace btr::ui
