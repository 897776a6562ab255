// Coming in: the start page, files given to the window, names that are mistyped, and what is not saved yet.
#include <QAction>
#include <QApplication>
#include <QDir>
#include <QDockWidget>
#include <QDropEvent>
#include <QFile>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QSignalSpy>
#include <QTableWidget>
#include <QTest>
#include <QTimer>
#include <cmath>

#include "tests/ui/stored_run.h"
#include "tests/ui/ui_tests.h"
#include "ui/common/file_choice.h"
#include "ui/common/look/message_banner.h"
#include "ui/controllers/draft_controller.h"
#include "ui/controllers/run_controller.h"
#include "ui/experiment/experiment_form.h"
#include "ui/gap/analysis_setup.h"
#include "ui/gap/gap_page.h"
#include "ui/main_window.h"
#include "ui/window/shortcuts_dialog.h"
#include "ui/window/start_page.h"

using namespace btr;
using namespace btr::ui;

namespace {

struct Desk {
  Desk() : theme(*qApp) {
    options.settingsFile = folder.filePath("settings.ini");
    options.program = "/bin/true";
    options.isActive = [](const std::string&, Id) { return false; };
  }
  std::unique_ptr<MainWindow> open(const QString& database) {
    auto window = std::make_unique<MainWindow>(host, theme, options);
    window->show();
    window->openDatabase(database);
    window->bench().reader().waitUntilIdle();
    return window;
  }
  QString file(const QString& name, const QByteArray& content) const {
    QFile file(folder.filePath(name));
    if (!file.open(QIODevice::WriteOnly)) qFatal("cannot write");
    file.write(content);
    return file.fileName();
  }
  QTemporaryDir folder;
  std::shared_ptr<const PluginHost> host = std::make_shared<const PluginHost>(PLUGIN_DIR);
  Theme theme;
  WindowOptions options;
};

/// Presses a button of the question that comes next; its name is kept.
void answer(const char* question, const char* button, int& asked) {
  QTimer::singleShot(0, qApp, [=, &asked] {
    QWidget* box = QApplication::activeModalWidget();
    QVERIFY(box);
    QCOMPARE(box->objectName(), QString(question));
    ++asked;
    auto* wanted = box->findChild<QPushButton*>(button);
    QVERIFY(wanted);
    QTest::mouseClick(wanted, Qt::LeftButton);
  });
}

QAction* action(MainWindow& window, const char* name) {
  auto* found = window.findChild<QAction*>(name);
  if (!found) qFatal("no action %s", name);
  return found;
}

void drop(MainWindow& window, const QStringList& files) {
  QMimeData data;
  QList<QUrl> urls;
  for (const QString& file : files) urls << QUrl::fromLocalFile(file);
  data.setUrls(urls);
  QDragEnterEvent enter(QPoint(10, 10), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window, &enter);
  QDropEvent event(QPointF(10, 10), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
  QApplication::sendEvent(&window, &event);
}

void typeName(MainWindow& window, const QString& name) {
  auto* field = window.draft().findChild<QLineEdit*>("name");
  field->setFocus();
  field->selectAll();
  QTest::keyClicks(field, name);
}

void emptyName(MainWindow& window) {
  auto* field = window.draft().findChild<QLineEdit*>("name");
  field->selectAll();
  QTest::keyClick(field, Qt::Key_Delete);
}

}  // namespace

class TestWindowEntry : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { qputenv("UCHILSIM_RESOURCES", SOURCE_DIR "/resources"); }

