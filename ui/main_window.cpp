#include "ui/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QScreen>
#include <QStatusBar>
#include <QTableView>
#include <QTimer>
#include <QToolBar>
#include <QVBoxLayout>
#include <algorithm>

#include "core/spec/error.h"
#include "ui/charts/fitness_chart.h"
#include "ui/charts/gap_chart.h"
#include "ui/common/message_banner.h"
#include "ui/database/individuals_table.h"
#include "ui/experiment/experiment_form.h"
#include "ui/experiment/experiment_tree.h"
#include "ui/experiment/run_panel.h"
#include "ui/experiment/simulators_page.h"
#include "ui/measure/alarm.h"
#include "ui/measure/measurement_sheet.h"
#include "ui/measure/policy_page.h"
#include "ui/scene3d/replay_job.h"
#include "ui/scene3d/replay_panel.h"

namespace btr::ui {
namespace {

// As high as its message needs at the window's width: a tool bar would take the height that a narrow text would need.
class MessageArea final : public QWidget {
 public:
  using QWidget::QWidget;
  QSize sizeHint() const override {
    const int wide = window()->width();
    return {QWidget::sizeHint().width(),
            layout()->hasHeightForWidth() ? layout()->heightForWidth(wide) : layout()->sizeHint().height()};
  }
};

// Room for the alarm beside the tools, whether it rings or not: its coming moves nothing under the mouse.
class AlarmPlace final : public QWidget {
 public:
  AlarmPlace(Alarm& alarm, QWidget* parent) : QWidget(parent), alarm_(alarm) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    row->addWidget(&alarm);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  }
  // Little is enough: a tool bar hides what it has no room for.
  QSize minimumSizeHint() const override { return {200, Alarm::height_px(fontMetrics())}; }
  QSize sizeHint() const override { return {alarm_.sizeHint().width(), minimumSizeHint().height()}; }

 private:
  Alarm& alarm_;
};

}  // namespace

MainWindow::MainWindow(std::shared_ptr<const PluginHost> host, Theme& theme, const WindowOptions& options)
    : host_(std::move(host)),
      theme_(theme),
      options_(options),
      settings_(options.settingsFile),
      launcher_(host_, options.program),
      // A process of ours counts from its start on: until it holds the run's lock nobody else can tell.
      watcher_([this](const std::string& database, Id run) {
        return launcher_.isAlive(run) || options_.isActive(database, run);
      }) {
  setObjectName("mainWindow");
  theme_.apply(settings_.look());
  makeDocks();
  makeMenus();
  connectRuns();
  connectShow();
  connectMeasure();
  connectGap();
  connectCompare();
  connectGrid();
  connectMerge();
  arrangeDocks();
  restoreWindow();
  restoreDraft();
  for (const std::string& problem : host_->problems())
    report(tr("A plugin was left out: %1").arg(QString::fromStdString(problem)));
  showTitle();
}

MainWindow::~MainWindow() = default;

bool MainWindow::openDatabase(const QString& path) {
  const QString absolute = QFileInfo(path).absoluteFilePath();
  sheet_->finishEditing();
  const bool opened = guard([&] {
    // Made or brought up to date first: the watcher only reads. A file that may only be read is opened so.
    std::optional<Database> writer;
    if (!QFileInfo::exists(absolute) || QFileInfo(absolute).isWritable())
      writer = Database::open(absolute.toStdString(), Database::Mode::create);
    watcher_.open(absolute);
    writer_ = std::move(writer);
  });
  if (!opened) return false;
  // Numbers of runs begin anew in each database.
  sheet_->setTasks({});
  banner_->clear();
  launched_.clear();
  settings_.addRecentDatabase(absolute);
  fillRecent();
  showTitle();

  // The run that was looked at last, else the newest.
  const std::vector<RunRecord>& runs = watcher_.runs();
  Id wanted = settings_.selectedRun(absolute);
  const bool known = std::any_of(runs.begin(), runs.end(), [&](const auto& run) { return run.id == wanted; });
  selectRun(known ? wanted : runs.empty() ? 0 : runs.back().id);
  return true;
}

