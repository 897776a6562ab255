// Menus and tool bar of the main window.
#include "ui/window/window_menus.h"

#include <QAction>
#include <QActionGroup>
#include <QApplication>
#include <QDir>
#include <QDockWidget>
#include <QFileDialog>
#include <QFileInfo>
#include <QMainWindow>
#include <QMenuBar>
#include <QMessageBox>
#include <QScrollArea>
#include <QToolBar>

#include "ui/charts/fitness_chart.h"
#include "ui/charts/gap_chart.h"
#include "ui/charts/plot_widget.h"
#include "ui/cluster/machines_dialog.h"
#include "ui/common/look/theme.h"
#include "ui/common/manual.h"
#include "ui/common/numbers/format.h"
#include "ui/common/plugins_dialog.h"
#include "ui/common/resources.h"
#include "ui/controllers/draft_controller.h"
#include "ui/controllers/machines_controller.h"
#include "ui/controllers/replay_controller.h"
#include "ui/controllers/run_controller.h"
#include "ui/live/live_page.h"
#include "ui/remote/interface_dialog.h"
#include "ui/remote/interface_server.h"
#include "ui/window/dock_layout.h"
#include "ui/window/shortcuts_dialog.h"
#include "ui/window/window_pages.h"

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

class Menus final : public QObject {
  Q_DECLARE_TR_FUNCTIONS(Menus)
 public:
  Menus(const MenuTargets& targets, const MenuPlaces& places)
      : QObject(&targets.window), to_(targets), places_(places), bench_(targets.bench) {
    makeFile();
    makeEditMenu(to_.window);
    makeRun();
    makeView();
    makeHelp();
    makeTools();
  }

 private:
  QAction* add(QMenu* menu, const char* name, const QString& icon, const QString& text, const QKeySequence& keys,
               std::function<void()> slot) {
    QAction* action = menu->addAction(themeIcon(icon), text);
    action->setObjectName(name);
    action->setShortcut(keys);
    connect(action, &QAction::triggered, this, [slot = std::move(slot)] { slot(); });
    return action;
  }

  void makeFile();
  void fillExamples(QMenu& menu);
  void fillRecent();
  void makeExports(QMenu& file);
  void openDatabase();
  void newDatabase();
  void makeRun();
  void openInterface();
  void openMachines();
  void addDock(QDockWidget* dock);
  void makeView();
  void makeLooks();
  void addPage(const char* name, const QString& page, const QString& icon, const QString& text,
               const QKeySequence& keys, const QString& toolTip);
  void makeHelp();
  void makeTools();
  void about();

  MenuTargets to_;
  MenuPlaces places_;
  Workbench& bench_;
  InterfaceServer* interface_ = nullptr;
  MachinesController* machines_ = nullptr;
  QMenu *recent_ = nullptr, *view_ = nullptr;
  QList<QAction*> files_, pages_;  ///< of the tool bar
};

void Menus::makeFile() {
  QMenu* file = to_.window.menuBar()->addMenu(tr("&File"));
  file->setObjectName("menu.file");
  files_ << add(file, "newExperiment", "document-new", tr("&New experiment"), QKeySequence::New,
                [this] { to_.drafts.begin(); });
  QMenu* examples = file->addMenu(themeIcon("folder-templates"), tr("New from e&xample"));
  examples->setObjectName("menu.examples");
  connect(examples, &QMenu::aboutToShow, this, [this, examples] { fillExamples(*examples); });
  files_ << add(file, "openExperiment", "document-open", tr("&Open experiment…"), QKeySequence::Open,
                [this] { to_.drafts.openWithDialog(); });
  // Ctrl+S is of the page that has the focus: the measurement sheet, or the form of a new experiment.
  files_ << add(file, "saveExperiment", "document-save-as", tr("&Save experiment as…"), QKeySequence("Ctrl+Shift+S"),
                [this] { to_.drafts.save(); });
  file->addSeparator();
  files_ << add(file, "openDatabase", "folder-open", tr("Open &database…"), QKeySequence("Ctrl+Shift+O"),
                [this] { openDatabase(); });
  add(file, "newDatabase", "folder-new", tr("New da&tabase…"), {}, [this] { newDatabase(); });
  recent_ = file->addMenu(themeIcon("document-open-recent"), tr("&Recent databases"));
  connect(&bench_, &Workbench::databaseOpened, this, &Menus::fillRecent);
  fillRecent();
  add(file, "mergeDatabase", "document-import", tr("Add runs of another data&base…"), {},
      [this] { to_.runs.mergeWithDialog(); });
  add(file, "backUpDatabase", "document-save", tr("Back &up the database…"), {},
      [this] { to_.runs.backUpWithDialog(); });
  file->addSeparator();
  add(file, "replaySession", "media-playback-start", tr("Replay a sess&ion…"), {}, [this] {
    to_.layout.showPage("live");
    to_.pages.livePage->replayWithDialog();
  });
  file->addSeparator();
  makeExports(*file);
  file->addSeparator();
  add(file, "quit", "application-exit", tr("&Quit"), QKeySequence::Quit, [this] { to_.window.close(); });
}

