#include "ui/main_window.h"

#include <QCloseEvent>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QMessageBox>
#include <QProcess>
#include <QScreen>
#include <QStatusBar>
#include <QTableView>
#include <QTimer>
#include <QToolBar>
#include <QVBoxLayout>

#include "ui/charts/compare_page.h"
#include "ui/charts/fitness_chart.h"
#include "ui/charts/gap_chart.h"
#include "ui/common/message_banner.h"
#include "ui/controllers/compare_controller.h"
#include "ui/controllers/draft_controller.h"
#include "ui/controllers/grid_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/controllers/replay_controller.h"
#include "ui/controllers/rig_controller.h"
#include "ui/controllers/run_controller.h"
#include "ui/controllers/run_views.h"
#include "ui/database/individuals_table.h"
#include "ui/experiment/experiment_form.h"
#include "ui/experiment/experiment_tree.h"
#include "ui/experiment/run_panel.h"
#include "ui/experiment/simulators_page.h"
#include "ui/gap/analysis_setup.h"
#include "ui/gap/gap_page.h"
#include "ui/grid/grid_page.h"
#include "ui/measure/alarm.h"
#include "ui/measure/measurement_sheet.h"
#include "ui/measure/policy_page.h"
#include "ui/scene3d/replay_panel.h"
#include "ui/window/file_drops.h"
#include "ui/window/start_page.h"
#include "ui/window/window_menus.h"
#include "ui/window/window_pages.h"

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
    : theme_(theme), layout_(*this), bench_(std::move(host), options, *this), pages_(std::make_unique<WindowPages>()) {
  setObjectName("mainWindow");
  theme_.apply(bench_.settings().look());
  pages_->alarm = new Alarm(this, options.settingsFile);
  makeDocks();
  makeMessages();
  makeControllers();
  connectTree();
  connectStart();
  connectDrops();
  makeWindowMenus({*this, theme_, bench_, layout_, *pages_, *drafts_, *runs_, *replays_},
                  {new AlarmPlace(*pages_->alarm, this), messages_, [this] { resetLayout(); }});
  restoreWindow();
  drafts_->restore();
  for (const std::string& problem : bench_.host()->problems())
    bench_.report(tr("A plugin was left out: %1").arg(QString::fromStdString(problem)));
  showTitle();
}

MainWindow::~MainWindow() = default;

ExperimentForm& MainWindow::draft() { return *pages_->draft; }
GapPage& MainWindow::gapPage() { return *pages_->gapPage; }
GridPage& MainWindow::gridPage() { return *pages_->gridPage; }
ComparePage& MainWindow::comparePage() { return *pages_->comparePage; }

bool MainWindow::openDatabase(const QString& path, Workbench::Absent absent) { return bench_.open(path, absent); }

