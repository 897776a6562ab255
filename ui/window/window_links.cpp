#include "ui/window/window_links.h"

#include <QFileDialog>
#include <QMessageBox>

#include "ui/controllers/draft_controller.h"
#include "ui/controllers/grid_controller.h"
#include "ui/controllers/run_controller.h"
#include "ui/experiment/experiment_form.h"
#include "ui/experiment/experiment_tree.h"
#include "ui/experiment/simulators_page.h"
#include "ui/gap/analysis_setup.h"
#include "ui/gap/gap_page.h"
#include "ui/live/live_page.h"
#include "ui/main_window.h"
#include "ui/scene3d/replay_panel.h"
#include "ui/window/dock_layout.h"
#include "ui/window/file_drops.h"
#include "ui/window/start_page.h"
#include "ui/window/window_pages.h"

namespace btr::ui {

void linkTree(const WindowLinks& to) {
  ExperimentTree* tree = to.pages.tree;
  Workbench& bench = to.bench;
  DatabaseWatcher& watcher = bench.watcher();
  QObject::connect(&watcher, &DatabaseWatcher::runsChanged, tree,
                   [to](const std::vector<ExperimentRecord>& experiments, const std::vector<RunRecord>& runs) {
                     to.pages.tree->setContent(experiments, runs, to.grids.groups());
                     to.pages.start->setRuns(experiments, runs);
                   });
  QObject::connect(&watcher, &DatabaseWatcher::versionsChanged, tree, &ExperimentTree::setSimulators);
  QObject::connect(&watcher, &DatabaseWatcher::simulatorsChanged, tree, &ExperimentTree::setSimulators);
  QObject::connect(&watcher, &DatabaseWatcher::activeChanged, tree, &ExperimentTree::setActive);
  QObject::connect(&watcher, &DatabaseWatcher::runChanged, tree,
                   [tree](const RunRecord& run) { tree->selectRun(run.id); });
  QObject::connect(tree, &ExperimentTree::runSelected, &bench, &Workbench::selectRun);
  QObject::connect(tree, &ExperimentTree::specRequested, &bench, [to](Id run) {
    to.bench.selectRun(run);
    to.layout.raise("spec");
  });
  QObject::connect(tree, &ExperimentTree::simulatorSelected, to.pages.versions, [to](Id, Id simulator) {
    to.bench.whenSelected([to, simulator] { to.pages.versions->select(simulator); });
    to.layout.raise("simulators");
  });
  QObject::connect(tree, &ExperimentTree::gridRequested, &to.grids, &GridController::show);
  QObject::connect(tree, &ExperimentTree::compareRequested, &to.window, &MainWindow::compareRuns);
  QObject::connect(tree, &ExperimentTree::continueRequested, &to.runs, &RunController::resume);
  QObject::connect(tree, &ExperimentTree::stopRequested, &to.runs, &RunController::stop);
  QObject::connect(tree, &ExperimentTree::duplicateRequested, &to.runs, &RunController::duplicate);
  QObject::connect(tree, &ExperimentTree::runNoteRequested, &to.runs, &RunController::editRunNote);
  QObject::connect(tree, &ExperimentTree::experimentNoteRequested, &to.runs, &RunController::editExperimentNote);
  QObject::connect(tree, &ExperimentTree::renameRequested, &to.runs, &RunController::renameExperiment);
  QObject::connect(tree, &ExperimentTree::exportRequested, &to.runs, &RunController::exportTable);
  QObject::connect(tree, &ExperimentTree::archivedChanged, &bench, [&bench](const std::set<Id>& experiments) {
    bench.settings().setArchived(bench.path(), {experiments.begin(), experiments.end()});
  });
  QObject::connect(&bench, &Workbench::databaseOpened, tree, [tree, &bench] {
    const auto archived = bench.settings().archived(bench.path());
    tree->setArchived({archived.begin(), archived.end()});
  });
}

/// What the replay's camera follows is as it was left.
void linkReplay(const WindowLinks& to) {
  SceneView& view = to.pages.replay->view();
  Settings& settings = to.bench.settings();
  if (settings.flag("replayFollowsRobot", false)) view.setFollow(SceneView::Follow::robot);
  if (settings.flag("replayFollowsBall", false)) view.setFollow(SceneView::Follow::ball);
  QObject::connect(&view, &SceneView::followChanged, &to.bench, [&view, &settings] {
    settings.setFlag("replayFollowsRobot", view.follow() == SceneView::Follow::robot);
    settings.setFlag("replayFollowsBall", view.follow() == SceneView::Follow::ball);
  });
}

void linkStartPage(const WindowLinks& to) {
  StartPage* start = to.pages.start;
  MainWindow& window = to.window;
  start->setShownAtStart(to.bench.settings().flag("startPage", true));
  QObject::connect(start, &StartPage::shownAtStartChanged, &to.bench,
                   [to](bool shown) { to.bench.settings().setFlag("startPage", shown); });
  QObject::connect(start, &StartPage::runWanted, &window, [to](Id run) {
    to.bench.selectRun(run);
    to.layout.raise("fitness");
  });
  QObject::connect(start, &StartPage::databaseWanted, &window, [to](const QString& file) {
    const QString path =
        file.isEmpty() ? QFileDialog::getOpenFileName(&to.window, MainWindow::tr("Open a database"), to.bench.path(),
                                                      MainWindow::tr("Experiment databases (*.db);;All files (*)"))
                       : file;
    if (!path.isEmpty() && to.window.openDatabase(path)) to.window.showPage({});
  });
  QObject::connect(start, &StartPage::newWanted, &to.drafts, &DraftController::begin);
  QObject::connect(start, &StartPage::exampleWanted, &to.drafts, &DraftController::open);
  QObject::connect(start, &StartPage::analysisWanted, &window, [&window] { window.showPage("analysis"); });
  QObject::connect(start, &StartPage::reportWanted, &window, [&window] {
    const QString folder = QFileDialog::getExistingDirectory(&window, MainWindow::tr("Folder of a gap report"));
    if (!folder.isEmpty()) window.openReport(folder);
  });
}

void linkScene(const WindowLinks& to) {
  LivePage* page = to.pages.livePage;
  Workbench& bench = to.bench;
  page->setDatabase(bench.reader());
  page->openWhenShown(bench.settings().lastGame());
  QObject::connect(page, &LivePage::opened, &bench,
                   [&bench](const QString& file) { bench.settings().setLastGame(file); });
  QObject::connect(page, &LivePage::experimentMade, &to.drafts, &DraftController::open);
}

void linkDrops(const WindowLinks& to) {
  MainWindow& window = to.window;
  auto* drops = new FileDrops(window);
  QObject::connect(drops, &FileDrops::databaseGiven, &window,
                   [&window](const QString& file) { window.openDatabase(file); });
  QObject::connect(drops, &FileDrops::experimentGiven, &to.drafts, &DraftController::open);
  // Of the page that is open: an analysis, or else the experiment in the form.
  QObject::connect(drops, &FileDrops::sceneGiven, &window, [to](const QString& file) {
    if (to.layout.page() == "analysis") return to.pages.gapPage->setup().setScene(file);
    if (to.layout.page() == "live") return to.pages.livePage->open(file);
    to.pages.draft->chooseScene(file);
    emit to.bench.dockWanted("draft");
  });
  QObject::connect(drops, &FileDrops::recordingsGiven, &window, [to](const QStringList& files) {
    to.window.showPage("analysis");
    to.pages.gapPage->setup().addRecordings(files);
  });
  QObject::connect(drops, &FileDrops::reportGiven, &window, &MainWindow::openReport);
  QObject::connect(drops, &FileDrops::refused, &to.bench, &Workbench::report);
  RunLauncher& launcher = to.bench.launcher();
  QObject::connect(drops, &FileDrops::robotGiven, &window, [to, &launcher](const QString& file) {
    if (to.layout.page() == "live") return to.pages.livePage->open(file);
    launcher.checkModel(file);
  });
  QObject::connect(drops, &FileDrops::gameGiven, &window, &MainWindow::openScene);
  QObject::connect(drops, &FileDrops::sessionGiven, &window, &MainWindow::openScene);
  QObject::connect(&launcher, &RunLauncher::modelChecked, &window, [&window](const QString& file, const QString& text) {
    auto* box = new QMessageBox(QMessageBox::Information, MainWindow::tr("Robot model"),
                                MainWindow::tr("%1 is a robot model. A scene names it under “robots”.").arg(file),
                                QMessageBox::Close, &window);
    box->setObjectName("robotModel");
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->setDetailedText(text);
    box->open();
  });
}

}  // namespace btr::ui
