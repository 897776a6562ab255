// Menus and tool bar of the main window.
#include <QActionGroup>
#include <QApplication>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenuBar>
#include <QMessageBox>
#include <QToolBar>
#include <QUndoStack>

#include "core/store/database.h"
#include "ui/charts/fitness_chart.h"
#include "ui/charts/gap_chart.h"
#include "ui/charts/plot_widget.h"
#include "ui/common/manual.h"
#include "ui/common/plugins_dialog.h"
#include "ui/common/resources.h"
#include "ui/experiment/experiment_form.h"
#include "ui/experiment/experiment_tree.h"
#include "ui/main_window.h"

namespace btr::ui {
namespace {

// A narrow window keeps room for the alarm: its tools are icons.
class ToolBar final : public QToolBar {
 public:
  using QToolBar::QToolBar;

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QToolBar::resizeEvent(event);
    setToolButtonStyle(width() < 1150 ? Qt::ToolButtonIconOnly : Qt::ToolButtonTextBesideIcon);
  }
};

}  // namespace

void MainWindow::makeMenus() {
  // Icons are asked for again when the look changes: dark icons vanish on a dark window.
  const auto add = [this](QMenu* menu, const QString& icon, const QString& text, const QKeySequence& keys, auto slot) {
    QAction* action = menu->addAction(themeIcon(icon), text);
    action->setShortcut(keys);
    connect(action, &QAction::triggered, this, slot);
    return action;
  };

  QMenu* file = menuBar()->addMenu(tr("&File"));
  QAction* fresh = add(file, "document-new", tr("&New experiment"), QKeySequence::New, [this] { newExperiment(); });
  QMenu* examples = file->addMenu(themeIcon("folder-templates"), tr("New from e&xample"));
  connect(examples, &QMenu::aboutToShow, this, [this, examples] { fillExamples(*examples); });
  QAction* open =
      add(file, "document-open", tr("&Open experiment…"), QKeySequence::Open, [this] { openExperimentWithDialog(); });
  // Ctrl+S is of the page that has the focus: the measurement sheet, or the form of a new experiment.
  QAction* save = add(file, "document-save-as", tr("&Save experiment as…"), QKeySequence("Ctrl+Shift+S"),
                      [this] { saveExperiment(); });
  file->addSeparator();
  QAction* database = add(file, "folder-open", tr("Open &database…"), QKeySequence("Ctrl+Shift+O"), [this] {
    const QString path = QFileDialog::getOpenFileName(this, tr("Open a database"), databasePath(),
                                                      tr("Experiment databases (*.db);;All files (*)"));
    if (!path.isEmpty()) openDatabase(path);
  });
  add(file, "folder-new", tr("New da&tabase…"), {}, [this] {
    const QString path =
        QFileDialog::getSaveFileName(this, tr("Make a database"), databasePath(), tr("Experiment databases (*.db)"),
                                     nullptr, QFileDialog::DontConfirmOverwrite);
    if (path.isEmpty()) return;
    openDatabase(QFileInfo(path).suffix().isEmpty() ? path + ".db" : path);
  });
  recentMenu_ = file->addMenu(themeIcon("document-open-recent"), tr("&Recent databases"));
  fillRecent();
  add(file, "document-import", tr("Add runs of another data&base…"), {}, [this] { mergeWithDialog(); });
  add(file, "document-save", tr("Back &up the database…"), {}, [this] {
    backUpWithDialog();
  })->setObjectName("backUpDatabase");
  file->addSeparator();
  QMenu* exports = file->addMenu(themeIcon("document-export"), tr("&Export"));
  for (const auto& [what, label] :
       {std::pair{"generations", tr("Generations as CSV…")}, std::pair{"individuals", tr("Individuals as CSV…")},
        std::pair{"gaps", tr("Reality gaps as CSV…")}, std::pair{"simulators", tr("Simulator versions as CSV…")},
        std::pair{"policies", tr("Policies of L2 as CSV…")}, std::pair{"steps", tr("Steps of L2 as CSV…")}})
    exports->addAction(label, this, [this, name = QString(what)] { exportRun(run_.id, name); });
  exports->addSeparator();
  exports->addAction(tr("Fitness chart…"), this, [this] { fitness_->plot().exportWithDialog(); });
  exports->addAction(tr("Reality gap chart…"), this, [this] { gap_->plot().exportWithDialog(); });
  connect(exports, &QMenu::aboutToShow, this, [this, exports] {
    for (QAction* action : exports->actions()) action->setEnabled(run_.id != 0);
  });
  file->addSeparator();
  add(file, "application-exit", tr("&Quit"), QKeySequence::Quit, [this] { close(); });

  makeEditMenu();
  runMenu_ = menuBar()->addMenu(tr("&Run"));
  connect(runMenu_, &QMenu::aboutToShow, this, [this] { fillRunMenu(); });
  fillRunMenu();

  viewMenu_ = menuBar()->addMenu(tr("&View"));
  for (QDockWidget* dock : findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly))
    if (!layout_.isPage(dock)) viewMenu_->addAction(dock->toggleViewAction());
  viewMenu_->addSeparator();
  QMenu* looks = viewMenu_->addMenu(themeIcon("color-management"), tr("&Look"));
  auto* group = new QActionGroup(this);
  for (const auto& [look, label] : {std::pair{Look::system, tr("As the &system")}, std::pair{Look::light, tr("&Light")},
                                    std::pair{Look::dark, tr("&Dark")}}) {
    QAction* action = looks->addAction(label);
    action->setObjectName("look." + nameOf(look));
    action->setCheckable(true);
    action->setChecked(settings_.look() == look);
    group->addAction(action);
    connect(action, &QAction::triggered, this, [this, chosen = look] {
      settings_.setLook(chosen);
      theme_.apply(chosen);
    });
  }
  gapAction_ = add(viewMenu_, "office-chart-area", tr("&Gap analysis"), Qt::Key_F8,
                   [this] { showGapPage(gapAction_->isChecked()); });
  gapAction_->setObjectName("showGapPage");
  gapAction_->setCheckable(true);
  gapAction_->setToolTip(tr("Recordings against simulation: what physics is missing (F8)"));
  gridAction_ = add(viewMenu_, "view-grid", tr("The &whole kick"), Qt::Key_F9,
                    [this] { showGridPage(gridAction_->isChecked()); });
  gridAction_->setObjectName("showGridPage");
  gridAction_->setCheckable(true);
  gridAction_->setToolTip(tr("Grids of experiments: cells, and the kicks between them (F9)"));
  connect(&layout_, &DockLayout::pageChanged, this, [this](const QString& page) {
    gapAction_->setChecked(page == "analysis");
    gridAction_->setChecked(page == "grid");
    if (page.isEmpty() && sheetWanted_) layout_.raise("sheet");
  });
  add(viewMenu_, "view-restore", tr("&Reset layout"), {}, [this] { resetLayout(); })->setObjectName("resetLayout");
  QAction* full = add(viewMenu_, "view-fullscreen", tr("&Full screen"), QKeySequence::FullScreen,
                      [this] { setWindowState(windowState() ^ Qt::WindowFullScreen); });
  full->setShortcuts({QKeySequence(Qt::Key_F11)});

  QMenu* help = menuBar()->addMenu(tr("&Help"));
  add(help, "help-contents", tr("&Manual"), Qt::Key_F1, [this] {
    if (const QString problem = Manual().open(Manual::pageFor(QApplication::focusWidget())); !problem.isEmpty())
      report(problem);
  })->setObjectName("help.manual");
  add(help, "preferences-plugin", tr("&Plugins…"), {}, [this] { PluginsDialog(*host_, this).exec(); });
  add(help, "help-about", tr("&About UCHILSIM"), {}, [this] { about(); })->setObjectName("help.about");

  for (QAction* action : {save, database}) action->setPriority(QAction::LowPriority);
  auto* bar = new ToolBar(tr("Tools"), this);
  bar->setObjectName("toolbar.main");
  bar->setMovable(false);
  bar->setIconSize({18, 18});
  bar->addActions({fresh, open, save});
  bar->addSeparator();
  bar->addAction(database);
  bar->addSeparator();
  bar->addActions({gapAction_, gridAction_});
  insertToolBar(findChild<QToolBar*>("toolbar.messages"), bar);
  insertToolBarBreak(findChild<QToolBar*>("toolbar.messages"));
  bar->addSeparator();
  bar->addWidget(alarmPlace_);
}