void Menus::makeExports(QMenu& file) {
  QMenu* exports = file.addMenu(themeIcon("document-export"), tr("&Export"));
  for (const auto& [what, label] :
       {std::pair{"generations", tr("Generations as CSV…")}, std::pair{"individuals", tr("Individuals as CSV…")},
        std::pair{"gaps", tr("Reality gaps as CSV…")}, std::pair{"simulators", tr("Simulator versions as CSV…")},
        std::pair{"policies", tr("Policies of L2 as CSV…")}, std::pair{"steps", tr("Steps of L2 as CSV…")}})
    exports->addAction(label, this, [this, name = QString(what)] { to_.runs.exportTable(bench_.run().id, name); });
  exports->addSeparator();
  exports->addAction(tr("Fitness chart…"), this, [this] { to_.pages.fitness->plot().exportWithDialog(); });
  exports->addAction(tr("Reality gap chart…"), this, [this] { to_.pages.gap->plot().exportWithDialog(); });
  connect(exports, &QMenu::aboutToShow, this, [this, exports] {
    for (QAction* action : exports->actions()) action->setEnabled(bench_.run().id != 0);
  });
}

void Menus::fillExamples(QMenu& menu) {
  menu.clear();
  for (const QString& path : exampleExperiments())
    menu.addAction(inMenu(tr("%1 (%2)").arg(exampleName(path), QFileInfo(path).completeBaseName())), this,
                   [this, path] { to_.drafts.open(path); });
  if (menu.isEmpty()) menu.addAction(tr("No examples are installed"))->setEnabled(false);
}

void Menus::fillRecent() {
  recent_->clear();
  for (const QString& path : bench_.settings().recentDatabases())
    recent_->addAction(inMenu(path), this, [this, path] { bench_.open(path, Workbench::Absent::ask); });
  recent_->setEnabled(!recent_->isEmpty());
}

void Menus::openDatabase() {
  const QString path = QFileDialog::getOpenFileName(&to_.window, tr("Open a database"), bench_.path(),
                                                    tr("Experiment databases (*.db);;All files (*)"));
  if (!path.isEmpty()) bench_.open(path, Workbench::Absent::ask);
}

void Menus::newDatabase() {
  const QDir folder = QFileInfo(bench_.path()).absoluteDir();
  QString free = folder.filePath("experiments.db");
  for (int n = 2; QFileInfo::exists(free); ++n) free = folder.filePath(QStringLiteral("experiments-%1.db").arg(n));
  QString path =
      QFileDialog::getSaveFileName(&to_.window, tr("Make a database"), free, tr("Experiment databases (*.db)"), nullptr,
                                   QFileDialog::DontConfirmOverwrite);
  if (path.isEmpty()) return;
  if (QFileInfo(path).suffix().isEmpty()) path += ".db";
  if (QFileInfo::exists(path))
    bench_.inform(tr("%1 was there already; it is opened as it is.").arg(QDir::toNativeSeparators(path)));
  bench_.open(path, Workbench::Absent::make);
}

