// The whole window on a stored run: opens it, shows its numbers, starts and stops a process, asks before it closes.
#include <sys/stat.h>

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QDockWidget>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QScreen>
#include <QSignalSpy>
#include <QStatusBar>
#include <QTableWidget>
#include <QTest>
#include <QTimer>
#include <QTreeView>
#include <algorithm>

#include "core/run/reality/adoption.h"
#include "core/run/setup/prepared_experiment.h"
#include "tests/gap/report/rig_report.h"
#include "tests/plugin/built_plugins.h"
#include "tests/ui/locked_database.h"
#include "tests/ui/stored_run.h"
#include "tests/ui/ui_tests.h"
#include "ui/charts/compare_page.h"
#include "ui/charts/fitness_chart.h"
#include "ui/charts/gap_chart.h"
#include "ui/charts/plot_widget.h"
#include "ui/common/look/message_banner.h"
#include "ui/controllers/draft_controller.h"
#include "ui/controllers/grid_controller.h"
#include "ui/controllers/run_controller.h"
#include "ui/database/individuals_table.h"
#include "ui/experiment/experiment_form.h"
#include "ui/experiment/experiment_tree.h"
#include "ui/experiment/learner_form.h"
#include "ui/experiment/parameter_field.h"
#include "ui/experiment/parameter_form.h"
#include "ui/experiment/run_panel.h"
#include "ui/experiment/simulators_page.h"
#include "ui/gap/analysis_setup.h"
#include "ui/gap/clues_view.h"
#include "ui/gap/gap_page.h"
#include "ui/main_window.h"
#include "ui/measure/alarm.h"
#include "ui/measure/measurement_sheet.h"
#include "ui/measure/measurement_view.h"
#include "ui/measure/question_bar.h"
#include "ui/scene3d/replay_panel.h"

using namespace btr;
using namespace btr::ui;

namespace {

// Stands in for btr: says what it was called with, then works until somebody writes into its pipe.
class FakeProgram {
 public:
  explicit FakeProgram(const QDir& folder, const QByteArray& ending = "") {
    program = folder.filePath("btr");
    arguments = folder.filePath("arguments");
    pipe = folder.filePath("pipe");
    ::mkfifo(qPrintable(pipe), 0600);
    QFile script(program);
    if (!script.open(QIODevice::WriteOnly)) return;
    script.write("#!/bin/sh\necho \"$@\" > " + arguments.toUtf8() + ".part\nmv " + arguments.toUtf8() + ".part " +
                 arguments.toUtf8() + "\ncat " + pipe.toUtf8() + " > /dev/null\n" + ending);
    script.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
  }
  QString said() const {
    QFile file(arguments);
    return file.open(QIODevice::ReadOnly) ? QString::fromUtf8(file.readAll()).trimmed() : QString();
  }
  void end() const {
    QFile file(pipe);
    if (file.open(QIODevice::WriteOnly | QIODevice::Unbuffered)) file.write("end\n");
  }
  QString program, arguments, pipe;
};

struct Desk {
  explicit Desk(const QString& program = "/bin/true") : theme(*qApp) {
    options.settingsFile = folder.filePath("settings.ini");
    options.program = program;
    options.isActive = [this](const std::string&, Id run) { return active.count(run) > 0; };
  }
  std::unique_ptr<MainWindow> open(const QString& database) {
    auto window = std::make_unique<MainWindow>(host, theme, options);
    window->show();
    window->openDatabase(database, Workbench::Absent::make);
    window->bench().reader().waitUntilIdle();
    return window;
  }
  QTemporaryDir folder;
  std::shared_ptr<const PluginHost> host = std::make_shared<const PluginHost>(PLUGIN_DIR);
  Theme theme;
  std::set<Id> active;
  WindowOptions options;
};

/// With the real program, whose runs are those that work.
struct RealDesk : Desk {
  RealDesk() : Desk(BTR_PROGRAM) { options.isActive = isRunActive; }
};

/// Until everything that was asked of the database is answered.
void settle(MainWindow& window) { window.bench().reader().waitUntilIdle(); }

void show(MainWindow& window, Id run) {
  window.selectRun(run);
  settle(window);
}

void startDraft(MainWindow& window) {
  QVERIFY2(window.draft().isValid(), qPrintable(window.draft().problems().join('\n')));
  QTest::mouseClick(window.draft().findChild<QPushButton*>("start"), Qt::LeftButton);
}

QString message(MainWindow& window) { return window.banner().text(); }

// A stored run with two stages: measured, adapted, learned on.
Id fullRun(StoredRun& stored, const std::string& reality = "person") {
  const Id run = stored.addRun(stored.addExperiment(), 5, reality);
  stored.addGenerations(run, 3);
  for (const auto& task : stored.addTasks(run)) stored.measure(run, task.individual, 0.25);
  stored.finishStage(run, {{"friction", 0.5}});
  stored.addGenerations(run, 3);
  return run;
}

void answerClosing(const char* button) {
  QTimer::singleShot(0, qApp, [button] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    QVERIFY(box);
    QTest::mouseClick(box->findChild<QPushButton*>(button), Qt::LeftButton);
  });
}

}  // namespace

