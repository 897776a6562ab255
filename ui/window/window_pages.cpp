#include "ui/window/window_pages.h"

#include <QDockWidget>
#include <QFileInfo>
#include <QMainWindow>
#include <QStandardPaths>
#include <QTableView>

#include "core/plugin/plugin_host.h"
#include "ui/charts/compare_page.h"
#include "ui/charts/fitness_chart.h"
#include "ui/charts/gap_chart.h"
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
#include "ui/window/dock_layout.h"
#include "ui/window/start_page.h"

namespace btr::ui {

WindowPages makePages(QMainWindow& window, DockLayout& layout, const PluginHost& host, const QString& program,
                      const QString& settingsFile) {
  const auto tr = [](const char* text) { return QMainWindow::tr(text); };
  const ExperimentOffers offers = offersOf(host);
  WindowPages p;
  p.alarm = new Alarm(&window, settingsFile);
  const auto dock = [&layout](const QString& name, const QString& title, const QString& icon, auto*& page, auto* made) {
    page = made;
    layout.add(name, title, icon, made);
  };
  dock("tree", tr("Experiments"), "view-list-tree", p.tree, new ExperimentTree(&window));
  dock("run", tr("Run"), "media-playback-start", p.panel, new RunPanel(&window));
  dock("fitness", tr("Fitness"), "office-chart-line", p.fitness, new FitnessChart(&window));
  dock("gap", tr("Reality gap"), "office-chart-scatter", p.gap, new GapChart(&window));
  dock("simulators", tr("Simulators"), "cpu", p.versions, new SimulatorsPage(&window));
  dock("individuals", tr("Individuals"), "view-list-details", p.individuals, new IndividualsTable(&window));
  p.individuals->view().sortByColumn(IndividualsModel::fitness, Qt::DescendingOrder);
  dock("sheet", tr("Measurement sheet"), "document-edit", p.sheet, new MeasurementSheet(&window));
  dock("policies", tr("Learning in reality"), "view-statistics", p.policies, new PolicyPage(&window));
  dock("replay", tr("Replay"), "media-playback-playing", p.replay, new ReplayPanel(&window));
  dock("draft", tr("New experiment"), "document-new", p.draft, new ExperimentForm(offers, &window));
  p.draft->setObjectName("draft");
  p.gapPage = new GapPage(program, &window);
  layout.addPage("analysis", tr("Gap analysis"), "office-chart-area", p.gapPage, {"tree", "replay"});
  dock("compare", tr("Compare runs"), "office-chart-line", p.comparePage, new ComparePage(&window));
  p.gridPage = new GridPage(program, &window);
  layout.addPage("grid", tr("The whole kick"), "view-grid", p.gridPage, {"tree", "replay"});
  // Beside the settings that are used, so that tests leave nothing in the user's folders.
  const QString data = settingsFile.isEmpty() ? QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation)
                                              : QFileInfo(settingsFile).absolutePath();
  p.livePage = new LivePage(host, program, data + "/sessions", &window);
  layout.addPage("live", tr("Scene"), "applications-games", p.livePage, {"tree"});
  dock("spec", tr("Settings of the run"), "document-properties", p.spec, new ExperimentForm(offers, &window));
  p.spec->setObjectName("spec");
  p.spec->setReadOnly(tr("A stored run never changes."));
  p.start = new StartPage(&window);
  layout.addPage("start", tr("Start"), "go-home", p.start, {"tree"});
  // Tab leads out of a table that is only read; in one that is typed into it moves through the cells.
  for (QTableView* table : window.findChildren<QTableView*>())
    if (table->editTriggers() == QAbstractItemView::NoEditTriggers) table->setTabKeyNavigation(false);
  return p;
}

}  // namespace btr::ui