// Shortcuts work while the menu is closed too, so the entries always exist and say themselves when they do not fit.
void Menus::makeRun() {
  QMenu* menu = to_.window.menuBar()->addMenu(tr("&Run"));
  menu->setObjectName("menu.run");
  add(menu, "startDraft", "run-build", tr("Start the &new experiment"), Qt::Key_F5, [this] { to_.drafts.start(); });
  menu->addSeparator();
  QAction* go = add(menu, "continueRun", "media-playback-start", tr("&Continue the selected run"), Qt::Key_F6,
                    [this] { to_.runs.resume(bench_.run().id); });
  add(menu, "stopRun", "media-playback-stop", tr("&Stop the selected run"), QKeySequence("Shift+F6"),
      [this] { to_.runs.stop(bench_.run().id); });
  menu->addSeparator();
  QAction* copy = add(menu, "duplicateRun", "edit-copy", tr("&Duplicate with another seed…"), {},
                      [this] { to_.runs.duplicate(bench_.run().id); });
  add(menu, "replayBest", "media-playback-playing", tr("&Replay the best of the last generation"), Qt::Key_F7,
      [this] { to_.replays.replayBest(); });
  QAction* byItself = menu->addAction(tr("Go on by itself when all is &measured"));
  byItself->setCheckable(true);
  byItself->setChecked(bench_.settings().flag("continueWhenMeasured", true));
  connect(byItself, &QAction::toggled, this,
          [this](bool on) { bench_.settings().setFlag("continueWhenMeasured", on); });
  menu->addSeparator();
  add(menu, "openMachines", "network-workgroup", tr("On se&veral machines…"), {}, [this] { openMachines(); });
  add(menu, "openInterface", "network-server", tr("&Open interface…"), {}, [this] { openInterface(); });
  connect(menu, &QMenu::aboutToShow, this, [this, go, copy] {
    const Id run = bench_.run().id;
    go->setEnabled(run != 0 && bench_.watcher().activeRuns().count(run) == 0);
    copy->setEnabled(run != 0);
  });
  connect(menu, &QMenu::aboutToHide, this, [go, copy] {
    for (QAction* action : {go, copy}) action->setEnabled(true);
  });
}