void MainWindow::makeDocks() {
  setDockNestingEnabled(true);
  setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
  const ExperimentOffers offers = offersOf(*host_);
  tree_ = new ExperimentTree(this);
  panel_ = new RunPanel(this);
  fitness_ = new FitnessChart(this);
  gap_ = new GapChart(this);
  versions_ = new SimulatorsPage(this);
  individuals_ = new IndividualsTable(this);
  individuals_->view().sortByColumn(IndividualsModel::fitness, Qt::DescendingOrder);
  sheet_ = new MeasurementSheet(this);
  policies_ = new PolicyPage(this);
  replay_ = new ReplayPanel(this);
  replayJob_ = new ReplayJob(this);
  replay_->attach(*replayJob_);
  draft_ = new ExperimentForm(offers, this);
  spec_ = new ExperimentForm(offers, this);
  draft_->setObjectName("draft");
  spec_->setObjectName("spec");
  spec_->setReadOnly(tr("A stored run never changes."));
  treeDock_ = addDock("tree", tr("Experiments"), "view-list-tree", tree_);
  panelDock_ = addDock("run", tr("Run"), "media-playback-start", panel_);
  fitnessDock_ = addDock("fitness", tr("Fitness"), "office-chart-line", fitness_);
  gapDock_ = addDock("gap", tr("Reality gap"), "office-chart-scatter", gap_);
  versionsDock_ = addDock("simulators", tr("Simulators"), "cpu", versions_);
  individualsDock_ = addDock("individuals", tr("Individuals"), "view-list-details", individuals_);
  sheetDock_ = addDock("sheet", tr("Measurement sheet"), "document-edit", sheet_);
  policiesDock_ = addDock("policies", tr("Learning in reality"), "view-statistics", policies_);
  replayDock_ = addDock("replay", tr("Replay"), "media-playback-playing", replay_);
  draftDock_ = addDock("draft", tr("New experiment"), "document-new", draft_);
  makeGapPage();
  makeComparePage();
  makeGridPage();
  specDock_ = addDock("spec", tr("Settings of the run"), "document-properties", spec_);

  // Messages stand above everything, in a tool bar of their own that is there only while there is one; the alarm has
  // its place beside the tools.
  banner_ = new MessageBanner(this);
  auto* messages = new QToolBar(tr("Messages"), this);
  messages->setObjectName("toolbar.messages");
  messages->setMovable(false);
  messages->toggleViewAction()->setVisible(false);
  alarm_ = new Alarm(this, options_.settingsFile);
  alarmPlace_ = new AlarmPlace(*alarm_, this);
  auto* stack = new MessageArea(messages);
  auto* column = new QVBoxLayout(stack);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  column->addWidget(banner_);
  stack->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Maximum);
  messages->addWidget(stack);
  addToolBar(Qt::TopToolBarArea, messages);
  const auto showIfAny = [this, messages] { messages->setVisible(!banner_->text().isEmpty()); };
  showIfAny();
  connect(banner_, &MessageBanner::shown, messages, showIfAny);
  connect(banner_, &MessageBanner::cleared, messages, showIfAny);

  databaseLabel_ = new QLabel(this);
  activeLabel_ = new QLabel(this);
  databaseLabel_->setContentsMargins(6, 0, 6, 0);
  activeLabel_->setContentsMargins(6, 0, 6, 0);
  statusBar()->addPermanentWidget(activeLabel_);
  statusBar()->addPermanentWidget(databaseLabel_);
}

QDockWidget* MainWindow::addDock(const QString& name, const QString& title, const QString& icon, QWidget* widget) {
  auto* dock = new QDockWidget(title, this);
  dock->setObjectName("dock." + name);
  dock->setWidget(widget);
  dock->setWindowIcon(themeIcon(icon));
  dock->toggleViewAction()->setIcon(themeIcon(icon));
  return dock;
}

// Left what there is, in the middle how it goes, right what is asked for.
void MainWindow::arrangeDocks() {
  runsLayout_.clear();
  page_ = nullptr;
  gapAction_->setChecked(false);
  gridAction_->setChecked(false);
  for (QDockWidget* dock : findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly)) {
    removeDockWidget(dock);
    dock->setFloating(false);
  }
  addDockWidget(Qt::LeftDockWidgetArea, treeDock_);
  splitDockWidget(treeDock_, panelDock_, Qt::Horizontal);
  splitDockWidget(panelDock_, specDock_, Qt::Horizontal);
  splitDockWidget(panelDock_, fitnessDock_, Qt::Vertical);
  splitDockWidget(fitnessDock_, individualsDock_, Qt::Vertical);
  splitDockWidget(fitnessDock_, gapDock_, Qt::Horizontal);
  splitDockWidget(specDock_, replayDock_, Qt::Vertical);
  // Tabs come last: a dock that is split from a tab becomes one of the tabs.
  tabifyDockWidget(specDock_, draftDock_);
  tabifyDockWidget(individualsDock_, sheetDock_);
  tabifyDockWidget(sheetDock_, policiesDock_);
  tabifyDockWidget(policiesDock_, versionsDock_);
  tabifyDockWidget(specDock_, compareDock_);
  for (QDockWidget* dock : findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly)) dock->show();
  gapPageDock_->hide();
  gridPageDock_->hide();
  compareDock_->hide();
  specDock_->raise();
  individualsDock_->raise();
  sized_ = false;
  if (isVisible()) sizeDocks();
}

