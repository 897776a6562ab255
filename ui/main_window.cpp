#include "ui/main_window.h"

#include <QAbstractSpinBox>
#include <QCloseEvent>
#include <QDockWidget>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QScreen>

#include "ui/charts/compare_page.h"
#include "ui/charts/fitness_chart.h"
#include "ui/charts/gap_chart.h"
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
#include "ui/gap/gap_page.h"
#include "ui/grid/grid_page.h"
#include "ui/live/live_page.h"
#include "ui/measure/alarm.h"
#include "ui/measure/measurement_sheet.h"
#include "ui/measure/policy_page.h"
#include "ui/scene3d/replay_panel.h"
#include "ui/window/start_page.h"
#include "ui/window/window_links.h"
#include "ui/window/window_menus.h"
#include "ui/window/window_messages.h"
#include "ui/window/window_place.h"

namespace btr::ui {
namespace {

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

/// Whether somebody is in the middle of a text. An empty line has the focus when the window opens.
bool isTypedInto(const QWidget* focus) {
  const auto* line = qobject_cast<const QLineEdit*>(focus);
  return (line && !line->text().isEmpty()) || qobject_cast<const QAbstractSpinBox*>(focus) ||
         qobject_cast<const QPlainTextEdit*>(focus);
}

}  // namespace

MainWindow::MainWindow(std::shared_ptr<const PluginHost> host, Theme& theme, const WindowOptions& options)
    : theme_(theme), layout_(*this), bench_(std::move(host), options, *this) {
  setObjectName("mainWindow");
  theme_.apply(bench_.settings().look());
  pages_ = makePages(*this, layout_, *bench_.host(), bench_.launcher().program(), options.settingsFile);
  messages_ = new WindowMessages(*this, bench_);
  connect(messages_, &WindowMessages::aboutToTakeRoom, &layout_, &DockLayout::keepRunInSight);
  place_ = new WindowPlace(*this, layout_, bench_.settings());
  makeControllers();
  const WindowLinks links{*this, bench_, layout_, pages_, *drafts_, *runs_, *grids_};
  linkTree(links);
  linkStartPage(links);
  linkReplay(links);
  linkScene(links);
  linkDrops(links);
  makeWindowMenus({*this, theme_, bench_, layout_, pages_, *drafts_, *runs_, *replays_},
                  {new AlarmPlace(*pages_.alarm, this), &messages_->bar(), [this] { place_->reset(); }});
  place_->restore();
  drafts_->restore();
  for (const std::string& problem : bench_.host()->problems())
    bench_.report(tr("A plugin was left out: %1").arg(QString::fromStdString(problem)));
}

MainWindow::~MainWindow() = default;

MessageBanner& MainWindow::banner() { return messages_->banner(); }

bool MainWindow::openDatabase(const QString& path, Workbench::Absent absent) { return bench_.open(path, absent); }

void MainWindow::makeControllers() {
  const WindowPages& p = pages_;
  runs_ = new RunController(bench_);
  drafts_ = new DraftController(bench_, *p.draft, *p.spec);
  new RunViews(bench_, {*p.spec, *p.panel, *p.fitness, *p.gap, *p.versions, *p.individuals});
  measuring_ = new MeasureController(bench_, *runs_, {*p.sheet, *p.policies, *p.alarm, *p.individuals});
  replays_ = new ReplayController(bench_, *p.replay, *p.individuals, *p.gapPage);
  grids_ = new GridController(bench_, *runs_, *p.gridPage);
  new RigController(bench_, *p.gapPage, *p.tree, *p.versions);
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
  connect(measuring_, &MeasureController::hiddenChanged, p.fitness, &FitnessChart::setHidden);
  connect(measuring_, &MeasureController::measured, p.fitness, &FitnessChart::setMeasurements);
  connect(grids_, &GridController::kickWanted, replays_, &ReplayController::playKick);
  connect(&bench_, &Workbench::dockWanted, this, &MainWindow::raise);
  // Who is on a page stays there; the alarm rings, and the sheet is in front when the page is left. The keys go where
  // the next cell is marked, not to the button that began the run; whoever is typing elsewhere is left alone.
  const auto showSheet = [this] {
    layout_.raise("sheet");
    if (!isTypedInto(focusWidget())) pages_.sheet->setFocus();
  };
  connect(measuring_, &MeasureController::sheetWanted, this, [this, showSheet] {
    if (layout_.page().isEmpty()) showSheet();
  });
  connect(&layout_, &DockLayout::pageChanged, this, [this, showSheet](const QString& page) {
    if (page == "grid") grids_->read();
    if (page.isEmpty() && measuring_->isSheetWanted()) showSheet();
  });
}

// A wide page: it stands in a window of its own size until the user docks it.
void MainWindow::compareRuns(const std::vector<Id>& runs) { comparing_->compare(runs); }

void MainWindow::raise(const QString& dock) {
  if (layout_.isPage(layout_.dock(dock))) return layout_.showPage(dock);
  // First: the layout that comes back from behind a page has its own say about which docks float.
  layout_.raise(dock);
  if (dock == "compare" && !layout_.dock(dock)->isFloating()) {
    layout_.dock(dock)->setFloating(true);
    layout_.dock(dock)->resize(QSize(1200, 800).boundedTo(screen()->availableSize()));
    layout_.dock(dock)->raise();
  }
  // Who asks for the sheet wants to type into it.
  if (dock == "sheet") pages_.sheet->setFocus();
}

void MainWindow::showPage(const QString& page) {
  layout_.showPage(page);
  if (page == "analysis") pages_.gapPage->setFocus();
}

void MainWindow::showStartIfIdle() {
  if (bench_.settings().flag("startPage", true) && !StartPage::isSomethingOpen(bench_.watcher().runs()))
    showPage("start");
}

void MainWindow::openScene(const QString& file) {
  showPage("live");
  pages_.livePage->open(file);
}

bool MainWindow::openReport(const QString& folder) {
  showPage("analysis");
  return pages_.gapPage->openReport(folder);
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
  pages_.sheet->finishEditing();
  if (!drafts_->keep() || !runs_->mayClose()) return event->ignore();
  place_->keep();
  event->accept();
}

}  // namespace btr::ui
