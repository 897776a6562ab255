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
      layout_(*this),
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
  layout_.add("tree", tr("Experiments"), "view-list-tree", tree_);
  layout_.add("run", tr("Run"), "media-playback-start", panel_);
  layout_.add("fitness", tr("Fitness"), "office-chart-line", fitness_);
  layout_.add("gap", tr("Reality gap"), "office-chart-scatter", gap_);
  layout_.add("simulators", tr("Simulators"), "cpu", versions_);
  layout_.add("individuals", tr("Individuals"), "view-list-details", individuals_);
  layout_.add("sheet", tr("Measurement sheet"), "document-edit", sheet_);
  layout_.add("policies", tr("Learning in reality"), "view-statistics", policies_);
  layout_.add("replay", tr("Replay"), "media-playback-playing", replay_);
  layout_.add("draft", tr("New experiment"), "document-new", draft_);
  makeGapPage();
  makeComparePage();
  makeGridPage();
  layout_.add("spec", tr("Settings of the run"), "document-properties", spec_);

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
  if (const QByteArray geometry = settings_.geometry(); !geometry.isEmpty()) restoreGeometry(geometry);
  layout_.arrange();
  if (const QByteArray layout = settings_.layout(); !layout.isEmpty()) layout_.restore(layout);
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
  settings_.setWindow(saveGeometry(), layout_.state());
  event->accept();
}

Database& MainWindow::writer() {
  if (!writer_) writer_ = Database::open(watcher_.path().toStdString(), Database::Mode::readWrite);
  return *writer_;
}

}  // namespace btr::ui