void MainWindow::makeDocks() {
  const ExperimentOffers offers = offersOf(*bench_.host());
  const QString program = bench_.launcher().program();
  WindowPages& p = *pages_;
  const auto dock = [this](const QString& name, const QString& title, const QString& icon, auto*& page, auto* made) {
    page = made;
    layout_.add(name, title, icon, made);
  };
  dock("tree", tr("Experiments"), "view-list-tree", p.tree, new ExperimentTree(this));
  dock("run", tr("Run"), "media-playback-start", p.panel, new RunPanel(this));
  dock("fitness", tr("Fitness"), "office-chart-line", p.fitness, new FitnessChart(this));
  dock("gap", tr("Reality gap"), "office-chart-scatter", p.gap, new GapChart(this));
  dock("simulators", tr("Simulators"), "cpu", p.versions, new SimulatorsPage(this));
  dock("individuals", tr("Individuals"), "view-list-details", p.individuals, new IndividualsTable(this));
  p.individuals->view().sortByColumn(IndividualsModel::fitness, Qt::DescendingOrder);
  dock("sheet", tr("Measurement sheet"), "document-edit", p.sheet, new MeasurementSheet(this));
  dock("policies", tr("Learning in reality"), "view-statistics", p.policies, new PolicyPage(this));
  dock("replay", tr("Replay"), "media-playback-playing", p.replay, new ReplayPanel(this));
  dock("draft", tr("New experiment"), "document-new", p.draft, new ExperimentForm(offers, this));
  p.draft->setObjectName("draft");
  p.gapPage = new GapPage(program, this);
  layout_.addPage("analysis", tr("Gap analysis"), "office-chart-area", p.gapPage, {"tree", "replay"});
  dock("compare", tr("Compare runs"), "office-chart-line", p.comparePage, new ComparePage(this));
  p.gridPage = new GridPage(program, this);
  layout_.addPage("grid", tr("The whole kick"), "view-grid", p.gridPage, {"tree", "replay"});
  dock("spec", tr("Settings of the run"), "document-properties", p.spec, new ExperimentForm(offers, this));
  p.spec->setObjectName("spec");
  p.spec->setReadOnly(tr("A stored run never changes."));
  p.start = new StartPage(this);
  layout_.addPage("start", tr("Start"), "go-home", p.start, {"tree"});
  // Tab leads out of a table that is only read; in one that is typed into it moves through the cells.
  for (QTableView* table : findChildren<QTableView*>())
    if (table->editTriggers() == QAbstractItemView::NoEditTriggers) table->setTabKeyNavigation(false);
}

// Messages stand above everything, in a tool bar of their own that is there only while there is one.
void MainWindow::makeMessages() {
  banner_ = new MessageBanner(this);
  messages_ = new QToolBar(tr("Messages"), this);
  messages_->setObjectName("toolbar.messages");
  messages_->setMovable(false);
  messages_->toggleViewAction()->setVisible(false);
  auto* stack = new MessageArea(messages_);
  auto* column = new QVBoxLayout(stack);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  column->addWidget(banner_);
  stack->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Maximum);
  messages_->addWidget(stack);
  addToolBar(Qt::TopToolBarArea, messages_);
  const auto showIfAny = [this] { messages_->setVisible(!banner_->text().isEmpty()); };
  showIfAny();
  connect(banner_, &MessageBanner::shown, messages_, showIfAny);
  connect(banner_, &MessageBanner::cleared, messages_, showIfAny);
  connect(&bench_, &Workbench::reported, banner_,
          [this](const QString& error) { banner_->showMessage(MessageBanner::Kind::error, error); });
  connect(&bench_, &Workbench::noted, banner_,
          [this](const QString& text) { banner_->showMessage(MessageBanner::Kind::information, text); });
  connect(&bench_, &Workbench::messagesOver, banner_, &MessageBanner::clear);
  connect(&bench_, &Workbench::informed, this, [this](const QString& text) { statusBar()->showMessage(text, 8000); });

  databaseLabel_ = new QLabel(this);
  databaseLabel_->setObjectName("database");
  activeLabel_ = new QLabel(this);
  databaseLabel_->setContentsMargins(6, 0, 6, 0);
  activeLabel_->setContentsMargins(6, 0, 6, 0);
  statusBar()->addPermanentWidget(activeLabel_);
  statusBar()->addPermanentWidget(databaseLabel_);
  connect(&bench_, &Workbench::databaseOpened, this, [this] {
    banner_->clear();
    showTitle();
    if (bench_.isReadOnly())
      bench_.note(tr("%1 may only be read: it can be looked at, and nothing can be started or entered.")
                      .arg(QFileInfo(bench_.path()).fileName()));
  });
  connect(&bench_.watcher(), &DatabaseWatcher::activeChanged, this, [this](const std::set<Id>& active) {
    activeLabel_->setText(active.empty()       ? QString()
                          : active.size() == 1 ? tr("1 run is working")
                                               : tr("%1 runs are working").arg(active.size()));
  });
}