void MainWindow::fillRecent() {
  recentMenu_->clear();
  for (const QString& path : settings_.recentDatabases())
    recentMenu_->addAction(path, this, [this, path] { openDatabase(path); });
  recentMenu_->setEnabled(!recentMenu_->isEmpty());
}

// Shortcuts work while the menu is closed too, so the entries always exist and say themselves when they do not fit.
void MainWindow::fillRunMenu() {
  runMenu_->clear();
  QAction* start =
      runMenu_->addAction(themeIcon("run-build"), tr("Start the &new experiment"), this, [this] { startDraft(); });
  start->setShortcut(Qt::Key_F5);
  runMenu_->addSeparator();
  const bool works = watcher_.activeRuns().count(run_.id) > 0;
  QAction* go = runMenu_->addAction(themeIcon("media-playback-start"), tr("&Continue the selected run"), this,
                                    [this] { continueRun(run_.id); });
  go->setShortcut(Qt::Key_F6);
  go->setEnabled(!runMenu_->isVisible() || (run_.id != 0 && !works));
  QAction* stop = runMenu_->addAction(themeIcon("media-playback-stop"), tr("&Stop the selected run"), this,
                                      [this] { stopRun(run_.id); });
  stop->setShortcut(QKeySequence("Shift+F6"));
  runMenu_->addSeparator();
  QAction* copy = runMenu_->addAction(themeIcon("edit-copy"), tr("&Duplicate with another seed…"), this,
                                      [this] { duplicateRun(run_.id); });
  copy->setEnabled(run_.id != 0);
  QAction* best = runMenu_->addAction(themeIcon("media-playback-playing"),
                                      tr("&Replay the best of the last generation"), this, [this] { replayBest(); });
  best->setShortcut(Qt::Key_F7);
  QAction* byItself = runMenu_->addAction(tr("Go on by itself when all is &measured"));
  byItself->setCheckable(true);
  byItself->setChecked(settings_.flag("continueWhenMeasured", true));
  connect(byItself, &QAction::toggled, this, [this](bool on) { settings_.setFlag("continueWhenMeasured", on); });
}

void MainWindow::fillExamples(QMenu& menu) {
  menu.clear();
  for (const QString& path : exampleExperiments())
    menu.addAction(QFileInfo(path).completeBaseName(), this, [this, path] { openExperiment(path); });
  if (menu.isEmpty()) menu.addAction(tr("No examples are installed"))->setEnabled(false);
}

void MainWindow::about() {
  QMessageBox box(this);
  box.setWindowTitle(tr("About UCHILSIM"));
  box.setIconPixmap(themeIcon("help-about").pixmap(48, 48));
  box.setText(
      tr("<h3>UCHILSIM %1</h3><p>A workbench for Back to Reality: learn in simulation, measure in reality, adapt the "
         "simulator, and learn on.</p>")
          .arg(QString::fromStdString(programVersion())));
  box.setInformativeText(
      tr("<p>Free software under the GNU General Public License, version 3 or later; it comes without any "
         "warranty.</p><p>Qt %1 (Widgets, Charts), OpenSceneGraph, Open Dynamics Engine, SQLite.</p>")
          .arg(QString::fromLatin1(qVersion())));
  box.exec();
}

}  // namespace btr::ui