// Sizes hold only in a window that has its own size already.
void MainWindow::sizeDocks() {
  sized_ = true;
  const int left = width() * 19 / 100, right = width() * 29 / 100, middle = width() - left - right;
  resizeDocks({treeDock_, panelDock_, specDock_}, {left, middle, right}, Qt::Horizontal);
  const int top = panel_->sizeHint().height() + 40, rest = height() - top - 90;
  resizeDocks({panelDock_, fitnessDock_, individualsDock_}, {top, rest * 54 / 100, rest * 46 / 100}, Qt::Vertical);
  resizeDocks({specDock_, replayDock_}, {(top + rest) * 50 / 100, (top + rest) * 50 / 100}, Qt::Vertical);
  // Sizes as they shall be: what both ask for together is what the middle gets.
  resizeDocks({fitnessDock_, gapDock_}, {middle * 54 / 100, middle * 46 / 100}, Qt::Horizontal);
}

void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  if (!sized_) QTimer::singleShot(0, this, &MainWindow::sizeDocks);
}

// A page needs the room: the runs' docks go and come back as they were. One page at a time.
void MainWindow::givePage(QDockWidget* page, QAction* action, bool on) {
  for (QAction* other : {gapAction_, gridAction_}) other->setChecked(on && other == action);
  if (on && page_ == page) return;
  const bool fromRuns = page_ == nullptr;
  page_ = on ? page : nullptr;
  if (!on) {
    if (!fromRuns) restoreState(std::exchange(runsLayout_, {}), Settings::layoutVersion);
    // The pages have no place in that layout.
    for (QDockWidget* other : {gapPageDock_, gridPageDock_}) other->hide();
    if (!fromRuns && sheetWanted_) raiseDock(sheetDock_);
    return;
  }
  if (fromRuns) runsLayout_ = saveState(Settings::layoutVersion);
  for (QDockWidget* dock : findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly)) dock->hide();
  for (QDockWidget* dock : {treeDock_, page, replayDock_}) {
    removeDockWidget(dock);
    dock->setFloating(false);
    addDockWidget(Qt::LeftDockWidgetArea, dock, Qt::Horizontal);
    dock->show();
  }
  const int left = width() * 15 / 100, right = width() * 27 / 100;
  resizeDocks({treeDock_, page, replayDock_}, {left, width() - left - right, right}, Qt::Horizontal);
}

// Beside a page there is room for the tree and the replay alone: for another dock the page is left.
void MainWindow::raiseDock(QDockWidget* dock) {
  if (page_ && dock != page_ && dock != treeDock_ && dock != replayDock_) givePage(page_, nullptr, false);
  dock->show();
  dock->raise();
}

void MainWindow::restoreWindow() {
  resize(QSize(1600, 1000).boundedTo(screen()->availableSize()));
  if (const QByteArray geometry = settings_.geometry(); !geometry.isEmpty()) restoreGeometry(geometry);
  if (const QByteArray layout = settings_.layout(); !layout.isEmpty())
    sized_ = restoreState(layout, Settings::layoutVersion);
}

void MainWindow::report(const QString& error) { banner_->showMessage(MessageBanner::Kind::error, error); }
void MainWindow::inform(const QString& text) { statusBar()->showMessage(text, 8000); }

bool MainWindow::guard(const std::function<void()>& action) {
  try {
    action();
    return true;
  } catch (const std::exception& error) {
    report(QString::fromUtf8(error.what()));
    return false;
  }
}

void MainWindow::closeEvent(QCloseEvent* event) {
  sheet_->finishEditing();
  watcher_.poll();
  if (const auto active = watcher_.activeRuns(); !active.empty()) {
    const CloseAnswer answer = askWhileActive(active);
    if (answer == CloseAnswer::cancel) return event->ignore();
    if (answer == CloseAnswer::stop)
      for (const Id run : active) stopRun(run);
  }
  keepDraft();
  settings_.setWindow(saveGeometry(), runsLayout_.isEmpty() ? saveState(Settings::layoutVersion) : runsLayout_);
  event->accept();
}

Database& MainWindow::writer() {
  if (!writer_) writer_ = Database::open(watcher_.path().toStdString(), Database::Mode::readWrite);
  return *writer_;
}

}  // namespace btr::ui