void MainWindow::makeControllers() {
  WindowPages& p = *pages_;
  runs_ = new RunController(bench_);
  drafts_ = new DraftController(bench_, *p.draft, *p.spec);
  views_ = new RunViews(bench_, {*p.spec, *p.panel, *p.fitness, *p.gap, *p.versions, *p.individuals});
  measuring_ = new MeasureController(bench_, *runs_, {*p.sheet, *p.policies, *p.alarm, *p.individuals});
  replays_ = new ReplayController(bench_, *p.replay, *p.individuals, *p.gapPage);
  grids_ = new GridController(bench_, *runs_, *p.gridPage);
  rigs_ = new RigController(bench_, *p.gapPage, *p.tree, *p.versions);
  comparing_ = new CompareController(bench_, *p.comparePage);

  runs_->setJobs(bench_.settings().jobs());
  p.panel->setJobs(runs_->jobs());
  connect(p.panel, &RunPanel::jobsChanged, this, [this](int jobs) {
    runs_->setJobs(jobs);
    bench_.settings().setJobs(jobs);
  });
  connect(p.panel, &RunPanel::continueRequested, runs_, &RunController::resume);
  connect(p.panel, &RunPanel::stopRequested, runs_, &RunController::stop);
  connect(measuring_, &MeasureController::measuringChanged, p.panel, &RunPanel::setMeasuring);
  connect(measuring_, &MeasureController::blindChanged, p.panel, &RunPanel::setBlind);
  connect(measuring_, &MeasureController::measured, p.fitness, &FitnessChart::setMeasurements);
  connect(grids_, &GridController::kickWanted, replays_, &ReplayController::playKick);
  connect(&bench_, &Workbench::dockWanted, this, &MainWindow::raise);
  // Who is on a page stays there; the alarm rings, and the sheet is in front when the page is left.
  connect(measuring_, &MeasureController::sheetWanted, this, [this] {
    if (layout_.page().isEmpty()) layout_.raise("sheet");
  });
  connect(&layout_, &DockLayout::pageChanged, this, [this](const QString& page) {
    if (page == "grid") grids_->read();
    if (page.isEmpty() && measuring_->isSheetWanted()) layout_.raise("sheet");
  });
}

void MainWindow::connectTree() {
  ExperimentTree* tree = pages_->tree;
  DatabaseWatcher& watcher = bench_.watcher();
  connect(&watcher, &DatabaseWatcher::runsChanged, this,
          [this, tree](const std::vector<ExperimentRecord>& experiments, const std::vector<RunRecord>& runs) {
            tree->setContent(experiments, runs, grids_->groups());
            pages_->start->setRuns(experiments, runs);
          });
  connect(&watcher, &DatabaseWatcher::versionsChanged, tree, &ExperimentTree::setSimulators);
  connect(&watcher, &DatabaseWatcher::simulatorsChanged, tree, &ExperimentTree::setSimulators);
  connect(&watcher, &DatabaseWatcher::activeChanged, tree, &ExperimentTree::setActive);
  connect(&watcher, &DatabaseWatcher::runChanged, tree, [tree](const RunRecord& run) { tree->selectRun(run.id); });
  connect(tree, &ExperimentTree::runSelected, &bench_, &Workbench::selectRun);
  connect(tree, &ExperimentTree::specRequested, this, [this](Id run) {
    bench_.selectRun(run);
    layout_.raise("spec");
  });
  connect(tree, &ExperimentTree::simulatorSelected, this, [this](Id, Id simulator) {
    pages_->versions->select(simulator);
    layout_.raise("simulators");
  });
  connect(tree, &ExperimentTree::gridRequested, grids_, &GridController::show);
  connect(tree, &ExperimentTree::compareRequested, this, &MainWindow::compareRuns);
  connect(tree, &ExperimentTree::continueRequested, runs_, &RunController::resume);
  connect(tree, &ExperimentTree::stopRequested, runs_, &RunController::stop);
  connect(tree, &ExperimentTree::duplicateRequested, runs_, &RunController::duplicate);
  connect(tree, &ExperimentTree::runNoteRequested, runs_, &RunController::editRunNote);
  connect(tree, &ExperimentTree::experimentNoteRequested, runs_, &RunController::editExperimentNote);
  connect(tree, &ExperimentTree::renameRequested, runs_, &RunController::renameExperiment);
  connect(tree, &ExperimentTree::exportRequested, runs_, &RunController::exportTable);
  connect(tree, &ExperimentTree::archivedChanged, this, [this](const std::set<Id>& experiments) {
    bench_.settings().setArchived(bench_.path(), {experiments.begin(), experiments.end()});
  });
  connect(&bench_, &Workbench::databaseOpened, tree, [this, tree] {
    const auto archived = bench_.settings().archived(bench_.path());
    tree->setArchived({archived.begin(), archived.end()});
  });
}