class TestMainWindow : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { qputenv("UCHILSIM_RESOURCES", SOURCE_DIR "/resources"); }

  void showsTheNumbersOfTheStoredRecords() {
    StoredRun stored;
    const Id run = fullRun(stored);
    Desk desk;
    const auto window = desk.open(stored.qpath());
    QCOMPARE(message(*window), QString());
    QVERIFY(window->windowTitle().startsWith("test.db"));
    QCOMPARE(window->findChild<ExperimentTree*>()->selectedRun(), run);

    const auto records = stored.database.generations(run);
    const FitnessRun& shown = window->findChild<FitnessChart*>()->run();
    QCOMPARE(shown.generations.size(), records.size());
    for (std::size_t i = 0; i < records.size(); ++i) {
      QCOMPARE(shown.generations[i].best, records[i].best);
      QCOMPARE(shown.generations[i].mean, records[i].mean);
    }
    QCOMPARE(shown.simulators.size(), 2u);
    QCOMPARE(shown.measurements.size(), 2u);

    auto* table = window->findChild<IndividualsTable*>();
    QTRY_COMPARE(table->model().rowCount(), 12);
    const auto individuals = stored.database.individuals(run, 4);
    QVERIFY(table->select(individuals.front().id));
    QCOMPARE(table->selected(), individuals.front().id);
    QCOMPARE(window->findChild<ExperimentForm*>("spec")->spec().name, std::string("Kick"));
    // The specification says 1; the run was made with 5.
    QCOMPARE(window->findChild<ExperimentForm*>("spec")->spec().seed, std::uint64_t(5));
  }

  void whatTheReplaysCameraFollowsIsRemembered() {
    Desk desk;
    const auto after = [&](const QList<Qt::Key>& keys) {
      auto window = desk.open(desk.folder.filePath("a.db"));
      SceneView& view = window->findChild<ReplayPanel*>()->view();
      for (const Qt::Key key : keys) QTest::keyClick(&view, key);
      return view.follow();
    };
    QCOMPARE(after({}), SceneView::Follow::nothing);
    QCOMPARE(after({Qt::Key_F, Qt::Key_F}), SceneView::Follow::ball);
    QCOMPARE(after({}), SceneView::Follow::ball);
    QCOMPARE(after({Qt::Key_H}), SceneView::Follow::nothing);
    QCOMPARE(after({}), SceneView::Follow::nothing);
  }

  void followsGenerationsThatAnotherProcessStores() {
    StoredRun stored;
    const Id run = fullRun(stored);
    Desk desk;
    const auto window = desk.open(stored.qpath());
    auto* table = window->findChild<IndividualsTable*>();
    QTRY_COMPARE(table->model().rowCount(), 12);
    stored.addGenerations(run, 1);
    QTRY_COMPARE(window->findChild<FitnessChart*>()->run().generations.size(), 7u);
    QTRY_COMPARE(table->model().rowCount(), 14);
  }

  // Another process keeps the file to itself: what is shown stays, the window goes on, and what was asked for comes
  // when it can be read.
  void theWindowGoesOnWhileTheDatabaseIsLocked() {
    LockedDatabase stored;
    Desk desk;
    desk.options.isWritable = [](const QString&) { return false; };
    const auto window = desk.open(stored.qpath());
    const FitnessChart* chart = window->findChild<FitnessChart*>();
    QCOMPARE(chart->run().run, stored.secondRun());
    stored.lock();
    // Everything that reads: another run, runs to compare, grids, the individuals of a table.
    window->selectRun(stored.firstRun());
    window->compareRuns({stored.firstRun(), stored.secondRun()});
    window->grids().read();
    emit window->findChild<MeasurementSheet*>()->parametersRequested({1, 2}, false);
    QSignalSpy answered(&window->bench().reader(), &DatabaseReader::idle);
    int turns = 0;
    QTimer timer;
    connect(&timer, &QTimer::timeout, this, [&] { ++turns; });
    timer.start(0);
    while (turns < 50) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
    QCOMPARE(answered.count(), 0);
    QCOMPARE(chart->run().run, stored.secondRun());
    QCOMPARE(window->bench().run().id, stored.secondRun());
    QTRY_VERIFY(window->findChild<QLabel*>("reading")->text().contains("Reading"));
    stored.unlock();
    settle(*window);
    QCOMPARE(chart->run().run, stored.firstRun());
    QCOMPARE(chart->run().generations.size(), std::size_t(3));
    QCOMPARE(window->comparePage().plot().data().bands.size(), std::size_t(1));
    QCOMPARE(window->findChild<IndividualsTable*>()->model().rowCount(), 6);
    QCOMPARE(window->findChild<QLabel*>("reading")->text(), QString());
    QVERIFY2(message(*window).contains("may only be read"), qPrintable(message(*window)));  // as before
  }

  // Its questions are under way, and the lock is not given up.
  void theWindowClosesWhileTheDatabaseIsLocked() {
    LockedDatabase stored;
    Desk desk;
    desk.options.isWritable = [](const QString&) { return false; };
    auto window = desk.open(stored.qpath());
    stored.lock();
    window->selectRun(stored.firstRun());
    window->grids().read();
    QVERIFY(!window->bench().reader().isIdle());
    QVERIFY(window->close());
    window.reset();
  }

  void aBadDatabaseShowsTheErrorAndKeepsTheOldOne() {
    StoredRun stored;
    fullRun(stored);
    Desk desk;
    const auto window = desk.open(stored.qpath());
    const QString bad = desk.folder.filePath("bad.db");
    QFile file(bad);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(
        "this is no database, and it is longer than a header of one hundred bytes, so that nobody can mistake it");
    file.close();
    QVERIFY(!window->openDatabase(bad));
    QVERIFY2(message(*window).contains("bad.db"), qPrintable(message(*window)));
    QVERIFY(window->banner().isVisible());
    QCOMPARE(window->bench().path(), stored.qpath());
    QCOMPARE(window->findChild<FitnessChart*>()->run().generations.size(), 6u);
  }

  void startsAProcessForTheRunAndAsksItToStop() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment());
    Desk desk;
    const FakeProgram program(QDir(desk.folder.path()));
    desk.options.program = program.program;
    const auto window = desk.open(stored.qpath());
    auto* panel = window->findChild<RunPanel*>();
    panel->setJobs(2);
    QTest::mouseClick(panel->findChild<QPushButton*>("go"), Qt::LeftButton);
    QTRY_COMPARE(program.said(), QString("run --db %1 --run %2 --quiet --jobs 2").arg(stored.qpath()).arg(run));
    QCOMPARE(window->bench().watcher().activeRuns(), std::set<Id>{run});
    QVERIFY(!panel->findChild<QPushButton*>("go")->isEnabled());

    QTest::mouseClick(panel->findChild<QPushButton*>("stop"), Qt::LeftButton);
    QVERIFY(stored.database.run(run).stopRequested);
    settle(*window);
    QCOMPARE(panel->findChild<QLabel*>("stage")->text(), QString("Stopping …"));
    stored.database.setRunState(run, RunState::stopped, "");
    program.end();
    QTRY_VERIFY(window->bench().watcher().activeRuns().empty());
    QTRY_VERIFY(panel->findChild<QPushButton*>("go")->isEnabled());
    QCOMPARE(message(*window), QString());
  }

  void saysTheLastWordsOfAProcessThatEndedTooEarly() {
    StoredRun stored;
    stored.addRun(stored.addExperiment());
    Desk desk;
    const FakeProgram program(QDir(desk.folder.path()),
                              "echo 'kick.json /seed: x is not allowed; a number' >&2\nexit 1\n");
    desk.options.program = program.program;
    const auto window = desk.open(stored.qpath());
    QTest::mouseClick(window->findChild<RunPanel*>()->findChild<QPushButton*>("go"), Qt::LeftButton);
    settle(*window);
    program.end();
    QTRY_VERIFY2(message(*window).contains("kick.json /seed: x is not allowed"), qPrintable(message(*window)));
  }

  void aProgramThatCannotBeStartedIsAMessage() {
    StoredRun stored;
    stored.addRun(stored.addExperiment());
    Desk desk("/no/such/btr");
    const auto window = desk.open(stored.qpath());
    QTest::mouseClick(window->findChild<RunPanel*>()->findChild<QPushButton*>("go"), Qt::LeftButton);
    settle(*window);
    QVERIFY(message(*window).contains("/no/such/btr cannot be started"));
  }

  void closesWithoutAQuestionWhenNothingWorks() {
    StoredRun stored;
    fullRun(stored);
    Desk desk;
    const auto window = desk.open(stored.qpath());
    QVERIFY(window->close());
  }

  void closingCanStopTheRun() {
    StoredRun stored;
    const Id run = fullRun(stored);
    Desk desk;
    desk.active = {run};
    const auto window = desk.open(stored.qpath());
    answerClosing("stop");
    QVERIFY(window->close());
    QVERIFY(stored.database.run(run).stopRequested);
  }

  void closingCanLeaveTheRunWorking() {
    StoredRun stored;
    const Id run = fullRun(stored);
    Desk desk;
    desk.active = {run};
    const auto window = desk.open(stored.qpath());
    answerClosing("leave");
    QVERIFY(window->close());
    QVERIFY(!stored.database.run(run).stopRequested);
  }

  void closingCanBeCancelled() {
    StoredRun stored;
    const Id run = fullRun(stored);
    Desk desk;
    desk.active = {run};
    const auto window = desk.open(stored.qpath());
    answerClosing("cancel");
    QVERIFY(!window->close());
    QVERIFY(window->isVisible());
    QVERIFY(!stored.database.run(run).stopRequested);
  }

  void reopeningFindsDatabaseRunLayoutAndDraft() {
    StoredRun stored;
    const Id first = fullRun(stored);
    stored.addRun(stored.database.experiments().front().id, 6);
    Desk desk;
    {
      const auto window = desk.open(stored.qpath());
      show(*window, first);
      window->findChild<QDockWidget*>("dock.gap")->hide();
      ExperimentSpec spec = StoredRun::spec();
      spec.name = "My draft";
      window->draft().setSpec(spec);
      QVERIFY(window->close());
    }
    const auto window = desk.open(stored.qpath());
    QCOMPARE(window->bench().settings().recentDatabases().first(), stored.qpath());
    QCOMPARE(window->findChild<ExperimentTree*>()->selectedRun(), first);
    QVERIFY(window->findChild<QDockWidget*>("dock.gap")->isHidden());
    QVERIFY(!window->findChild<QDockWidget*>("dock.fitness")->isHidden());
    QCOMPARE(window->draft().spec().name, std::string("My draft"));
  }

  void reopeningFindsNumbersThatAreNotAllowedAsTheyWereTyped() {
    StoredRun stored;
    Desk desk;
    QStringList problems;
    {
      const auto window = desk.open(stored.qpath());
      ExperimentSpec spec = StoredRun::spec();
      spec.name = "My draft";
      window->draft().setSpec(spec);
      const auto others = window->draft().problems().size();
      window->draft().findChild<ParameterForm*>("stages")->setTexts({{"repeats", "many"}});
      window->draft().findChild<LearnerForm*>("learner")->numbers()->setTexts({{"population", "-3"}});
      problems = window->draft().problems();
      QCOMPARE(problems.size(), others + 2);
      QVERIFY(window->close());
    }
    const auto window = desk.open(stored.qpath());
    QCOMPARE(window->draft().spec().name, std::string("My draft"));
    QCOMPARE(window->draft().problems(), problems);
    QCOMPARE(*window->draft().findChild<ParameterForm*>("stages")->field("repeats")->text(), QString("many"));
  }

  void aDraftThatCannotBeReadAgainIsAskedAboutBeforeTheWindowCloses() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    window->draft().setSpec(StoredRun::spec());
    auto* name = window->draft().findChild<QLineEdit*>("name");
    name->selectAll();
    QTest::keyClick(name, Qt::Key_Delete);
    answerClosing("cancel");
    QVERIFY(!window->close());
    answerClosing("close");
    QVERIFY(window->close());
  }

  void storesWhatIsEnteredAndGoesOnWhenAllIsMeasured() {
    StoredRun stored;
    const Id run = stored.addWaitingRun(stored.addExperiment());
    const auto tasks = stored.database.measurementTasks(run);
    Desk desk;
    const FakeProgram program(QDir(desk.folder.path()));
    desk.options.program = program.program;
    const auto window = desk.open(stored.qpath());
    QVERIFY(window->findChild<Alarm*>()->state() != Alarm::State::quiet);

    auto* sheet = window->findChild<MeasurementSheet*>();
    const auto value = [&](Id individual) {
      MeasurementRecord record;
      record.run = run;
      record.individual = individual;
      record.value = 0.5;
      return record;
    };
    emit sheet->submitted({value(tasks[0].individual)});
    QCOMPARE(stored.database.measurements(run).size(), 1u);
    QVERIFY(program.said().isEmpty());
    emit sheet->submitted({value(tasks[1].individual)});
    QCOMPARE(stored.database.measurements(run).size(), 2u);
    settle(*window);
    QCOMPARE(window->findChild<Alarm*>()->state(), Alarm::State::quiet);
    QTRY_VERIFY(program.said().startsWith("run --db"));
    stored.database.setRunState(run, RunState::stopped, "");
    program.end();
    QTRY_VERIFY(window->bench().watcher().activeRuns().empty());
  }

  // Typed and not saved: another run, another database, the end of the program; nothing is lost and nobody is asked.
  void typedMeasurementsWaitForTheirRun() {
    StoredRun stored, elsewhere;
    const Id run = stored.addWaitingRun(stored.addExperiment());
    const Id other = stored.addRun(stored.database.experiments().front().id, 2);
    const Id foreign = elsewhere.addWaitingRun(elsewhere.addExperiment());
    QCOMPARE(foreign, run);
    Desk desk;
    const auto typed = [](MainWindow& window) {
      auto& model = window.findChild<MeasurementSheet*>()->model();
      return model.index(0, MeasurementModel::firstRepeat).data().toString();
    };
    {
      const auto window = desk.open(stored.qpath());
      show(*window, run);
      window->findChild<MeasurementSheet*>()->model().write({{0, MeasurementModel::firstRepeat, "0.5"}}, "entry");
      show(*window, other);
      QCOMPARE(window->findChild<MeasurementSheet*>()->model().rowCount(), 0);
      show(*window, run);
      QCOMPARE(typed(*window), QString("0.5"));
      // The same numbers of run and individuals in another database are others.
      QVERIFY(window->openDatabase(elsewhere.qpath()));
      settle(*window);
      QCOMPARE(window->findChild<MeasurementSheet*>()->model().rowCount(), 2);
      QCOMPARE(typed(*window), QString());
      QVERIFY(window->openDatabase(stored.qpath()));
      settle(*window);
      QCOMPARE(typed(*window), QString("0.5"));
      QVERIFY(window->close());
    }
    const auto window = desk.open(stored.qpath());
    auto* sheet = window->findChild<MeasurementSheet*>();
    QCOMPARE(typed(*window), QString("0.5"));
    QVERIFY(sheet->findChild<MessageBanner*>()->text().contains("not saved yet"));
    sheet->save();
    QCOMPARE(stored.database.measurements(run).size(), 1u);
    QCOMPARE(window->bench().settings().measurementDraft(stored.qpath(), run), QString());
  }

  void voidingAValueThatL3TookInOffersToGoBack() {
    StoredRun stored;
    const Id run = stored.addWaitingRun(stored.addExperiment());
    const Id individual = stored.database.measurementTasks(run).front().individual;
    const Id value = stored.measure(run, individual, 0.5);
    SimulatorRecord version;
    version.run = run;
    version.parent = stored.database.simulators(run).back().id;
    version.madeBy = "L3";
    version.evidence = R"({"stage": 1, "individuals": [)" + std::to_string(individual) + "]}";
    stored.database.addSimulator(version);
    Desk desk;
    const auto window = desk.open(stored.qpath());
    show(*window, run);
    answerClosing("goBack");
    emit window->findChild<MeasurementSheet*>()->voidRequested(value, true, "hit the wall");
    QVERIFY(stored.database.measurement(value).isVoid);
    const std::vector<SimulatorRecord> versions = stored.database.simulators(run);
    QCOMPARE(versions.size(), std::size_t(3));
    QCOMPARE(originOf(versions.back()), std::string("back to version 0"));
    // Nothing rests on it any more: counting it and voiding it again asks nothing.
    emit window->findChild<MeasurementSheet*>()->voidRequested(value, false, "");
    emit window->findChild<MeasurementSheet*>()->voidRequested(value, true, "");
    QCOMPARE(stored.database.simulators(run).size(), std::size_t(3));
  }

  void anOpenEditorIsKeptToo() {
    StoredRun stored;
    const Id run = stored.addWaitingRun(stored.addExperiment());
    Desk desk;
    const auto window = desk.open(stored.qpath());
    QVERIFY(QTest::qWaitForWindowActive(window.get()));
    auto* sheet = window->findChild<MeasurementSheet*>();
    sheet->view().setFocus();
    sheet->view().setCurrentIndex(sheet->model().index(0, MeasurementModel::firstRepeat));
    QTest::keyClick(&sheet->view(), Qt::Key_7);
    QVERIFY(!sheet->model().hasUnsaved());
    QVERIFY(window->close());
    QVERIFY(window->bench().settings().measurementDraft(stored.qpath(), run).contains("\"7\""));
  }

  void theKeyForSavingIsOfThePageWithTheFocus() {
    StoredRun stored;
    const Id run = stored.addWaitingRun(stored.addExperiment());
    Desk desk;
    const auto window = desk.open(stored.qpath());
    QVERIFY(QTest::qWaitForWindowActive(window.get()));
    auto* sheet = window->findChild<MeasurementSheet*>();
    sheet->model().write({{0, MeasurementModel::firstRepeat, "0.5"}}, "entry");
    sheet->view().setFocus();
    QTest::keyClick(&sheet->view(), Qt::Key_S, Qt::ControlModifier);
    QCOMPARE(stored.database.measurements(run).size(), 1u);
    // No two actions of the whole window share a key.
    QStringList keys;
    for (const QAction* action : window->findChildren<QAction*>())
      if (action->shortcutContext() == Qt::WindowShortcut)
        for (const QKeySequence& key : action->shortcuts()) keys << key.toString();
    QCOMPARE(keys.removeDuplicates(), 0);
    QVERIFY(!keys.contains("Ctrl+S"));
  }

  void theAlarmNamesAnyWaitingRunAndLeadsToIt() {
    StoredRun stored;
    const Id waiting = stored.addWaitingRun(stored.addExperiment(), 7);
    const Id other = stored.addRun(stored.database.experiments().front().id, 8);
    Desk desk;
    const auto window = desk.open(stored.qpath());
    show(*window, other);
    auto* alarm = window->findChild<Alarm*>();
    QCOMPARE(alarm->state(), Alarm::State::ringing);
    QVERIFY2(alarm->message().contains(QString("Run %1").arg(waiting)), qPrintable(alarm->message()));
    emit alarm->sheetRequested();
    settle(*window);
    QCOMPARE(window->findChild<ExperimentTree*>()->selectedRun(), waiting);
    QCOMPARE(window->findChild<MeasurementSheet*>()->model().rowCount(), 2);
  }

  // The sheet comes to the front by itself with a marked cell: what is typed goes there, unless it belongs elsewhere.
  void theSheetThatIsWantedHasTheKeys_data() {
    QTest::addColumn<QString>("before");
    QTest::addColumn<bool>("stays");
    QTest::newRow("a button") << "go" << false;
    QTest::newRow("the tree") << "experimentTree" << false;
    QTest::newRow("an empty field") << "searchExperiments" << false;
    QTest::newRow("a field that is typed into") << "searchExperiments" << true;
  }
  void theSheetThatIsWantedHasTheKeys() {
    QFETCH(QString, before);
    QFETCH(bool, stays);
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment(), 7);
    stored.addGenerations(run, 3);
    Desk desk;
    const auto window = desk.open(stored.qpath());
    QVERIFY(QTest::qWaitForWindowActive(window.get()));
    show(*window, run);
    auto* focus = window->findChild<QWidget*>(before);
    focus->setFocus();
    QCOMPARE(window->focusWidget(), focus);
    if (stays) QTest::keyClicks(focus, "Ki");
    stored.addTasks(run);
    QTRY_VERIFY(window->findChild<Alarm*>()->isVisible());
    settle(*window);
    auto& sheet = window->findChild<MeasurementSheet*>()->view();
    QTRY_COMPARE(window->focusWidget(), stays ? focus : &sheet);
    emit window->findChild<Alarm*>()->sheetRequested();
    settle(*window);
    QCOMPARE(window->focusWidget(), &sheet);
  }

  // What went wrong with one step says nothing about the next.
  void anErrorIsOverWhenAnotherSimulatorIsTaken() {
    StoredRun stored;
    const Id run = stored.addWaitingRun(stored.addExperiment(), 7);
    Desk desk;
    const auto window = desk.open(stored.qpath());
    show(*window, run);
    window->bench().report("btr: run 1: its version 1 is this simulator already");
    QCOMPARE(window->banner().text(), QString("run 1: its version 1 is this simulator already"));
    emit window->gapPage().revertRequested({});
    QCOMPARE(window->banner().text(), QString());
  }

  void theAlarmsComingMovesNothing() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment(), 7);
    stored.addGenerations(run, 3);
    Desk desk;
    const auto window = desk.open(stored.qpath());
    QVERIFY(QTest::qWaitForWindowExposed(window.get()));
    QCoreApplication::processEvents();
    auto* tree = window->findChild<QDockWidget*>("dock.tree");
    const QPoint before = tree->mapTo(window.get(), QPoint());
    stored.addTasks(run);
    auto* alarm = window->findChild<Alarm*>();
    QTRY_VERIFY(alarm->isVisible());
    QCoreApplication::processEvents();
    QCOMPARE(tree->mapTo(window.get(), QPoint()), before);
  }

  void theSimulatedFitnessOfThoseThatWaitIsHiddenEverywhere() {
    StoredRun stored;
    const Id run = stored.addWaitingRun(stored.addExperiment());
    const auto tasks = stored.database.measurementTasks(run);
    Desk desk;
    const auto window = desk.open(stored.qpath());
    auto* table = window->findChild<IndividualsTable*>();
    QTRY_COMPARE(table->model().rowCount(), 6);
    QVERIFY(table->model().isHidden(stored.database.individual(tasks[0].individual)));
    for (const auto& task : tasks) stored.measure(run, task.individual, 0.25);
    QTRY_VERIFY(!table->model().isHidden(stored.database.individual(tasks[0].individual)));
  }

  // 1366 × 768, less a task bar and a title.
  void theWindowFitsASmallLaptop() {
    StoredRun stored;
    fullRun(stored);
    Desk desk;
    const auto window = desk.open(stored.qpath());
    QString said;
    for (const QDockWidget* dock : window->findChildren<QDockWidget*>()) {
      const QSize least = dock->widget()->minimumSizeHint();
      said += QString("%1 %2x%3; ").arg(dock->objectName()).arg(least.width()).arg(least.height());
    }
    const QSize least = window->minimumSizeHint();
    QVERIFY2(least.width() <= 1366 && least.height() <= 700,
             qPrintable(QString("%1x%2: %3").arg(least.width()).arg(least.height()).arg(said)));
    window->resize(1366, 700);
    QCOMPARE(window->size(), QSize(1366, 700));
  }

  // The first time that it opens nobody has sized it yet: no larger than the screen, if it can be as small.
  void theWindowOpensNoLargerThanTheScreen() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    const QSize most = window->screen()->availableSize().expandedTo(window->minimumSizeHint());
    QVERIFY2(
        window->width() <= most.width() && window->height() <= most.height(),
        qPrintable(
            QString("%1x%2, %3x%4").arg(window->width()).arg(window->height()).arg(most.width()).arg(most.height())));
  }

  void theParametersOfIndividualsAreATable() {
    StoredRun stored;
    const Id run = stored.addWaitingRun(stored.addExperiment());
    const auto tasks = stored.database.measurementTasks(run);
    Desk desk;
    const auto window = desk.open(stored.qpath());
    emit window->findChild<MeasurementSheet*>()->parametersRequested({tasks[0].individual, tasks[1].individual}, false);
    settle(*window);
    const QStringList lines = QApplication::clipboard()->text().split('\n');
    QCOMPARE(lines.size(), 4);
    QVERIFY(lines[0].startsWith("individual,"));
    QCOMPARE(lines[0].count(','), 25);
    QCOMPARE(lines[2].section(',', 0, 1), QString("%1,0.5").arg(tasks[1].individual));
  }

  void theCluesCountIndividualsWithAValueThatIsNotVoid() {
    StoredRun stored;
    const Id run = fullRun(stored);
    Desk desk;
    const auto window = desk.open(stored.qpath());
    const auto* state = window->findChild<CluesView*>()->findChild<QLabel*>("state");
    QVERIFY(state->text().startsWith("2 of this run's individuals"));
    const auto values = stored.database.measurements(run);
    stored.measure(run, values[0].individual, 0.5);
    stored.database.setMeasurementVoid(values[0].id, true, "fell over");
    stored.database.setMeasurementVoid(values[1].id, true, "slipped");
    QTRY_VERIFY(state->text().startsWith("1 of this run's individuals"));
    // A run that nobody has measured.
    const Id other = stored.addRun(stored.addExperiment("Other"));
    emit window->findChild<ExperimentTree*>()->runSelected(other);
    settle(*window);
    QVERIFY(state->text().startsWith("0 of this run's individuals"));
  }

  void aStandInRunRingsNoAlarm() {
    StoredRun stored;
    stored.addWaitingRun(stored.addExperiment(), 1, "stand_in");
    Desk desk;
    const auto window = desk.open(stored.qpath());
    QCOMPARE(window->findChild<Alarm*>()->state(), Alarm::State::quiet);
    QVERIFY(window->findChild<RunPanel*>()->findChild<QLabel*>("standIn")->isVisible());
  }

  void anExperimentFileThatIsWrongLeavesTheDraft() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    window->draft().setSpec(StoredRun::spec());
    const QString file = desk.folder.filePath("wrong.json");
    QFile json(file);
    QVERIFY(json.open(QIODevice::WriteOnly));
    json.write("{\"format\": \"uchilsim-experiment-1\", \"name\": 3}");
    json.close();
    QVERIFY(!window->drafts().open(file));
    QVERIFY2(message(*window).contains("wrong.json"), qPrintable(message(*window)));
    QCOMPARE(window->draft().spec().name, std::string("Kick"));
  }

  void everyDockIsNamedAndCanBeShownFromTheMenu() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    const auto docks = window->findChildren<QDockWidget*>();
    QVERIFY(docks.size() >= 9);
    for (QDockWidget* dock : docks) {
      QVERIFY(dock->objectName().startsWith("dock."));
      dock->hide();
      dock->toggleViewAction()->trigger();
      QVERIFY(!dock->isHidden());
    }
  }

  void aNewExperimentIsOneThatCanBeStarted() {
    StoredRun stored;
    Desk desk;
    const auto window = desk.open(stored.qpath());
    const auto actions = window->findChildren<QAction*>();
    const auto fresh = std::ranges::find(actions, "&New experiment", &QAction::text);
    QVERIFY(fresh != actions.end());
    (*fresh)->trigger();
    QVERIFY2(window->draft().isValid(), qPrintable(window->draft().problems().join('\n')));
    prepareFromFiles(window->draft().spec(), test::host());
  }

  // The real program, on the short experiment of the newcomer.
  void aStartedDraftIsStoredAndLearns() {
    QTemporaryDir folder;
    const QString database = folder.filePath("new.db");
    RealDesk desk;
    const auto window = desk.open(database);
    ExperimentSpec spec = loadExperiment(SOURCE_DIR "/resources/experiments/kick-short.json");
    spec.learner.settings["population"] = 4;
    spec.stages["first_generations"] = 2;
    spec.stages["total_generations"] = 2;
    window->draft().setSpec(spec);
    startDraft(*window);
    QTRY_VERIFY_WITH_TIMEOUT(window->findChild<FitnessChart*>()->run().generations.size() >= 1, 120000);
    const Id run = window->findChild<ExperimentTree*>()->selectedRun();
    window->runs().stop(run);
    QTRY_VERIFY_WITH_TIMEOUT(window->bench().watcher().activeRuns().empty(), 120000);
    QVERIFY2(message(*window).isEmpty(), qPrintable(message(*window)));
  }

  void takesTheRunsOfAnotherDatabase() {
    StoredRun ours, theirs;
    const Id own = fullRun(ours);
    theirs.addGenerations(theirs.addRun(theirs.addExperiment(), 6), 6);
    Desk desk(BTR_PROGRAM);
    const auto window = desk.open(ours.qpath());
    window->runs().merge(theirs.qpath());
    QTRY_COMPARE_WITH_TIMEOUT(message(*window), QString("1 runs with 12 individuals were copied from test.db."), 20000);
    QTRY_COMPARE(window->findChild<ExperimentTree*>()->view()->model()->rowCount(
                     window->findChild<ExperimentTree*>()->view()->model()->index(0, 0)),
                 2);
    QCOMPARE(window->findChild<ExperimentTree*>()->selectedRun(), own);
    // Once more: they are there.
    window->runs().merge(theirs.qpath());
    QTRY_VERIFY_WITH_TIMEOUT(message(*window).contains("nothing was copied"), 20000);
    QCOMPARE(ours.database.runs().size(), std::size_t(2));
  }

  // What was found about a robot that no run has becomes a version of its scene, and is taken back, with the real
  // program.
  void aRigTakesWhatGapAnalysisFound() {
    StoredRun stored;
    const Id run = fullRun(stored);
    const RigReport files(stored.folder.path().toStdString());
    Desk desk(BTR_PROGRAM);
    const auto window = desk.open(stored.qpath());
    QVERIFY(window->openReport(QString::fromStdString(files.report)));
    auto* into = window->gapPage().findChild<QComboBox*>("adoptInto");
    QCOMPARE(into->count(), 2);
    QCOMPARE(into->currentText(), QString("rig bench"));
    window->gapPage().adoptAction()->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(window->statusBar()->currentMessage(), QString("rig bench has simulator version 1 now."),
                              20000);
    QCOMPARE(into->currentText(), QString("rig bench, simulator version 1"));
    const auto rigs = stored.database.rigSimulators(0);
    QCOMPARE(rigs.size(), std::size_t(2));
    QCOMPARE(stored.database.simulators(run).size(), std::size_t(2));  // the run's own are as they were

    // The tree leads to its versions.
    auto* tree = window->findChild<ExperimentTree*>();
    const QModelIndex rig = tree->view()->model()->index(1, 0);
    QCOMPARE(rig.data().toString(), QString("bench"));
    tree->view()->setCurrentIndex(tree->view()->model()->index(1, 0, rig));
    QCOMPARE(window->findChild<SimulatorsPage*>()->findChild<QTableWidget*>("versions")->rowCount(), 2);
    QCOMPARE(tree->selectedRig(), rigs.front().rig);
    // Beside the page there is no room for them: it is left.
    QVERIFY(window->findChild<QDockWidget*>("dock.simulators")->isVisible());
    QVERIFY(!window->findChild<QDockWidget*>("dock.analysis")->isVisible());
    QVERIFY(window->openReport(QString::fromStdString(files.report)));
    // An analysis of this scene may begin with it.
    window->gapPage().setup().setScene(QString::fromStdString(files.scene));
    settle(*window);
    QCOMPARE(window->gapPage().setup().findChild<QComboBox*>("simulator")->itemText(1),
             QString("rig bench, version 1 by gap analysis"));

    window->gapPage().revertAction()->trigger();
    QTRY_COMPARE_WITH_TIMEOUT(window->statusBar()->currentMessage(), QString("rig bench has simulator version 2 now."),
                              20000);
    QCOMPARE(stored.database.rigSimulators(0).back().simulator, SimulatorSpec{});
    QCOMPARE(window->findChild<SimulatorsPage*>()->findChild<QTableWidget*>("versions")->rowCount(), 3);
    tree->selectRun(run);
    show(*window, run);
    QCOMPARE(window->findChild<SimulatorsPage*>()->findChild<QTableWidget*>("versions")->rowCount(), 2);
  }

  // From the form to the end with the real program: L1, two measured, L2 of one iteration, L3, L1, measured again.
  void aPersonsWalkGoesFromTheFormToItsEnd() {
    QTemporaryDir folder;
    const QString database = folder.filePath("walk.db");
    RealDesk desk;
    const auto window = desk.open(database);
    ExperimentSpec spec = loadExperiment(SOURCE_DIR "/resources/experiments/walk-short.json");
    spec.learner.settings["population"] = 4;
    spec.stages["first_generations"] = 2;
    spec.stages["next_generations"] = 1;
    spec.stages["total_generations"] = 4;
    spec.stages["measured_individuals"] = 2;
    spec.adaptation.settings["population"] = 4;
    spec.adaptationSettings["generations"] = 1;
    spec.realityLearner.settings["policies"] = 3;
    spec.realitySettings["iterations"] = 1;
    window->draft().setSpec(spec);
    auto* reality = window->draft().findChild<QComboBox*>("reality");
    QCOMPARE(reality->currentData().toString(), QString("stand_in"));
    reality->setFocus();
    QTest::keyClick(reality, Qt::Key_Home);
    QCOMPARE(reality->currentData().toString(), QString("person"));
    startDraft(*window);

    auto* sheet = window->findChild<MeasurementSheet*>();
    const auto stored = [&] { return Database::open(database.toStdString(), Database::Mode::readOnly); };
    QTRY_VERIFY_WITH_TIMEOUT(window->findChild<ExperimentTree*>()->selectedRun() != 0, 60000);
    const Id run = window->findChild<ExperimentTree*>()->selectedRun();
    int entered = 0, visits = 0;
    for (; visits < 10; ++visits) {
      const auto isOpen = [&](const MeasurementRow& row) { return !row.isDone(); };
      QTRY_VERIFY_WITH_TIMEOUT(
          window->bench().watcher().activeRuns().empty() &&
              (stored().run(run).state == RunState::finished || std::ranges::any_of(sheet->model().rows(), isOpen)),
          120000);
      QVERIFY2(message(*window).isEmpty(), qPrintable(message(*window)));
      if (stored().run(run).state == RunState::finished) break;
      // What a stopwatch might have given, typed into every cell that waits.
      std::vector<MeasurementModel::Text> texts;
      for (int row = 0; row < std::ssize(sheet->model().rows()); ++row)
        for (int repeat = 0; repeat < sheet->model().repeatColumns(); ++repeat)
          texts.push_back({row, MeasurementModel::firstRepeat + repeat, QString::number(8 + 0.5 * ++entered)});
      sheet->model().write(texts, "entry");
      sheet->save();
      // The last values of a stage: the run goes on with them by itself.
      auto* question = sheet->findChild<QuestionBar*>();
      QVERIFY2(question->isAsking() && question->text().contains("goes on"), qPrintable(question->text()));
      QTest::mouseClick(question->yes(), Qt::LeftButton);
    }
    const RunRecord end = stored().run(run);
    QCOMPARE(end.state, RunState::finished);
    QCOMPARE(end.generation, 4);
    QCOMPARE(stored().realityIterations(run).size(), std::size_t(1));
    QVERIFY(stored().simulators(run).size() >= 2);
    QCOMPARE(stored().measurements(run).size(), std::size_t(entered));
    QVERIFY(!stored().gaps(run).empty());
  }
};

UI_TEST(TestMainWindow)
#include "test_main_window.moc"