  void aMistypedDatabaseIsNotMadeInSilence() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    const QString typo = desk.folder.filePath("expermients.db");
    int asked = 0;
    answer("makeDatabase", "cancel", asked);
    QVERIFY(!window->openDatabase(typo));
    QCOMPARE(asked, 1);
    QVERIFY(!QFile::exists(typo));
    QCOMPARE(window->bench().path(), stored.qpath());
    answer("makeDatabase", "make", asked);
    QVERIFY(window->openDatabase(typo));
    QVERIFY(QFile::exists(typo));
  }

  void aReadOnlyDatabaseIsMarked() {
    StoredRun stored;
    stored.addRun(stored.addExperiment());
    Desk desk;
    desk.options.isWritable = [](const QString&) { return false; };
    const auto window = desk.open(stored.qpath());
    QVERIFY(window->windowTitle().startsWith("test.db (read only)"));
    QVERIFY(window->findChild<QLabel*>("database")->text().contains("read only"));
    QVERIFY(window->banner().text().contains("may only be read"));
  }

  void aFilledFormIsNotReplacedWithoutAQuestion() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    typeName(*window, "Mine");
    int asked = 0;
    answer("replaceDraft", "cancel", asked);
    action(*window, "newExperiment")->trigger();
    QCOMPARE(asked, 1);
    QCOMPARE(window->draft().spec().name, std::string("Mine"));
    QVERIFY(window->draft().undoStack().canUndo());
    answer("replaceDraft", "cancel", asked);
    QVERIFY(!window->drafts().open(SOURCE_DIR "/resources/experiments/walk.json"));
    QCOMPARE(asked, 2);
    answer("replaceDraft", "replace", asked);
    action(*window, "newExperiment")->trigger();
    QCOMPARE(asked, 3);
    QCOMPARE(window->draft().spec().name, std::string("Experiment"));
    // Nothing to lose: no question.
    action(*window, "newExperiment")->trigger();
    QCOMPARE(asked, 3);
  }

  void anUnsavedDraftIsStillUnsavedAfterARestart() {
    StoredRun stored;
    Desk desk;
    {
      const auto window = desk.open(stored.qpath());
      typeName(*window, "Mine");
      QVERIFY(window->close());
    }
    const auto window = desk.open(stored.qpath());
    QVERIFY(window->drafts().isUnsaved());
    int asked = 0;
    answer("replaceDraft", "cancel", asked);
    action(*window, "newExperiment")->trigger();
    QCOMPARE(asked, 1);
  }

  void theKeyboardBeginsInTheNewForm() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    window->activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(window.get()));
    action(*window, "newExperiment")->trigger();
    QCOMPARE(window->focusWidget(), window->draft().findChild<QLineEdit*>("name"));
  }

  void droppedFilesGoWhereTheirContentBelongs() {
    StoredRun stored, other;
    Desk desk;
    desk.options.program = BTR_PROGRAM;
    const auto window = desk.open(stored.qpath());
    drop(*window, {SOURCE_DIR "/resources/experiments/walk.json"});
    QCOMPARE(window->draft().spec().controller.name, std::string("walk"));
    drop(*window, {SOURCE_DIR "/resources/scenes/kick_fine.json"});
    QVERIFY(QString::fromStdString(window->draft().spec().scene).endsWith("kick_fine.json"));
    drop(*window, {other.qpath()});
    QCOMPARE(window->bench().path(), other.qpath());
    const QString table = desk.file("swing.csv", "time_s,leg.knee.position_rad\n0,0.1\n0.01,0.2\n");
    drop(*window, {table});
    QCOMPARE(window->gapPage().setup().recordings().rowCount(), 1);
    drop(*window, {SOURCE_DIR "/resources/scenes/emps.json"});
    QVERIFY(window->gapPage().setup().scene().endsWith("emps.json"));
    const QString text = desk.file("letter.txt", "Dear all,\nnothing.\n");
    drop(*window, {text});
    QVERIFY2(window->banner().text().contains("letter.txt is a text file"), qPrintable(window->banner().text()));
    QSignalSpy checked(&window->bench().launcher(), &RunLauncher::modelChecked);
    drop(*window, {SOURCE_DIR "/resources/robots/emps.urdf"});
    QTRY_COMPARE(checked.count(), 1);
    QVERIFY(window->findChild<QMessageBox*>("robotModel")->text().contains("robot model"));
  }

  void aWrongFileIsCalledWhatItIs() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    QVERIFY(!window->drafts().open(desk.file("letter.txt", "Dear all,\nnothing.\n")));
    QVERIFY2(window->banner().text().contains("is a text file; expected: an experiment"),
             qPrintable(window->banner().text()));
    ExperimentSpec spec = StoredRun::spec();
    spec.directory = SOURCE_DIR "/resources/experiments";
    spec.scene = "../robots/ers7.wrl";
    window->draft().setSpec(spec);
    QVERIFY2(window->draft().problems().join('\n').contains("is a robot model (VRML97); expected: a scene"),
             qPrintable(window->draft().problems().join('\n')));
  }

  void fewerGenerationsThanTheFirstStageAreFlagged() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    ExperimentSpec spec = StoredRun::spec();
    spec.directory = SOURCE_DIR "/resources/experiments";
    spec.stages["first_generations"] = 50;
    spec.stages["total_generations"] = 20;
    window->draft().setSpec(spec);
    QCOMPARE(window->draft().problems(), QStringList("Total generations: at least the 50 first generations"));
  }

  void theChooserOfScenesListsScenesOnly() {
    const auto dialog = fileDialog(nullptr, "Scenes", SOURCE_DIR "/resources/scenes", FileKind::scene);
    dialog->show();
    const auto* view = dialog->findChild<QListView*>("listView");
    const QDir folder(SOURCE_DIR "/resources/scenes");
    QStringList scenes;
    for (const QString& name : folder.entryList({"*.json"}, QDir::Files, QDir::Name)) {
      QFile file(folder.filePath(name));
      QVERIFY(file.open(QIODevice::ReadOnly));
      if (file.readAll().contains("\"uchilsim-scene-1\"")) scenes << name;
    }
    QVERIFY(scenes.size() > 5 && scenes.size() < folder.entryList({"*.json"}, QDir::Files).size());
    const auto listed = [view] {
      QStringList names;
      for (int row = 0; row < view->model()->rowCount(view->rootIndex()); ++row)
        names << view->model()->index(row, 0, view->rootIndex()).data().toString();
      names.sort();
      return names;
    };
    QTRY_COMPARE(listed(), scenes);
  }

  void continuingARunThatWaitsSaysWhatItWaitsFor() {
    StoredRun stored;
    const Id run = stored.addWaitingRun(stored.addExperiment());
    stored.measure(run, stored.database.measurementTasks(run).front().individual, 0.5);
    Desk desk;
    const auto window = desk.open(stored.qpath());
    window->runs().resume(run);
    window->bench().reader().waitUntilIdle();
    QVERIFY2(window->banner().text().contains("1 of 2 are measured"), qPrintable(window->banner().text()));
    QVERIFY(DockLayout::isInFront(window->findChild<QDockWidget*>("dock.sheet")));
  }

  void whatARobotThatFailedSaidIsShown() {
    StoredRun stored;
    const Id run = stored.addWaitingRun(stored.addExperiment());
    const char* said = "individual 2, measured by program: -1 m is not possible: this fitness is never negative";
    stored.database.setRunState(run, RunState::waiting, said);
    Desk desk;
    desk.options.program = desk.file("btr", QByteArray("#!/bin/sh\necho 'btr: ") + said + "' >&2\nexit 1\n");
    QVERIFY(QFile::setPermissions(desk.options.program, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner));
    const auto window = desk.open(stored.qpath());
    window->runs().resume(run);
    QTRY_VERIFY2(window->banner().text().endsWith(said), qPrintable(window->banner().text()));
  }

  void theStartPageOpensWhenNothingWaits() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment());
    Desk desk;
    {
      const auto window = desk.open(stored.qpath());
      window->showStartIfIdle();
      QVERIFY(!window->findChild<StartPage*>()->isVisible());
    }
    stored.database.setRunState(run, RunState::finished, "");
    const auto window = desk.open(stored.qpath());
    auto* start = window->findChild<StartPage*>();
    window->showStartIfIdle();
    QVERIFY(start->isVisible());
    // The first door leads to the finished run.
    QTest::mouseClick(start->findChild<QPushButton*>(QString("run%1").arg(run)), Qt::LeftButton);
    QVERIFY(!start->isVisible());
    QCOMPARE(window->bench().run().id, run);
    action(*window, "showStartPage")->trigger();
    QTest::mouseClick(start->findChild<QPushButton*>("newExperiment"), Qt::LeftButton);
    QVERIFY(DockLayout::isInFront(window->findChild<QDockWidget*>("dock.draft")));
    action(*window, "showStartPage")->trigger();
    QTest::mouseClick(start->findChild<QPushButton*>("analyse"), Qt::LeftButton);
    QVERIFY(window->gapPage().isVisible());
    QVERIFY(!start->isVisible());
    // Once turned off it stays away.
    action(*window, "showStartPage")->trigger();
    start->findChild<QAbstractButton*>("atStart")->click();
    window->showPage({});
    window->showStartIfIdle();
    QVERIFY(!start->isVisible());
  }

  void aNameIsShownAsItWasTypedAndNotAsHtml() {
    ExperimentRecord experiment;
    experiment.id = 1;
    experiment.name = "Kick with a <small> ball & socks";
    RunRecord run;
    run.id = 1;
    run.experiment = 1;
    run.state = RunState::finished;
    StartPage page;
    page.setRuns({experiment}, {run});
    const QString name = QString::fromStdString(experiment.name);
    const auto labels = page.findChildren<QLabel*>();
    const auto shown = std::ranges::find(labels, name, &QLabel::text);
    QVERIFY(shown != labels.end());
    QCOMPARE((*shown)->textFormat(), Qt::PlainText);
    QVERIFY(page.findChild<QPushButton*>("run1")->toolTip().contains("a &lt;small&gt; ball &amp; socks"));
  }

  // Behind a page the layout of before comes back, which knows nothing of that window.
  void comparedRunsHaveAWindowOfTheirOwnFromThePagesToo() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment());
    stored.database.setRunState(run, RunState::finished, "");
    Desk desk;
    const auto window = desk.open(stored.qpath());
    const auto* compare = window->findChild<QDockWidget*>("dock.compare");
    for (const char* page : {"start", "analysis", "grid"}) {
      window->showPage(page);
      window->compareRuns({run});
      QVERIFY2(compare->isVisible() && compare->isFloating(), page);
      QVERIFY2(compare->width() > 2 * window->findChild<QDockWidget*>("dock.spec")->width(), page);
    }
  }

  // The window may have been made light before the user's dark look is known.
  void thePicturesOfTheStartPageAreSeenOnItsWindowWhateverItsLook() {
    Desk desk;
    desk.theme.apply(Look::light);
    StartPage page;
    for (const Look look : {Look::dark, Look::light, Look::dark}) {
      desk.theme.apply(look);
      page.show();
      QCoreApplication::processEvents();
      const auto pictures = page.findChildren<QLabel*>("picture");
      QCOMPARE(pictures.size(), 3);
      for (const QLabel* picture : pictures) {
        const QImage image = picture->pixmap().toImage();
        double lightness = 0, opaque = 0;
        for (int y = 0; y < image.height(); ++y)
          for (int x = 0; x < image.width(); ++x) {
            const QColor colour = image.pixelColor(x, y);
            lightness += colour.alphaF() * colour.lightness();
            opaque += colour.alphaF();
          }
        QVERIFY(opaque > 0);
        const double window = page.palette().color(QPalette::Window).lightness();
        QVERIFY2(std::abs(lightness / opaque - window) > 60, qPrintable(nameOf(look)));
      }
    }
  }

  // An experiment names a folder of plugins: the form knows what lies there, and shows it as any other.
  void theFormKnowsThePluginsThatAnExperimentNames() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    ExperimentSpec spec = StoredRun::spec();
    spec.plugins = {CRASHING_DIR};
    spec.fitness = {"crashing", {}, {{"how", "abort"}}};
    spec.scene = SOURCE_DIR "/resources/scenes/kick.json";
    const QString file = desk.file("crashing.json", QByteArray::fromStdString(toJsonText(spec)));
    QVERIFY2(window->drafts().open(file), qPrintable(window->banner().text()));
    QVERIFY2(window->draft().isValid(), qPrintable(window->draft().problems().join('\n')));
    QCOMPARE(window->draft().spec().fitness.name, std::string("crashing"));
    QCOMPARE(window->draft().spec().fitness.words, spec.fitness.words);
    // And of a stored run.
    const Id experiment = stored.database.addExperiment({0, "Crashing", toJsonText(spec), "", ""});
    RunRecord run;
    run.experiment = experiment;
    run.seed = 1;
    run.specJson = toJsonText(spec);
    run.specSha256 = "c";
    run.sceneJson = R"({"format": "uchilsim-scene-1"})";
    run.reality = "person";
    window->selectRun(stored.database.addRun(run, SimulatorRecord{}));
    window->bench().reader().waitUntilIdle();
    QVERIFY2(window->banner().text().isEmpty(), qPrintable(window->banner().text()));
    QCOMPARE(window->findChild<ExperimentForm*>("spec")->spec().fitness.name, std::string("crashing"));
  }

  void aFolderOfPluginsThatIsNotThereIsSaidAndTheFormStays() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    window->draft().setSpec(StoredRun::spec());
    ExperimentSpec spec = StoredRun::spec();
    spec.name = "Other";
    spec.plugins = {desk.folder.filePath("absent").toStdString()};
    QVERIFY(!window->drafts().open(desk.file("other.json", QByteArray::fromStdString(toJsonText(spec)))));
    QVERIFY2(window->banner().text().contains("absent"), qPrintable(window->banner().text()));
    QCOMPARE(window->draft().spec().name, std::string("Kick"));
  }

  void aMessageGoesWhenItsCauseIsMended() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    // A file that is none, then one that is.
    QVERIFY(!window->drafts().open(desk.file("letter.txt", "Dear all,\nnothing.\n")));
    QVERIFY(!window->banner().text().isEmpty());
    QVERIFY(window->drafts().open(SOURCE_DIR "/resources/experiments/kick-short.json"));
    QCOMPARE(window->banner().text(), QString());
    // A form that cannot be started, until the field is filled.
    emptyName(*window);
    window->drafts().start();
    QVERIFY(!window->banner().text().isEmpty());
    typeName(*window, "Named");
    QCOMPARE(window->banner().text(), QString());
    // Another message stays.
    emptyName(*window);
    window->drafts().start();
    window->bench().report("something else");
    typeName(*window, "Named");
    QCOMPARE(window->banner().text(), QString("something else"));
    // A scene that cannot be read, then one that can.
    AnalysisSetup& setup = window->gapPage().setup();
    setup.setScene(desk.file("scene.json", "{"));
    QVERIFY(window->banner().text().contains("scene.json"));
    setup.setScene(SOURCE_DIR "/resources/scenes/emps.json");
    QCOMPARE(window->banner().text(), QString());
    emit setup.keepRequested({}, {});
    QCOMPARE(window->banner().text(), QString("Add recordings first."));
    setup.addRecordings({desk.file("swing.csv", "time_s,leg.knee.position_rad\n0,0.1\n0.01,0.2\n")});
    QCOMPARE(window->banner().text(), QString());
  }

  void aDatabaseOnANetworkFileSystemIsMarked() {
    StoredRun stored;
    Desk desk;
    desk.options.networkWarning = [](const std::string& path) { return std::optional(path + ": is on NFS"); };
    const auto window = desk.open(stored.qpath());
    QVERIFY2(window->banner().text().contains("test.db: is on NFS"), qPrintable(window->banner().text()));
  }

  // A single & would underline the next letter and be gone.
  void aNameWithAnAmpersandIsShownWhole() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    const QString file = desk.folder.filePath("arms & legs.db");
    QVERIFY(window->openDatabase(file, Workbench::Absent::make));
    QStringList shown;
    for (const QAction* entry : window->findChildren<QAction*>()) shown << entry->text();
    QVERIFY(shown.contains(QString(file).replace("&", "&&")));
    QVERIFY(window->windowTitle().contains("arms & legs.db"));
  }

  void theListOfKeysIsReadFromTheActions() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    const ShortcutsDialog dialog(*window);
    const auto* table = dialog.findChild<QTableWidget*>();
    QMap<QString, QString> keys;
    for (int row = 0; row < table->rowCount(); ++row) keys[table->item(row, 1)->text()] = table->item(row, 2)->text();
    QCOMPARE(keys["Gap analysis"], QString("F8"));
    QCOMPARE(keys["The whole kick"], QString("F9"));
    QCOMPARE(keys["New experiment"], QString("Ctrl+N"));
    QVERIFY(keys.contains("Rename, or edit note…"));  // of a page
  }
};

UI_TEST(TestWindowEntry)
#include "test_window_entry.moc"