void MainWindow::connectStart() {
  StartPage* start = pages_->start;
  start->setShownAtStart(bench_.settings().flag("startPage", true));
  connect(start, &StartPage::shownAtStartChanged, this,
          [this](bool shown) { bench_.settings().setFlag("startPage", shown); });
  connect(start, &StartPage::runWanted, this, [this](Id run) {
    bench_.selectRun(run);
    layout_.raise("fitness");
  });
  connect(start, &StartPage::databaseWanted, this, [this](const QString& file) {
    const QString path = file.isEmpty() ? QFileDialog::getOpenFileName(this, tr("Open a database"), bench_.path(),
                                                                       tr("Experiment databases (*.db);;All files (*)"))
                                        : file;
    if (!path.isEmpty() && openDatabase(path)) showPage({});
  });
  connect(start, &StartPage::newWanted, drafts_, &DraftController::begin);
  connect(start, &StartPage::exampleWanted, drafts_, &DraftController::open);
  connect(start, &StartPage::analysisWanted, this, [this] { showPage("analysis"); });
  connect(start, &StartPage::reportWanted, this, [this] {
    const QString folder = QFileDialog::getExistingDirectory(this, tr("Folder of a gap report"));
    if (!folder.isEmpty()) openReport(folder);
  });
}

void MainWindow::connectDrops() {
  auto* drops = new FileDrops(*this);
  connect(drops, &FileDrops::databaseGiven, this, [this](const QString& file) { openDatabase(file); });
  connect(drops, &FileDrops::experimentGiven, drafts_, &DraftController::open);
  // Of the page that is open: an analysis, or else the experiment in the form.
  connect(drops, &FileDrops::sceneGiven, this, [this](const QString& file) {
    if (layout_.page() == "analysis") return gapPage().setup().setScene(file);
    draft().chooseScene(file);
    raise("draft");
  });
  connect(drops, &FileDrops::recordingsGiven, this, [this](const QStringList& files) {
    showPage("analysis");
    gapPage().setup().addRecordings(files);
  });
  connect(drops, &FileDrops::reportGiven, this, &MainWindow::openReport);
  connect(drops, &FileDrops::refused, &bench_, &Workbench::report);
  connect(drops, &FileDrops::robotGiven, &bench_.launcher(), &RunLauncher::checkModel);
  connect(&bench_.launcher(), &RunLauncher::modelChecked, this, [this](const QString& file, const QString& text) {
    auto* box = new QMessageBox(QMessageBox::Information, tr("Robot model"),
                                tr("%1 is a robot model. A scene names it under “robots”.").arg(file),
                                QMessageBox::Close, this);
    box->setObjectName("robotModel");
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setDetailedText(text);
    box->open();
  });
}

// A wide page: it stands in a window of its own size until the user docks it.
void MainWindow::compareRuns(const std::vector<Id>& runs) { comparing_->compare(runs); }

void MainWindow::raise(const QString& dock) {
  if (layout_.isPage(layout_.dock(dock))) return layout_.showPage(dock);
  if (dock == "compare" && !layout_.dock(dock)->isFloating()) {
    layout_.dock(dock)->setFloating(true);
    layout_.dock(dock)->resize(QSize(1200, 800).boundedTo(screen()->availableSize()));
  }
  layout_.raise(dock);
}