// Off until it is asked for; then it stays on while the window is open, whether its dialog is or not.
void Menus::openInterface() {
  if (!interface_) interface_ = new InterfaceServer({}, this);
  auto* dialog = new InterfaceDialog(
      *interface_, [this] { return bench_.path(); }, &to_.window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->open();
}

// The job goes on, and is still the one that is looked at, when the dialog is opened again.
void Menus::openMachines() {
  if (!machines_) {
    machines_ = new MachinesController(bench_.launcher().program(), this);
    connect(machines_, &MachinesController::collected, &bench_, [this] { bench_.watcher().poll(); });
  }
  if (auto* there = to_.window.findChild<MachinesDialog*>()) {
    there->raise();
    return there->activateWindow();
  }
  auto* dialog = new MachinesDialog(
      *machines_, [this] { return bench_.path(); }, &to_.window);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->show();
}

// Ticked is what can be seen. What is behind a tab or a page comes to the front with the keys, and only what is in
// front goes away.
void Menus::addDock(QDockWidget* dock) {
  QAction* see = view_->addAction(dock->windowIcon(), dock->windowTitle());
  const QString name = dock->objectName().mid(5);
  see->setObjectName("see." + name);
  see->setCheckable(true);
  connect(view_, &QMenu::aboutToShow, see, [see, dock] { see->setChecked(DockLayout::isInFront(dock)); });
  connect(see, &QAction::triggered, this, [this, dock, name] {
    if (DockLayout::isInFront(dock)) return void(dock->close());
    emit bench_.dockWanted(name);
    if (auto* page = qobject_cast<QScrollArea*>(dock->widget())) page->widget()->setFocus();
  });
}

void Menus::makeView() {
  view_ = to_.window.menuBar()->addMenu(tr("&View"));
  view_->setObjectName("menu.view");
  for (QDockWidget* dock : to_.window.findChildren<QDockWidget*>(QString(), Qt::FindDirectChildrenOnly))
    if (!to_.layout.isPage(dock)) addDock(dock);
  view_->addSeparator();
  makeLooks();
  addPage("showStartPage", "start", "go-home", tr("&Start page"), QKeySequence("Alt+Home"),
          tr("Three doors: look at an experiment, set one up, analyse recordings (Alt+Home)"));
  addPage("showGapPage", "analysis", "office-chart-area", tr("&Gap analysis"), Qt::Key_F8,
          tr("Recordings against simulation: what physics is missing (F8)"));
  addPage("showGridPage", "grid", "view-grid", tr("The &whole kick"), Qt::Key_F9,
          tr("Grids of experiments: cells, and the kicks between them (F9)"));
  addPage("showLivePage", "live", "applications-games", tr("Sce&ne"), Qt::Key_F10,
          tr("A world that runs: place, push, tune (F10)"));
  add(view_, "resetLayout", "view-restore", tr("&Reset layout"), {}, places_.resetLayout);
  QAction* full = add(view_, "fullScreen", "view-fullscreen", tr("&Full screen"), QKeySequence::FullScreen,
                      [this] { to_.window.setWindowState(to_.window.windowState() ^ Qt::WindowFullScreen); });
  full->setShortcuts({QKeySequence(Qt::Key_F11)});
}

void Menus::addPage(const char* name, const QString& page, const QString& icon, const QString& text,
                    const QKeySequence& keys, const QString& toolTip) {
  QAction* action = add(view_, name, icon, text, keys, [] {});
  action->setCheckable(true);
  action->setToolTip(toolTip);
  connect(action, &QAction::triggered, this, [this, page](bool on) { to_.layout.showPage(on ? page : QString()); });
  connect(&to_.layout, &DockLayout::pageChanged, action,
          [action, page](const QString& shown) { action->setChecked(shown == page); });
  pages_ << action;
}

void Menus::makeLooks() {
  QMenu* looks = view_->addMenu(themeIcon("color-management"), tr("&Look"));
  auto* group = new QActionGroup(this);
  for (const auto& [look, label] : {std::pair{Look::system, tr("As the &system")}, std::pair{Look::light, tr("&Light")},
                                    std::pair{Look::dark, tr("&Dark")}}) {
    QAction* action = looks->addAction(label);
    action->setObjectName("look." + nameOf(look));
    action->setCheckable(true);
    action->setChecked(bench_.settings().look() == look);
    group->addAction(action);
    connect(action, &QAction::triggered, this, [this, chosen = look] {
      bench_.settings().setLook(chosen);
      to_.theme.apply(chosen);
    });
  }
}

void Menus::makeHelp() {
  QMenu* help = to_.window.menuBar()->addMenu(tr("&Help"));
  help->setObjectName("menu.help");
  help->addAction(pages_.first());
  add(help, "help.manual", "help-contents", tr("&Manual"), Qt::Key_F1, [this] {
    if (const QString problem = Manual().open(Manual::pageFor(QApplication::focusWidget())); !problem.isEmpty())
      bench_.report(problem);
  });
  add(help, "help.plugins", "preferences-plugin", tr("&Plugins…"), {},
      [this] { PluginsDialog(*bench_.host(), &to_.window).exec(); });
  add(help, "shortcuts", "configure-shortcuts", tr("Keyboard &shortcuts"), {}, [this] {
    auto* dialog = new ShortcutsDialog(to_.window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
  });
  add(help, "help.about", "help-about", tr("&About UCHILSIM"), {}, [this] { about(); });
}

void Menus::makeTools() {
  for (QAction* action : files_)
    if (action->objectName() == "saveExperiment" || action->objectName() == "openDatabase")
      action->setPriority(QAction::LowPriority);
  auto* bar = new ToolBar(tr("Tools"), &to_.window);
  bar->setObjectName("toolbar.main");
  bar->setMovable(false);
  bar->setIconSize({18, 18});
  bar->addActions(files_);
  bar->addSeparator();
  bar->addActions(pages_.mid(1));
  to_.window.insertToolBar(places_.messages, bar);
  to_.window.insertToolBarBreak(places_.messages);
  bar->addSeparator();
  bar->addWidget(places_.alarm);
}

void Menus::about() {
  QMessageBox box(&to_.window);
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

}  // namespace

void makeWindowMenus(const MenuTargets& targets, const MenuPlaces& places) { new Menus(targets, places); }

}  // namespace btr::ui