void MainWindow::showPage(const QString& page) {
  layout_.showPage(page);
  if (page == "analysis") gapPage().setFocus();
}

void MainWindow::showStartIfIdle() {
  if (bench_.settings().flag("startPage", true) && !StartPage::isSomethingOpen(bench_.watcher().runs()))
    showPage("start");
}

bool MainWindow::openReport(const QString& folder) {
  showPage("analysis");
  return gapPage().openReport(folder);
}

/// The screen less what a window manager's frame and title take.
QSize MainWindow::defaultSize() const {
  const QSize frame = isVisible() && frameSize() != size() ? frameSize() - size() : QSize(16, 44);
  return QSize(1600, 1000).boundedTo(screen()->availableSize() - frame);
}

void MainWindow::resetLayout() {
  if (!isMaximized() && !isFullScreen()) resize(defaultSize());
  layout_.arrange();
}

void MainWindow::showEvent(QShowEvent* event) {
  QMainWindow::showEvent(event);
  QTimer::singleShot(0, this, [this] {
    keepOnScreen();
    layout_.sizeOnce();
  });
}

// Only now is it known how large the frame is.
void MainWindow::keepOnScreen() {
  if (isMaximized() || isFullScreen()) return;
  const QRect room = screen()->availableGeometry();
  if (const QSize most = room.size() - (frameSize() - size()); width() > most.width() || height() > most.height())
    resize(size().boundedTo(most));
  if (!room.contains(frameGeometry().topLeft())) move(room.topLeft());
}

void MainWindow::restoreWindow() {
  resize(defaultSize());
  if (const QByteArray geometry = bench_.settings().geometry(); !geometry.isEmpty()) restoreGeometry(geometry);
  layout_.arrange();
  if (const QByteArray layout = bench_.settings().layout(); !layout.isEmpty()) layout_.restore(layout);
}

// Widgets behind a tab count as visible to Qt, which would give them the focus: the keys would go where nobody looks.
bool MainWindow::focusNextPrevChild(bool next) {
  const auto takesTab = [this](const QWidget* widget) {
    if (!(widget->focusPolicy() & Qt::TabFocus) || widget->focusProxy() || !widget->isEnabled()) return false;
    if (!widget->isVisible() || widget->window() != this) return false;
    for (const QWidget* above = widget; above; above = above->parentWidget())
      if (const auto* dock = qobject_cast<const QDockWidget*>(above)) return DockLayout::isInFront(dock);
    return true;
  };
  QWidget* from = focusWidget() ? focusWidget() : this;
  const auto step = [next](QWidget* widget) {
    return next ? widget->nextInFocusChain() : widget->previousInFocusChain();
  };
  for (QWidget* widget = step(from); widget != from; widget = step(widget))
    if (takesTab(widget)) {
      widget->setFocus(next ? Qt::TabFocusReason : Qt::BacktabFocusReason);
      return true;
    }
  return false;
}

void MainWindow::closeEvent(QCloseEvent* event) {
  pages_->sheet->finishEditing();
  if (!runs_->mayClose()) return event->ignore();
  drafts_->keep();
  bench_.settings().setWindow(saveGeometry(), layout_.state());
  event->accept();
}

void MainWindow::showTitle() {
  const QString name = QFileInfo(bench_.path()).fileName();
  const QString shown = bench_.isReadOnly() ? tr("%1 (read only)").arg(name) : name;
  setWindowTitle(name.isEmpty() ? QStringLiteral("UCHILSIM") : shown + QStringLiteral(" — UCHILSIM"));
  setWindowFilePath(QString());
  databaseLabel_->setText(name.isEmpty() ? tr("No database") : shown);
  databaseLabel_->setToolTip(bench_.path());
}

}  // namespace btr::ui
