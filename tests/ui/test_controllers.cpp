// Each controller by itself, on a workbench without a window.
#include <QApplication>
#include <QFile>
#include <QSignalSpy>
#include <QTest>
#include <algorithm>

#include "tests/ui/stored_run.h"
#include "tests/ui/ui_tests.h"
#include "ui/charts/compare_page.h"
#include "ui/controllers/compare_controller.h"
#include "ui/controllers/draft_controller.h"
#include "ui/controllers/grid_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/controllers/rig_controller.h"
#include "ui/controllers/run_controller.h"
#include "ui/database/individuals_table.h"
#include "ui/experiment/experiment_form.h"
#include "ui/experiment/experiment_tree.h"
#include "ui/experiment/run_text.h"
#include "ui/experiment/simulators_page.h"
#include "ui/gap/gap_page.h"
#include "ui/grid/grid_page.h"
#include "ui/measure/alarm.h"
#include "ui/measure/measurement_sheet.h"
#include "ui/measure/policy_page.h"

using namespace btr;
using namespace btr::ui;

namespace {

struct Desk {
  Desk() {
    options.settingsFile = folder.filePath("settings.ini");
    options.program = "/bin/true";
    options.isActive = [this](const std::string&, Id run) { return active.count(run) > 0; };
  }
  StoredRun stored;
  QTemporaryDir folder;
  std::set<Id> active;
  std::shared_ptr<const PluginHost> host = std::make_shared<const PluginHost>(PLUGIN_DIR);
  QWidget window;
  WindowOptions options;
};

/// Opened, and everything that follows from it is read.
void open(Workbench& bench, const Desk& desk) {
  QVERIFY(bench.open(desk.stored.qpath(), Workbench::Absent::ask));
  bench.reader().waitUntilIdle();
}

}  // namespace

class TestControllers : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { qputenv("UCHILSIM_RESOURCES", SOURCE_DIR "/resources"); }

  void theWorkbenchSelectsTheRunThatWasSelectedLast() {
    Desk desk;
    const Id first = desk.stored.addRun(desk.stored.addExperiment(), 1);
    const Id second = desk.stored.addRun(desk.stored.database.experiments().front().id, 2);
    {
      Workbench bench(desk.host, desk.options, desk.window);
      open(bench, desk);
      QCOMPARE(bench.run().id, second);
      bench.selectRun(first);
      QCOMPARE(bench.run().id, second);  // until everything about the other one is there
      bench.reader().waitUntilIdle();
      QCOMPARE(bench.run().id, first);
    }
    Workbench bench(desk.host, desk.options, desk.window);
    QSignalSpy selected(&bench, &Workbench::runSelected);
    open(bench, desk);
    QCOMPARE(bench.run().id, first);
    QCOMPARE(selected.count(), 1);
  }

  void aRunThatCannotBeReadLeavesTheOneBefore() {
    Desk desk;
    const Id run = desk.stored.addRun(desk.stored.addExperiment(), 1);
    Workbench bench(desk.host, desk.options, desk.window);
    QVERIFY(bench.open(desk.stored.qpath(), Workbench::Absent::ask));
    // Also one that was not shown yet.
    QSignalSpy errors(&bench, &Workbench::reported);
    bench.selectRun(77);
    bool shown = false;
    bench.whenSelected([&] { shown = true; });
    bench.reader().waitUntilIdle();
    QCOMPARE(errors.count(), 1);
    QVERIFY(errors.first().first().toString().contains("run 77"));
    QCOMPARE(bench.run().id, run);
    QVERIFY(!shown);
    // What is stored meanwhile is still told.
    desk.stored.addRun(desk.stored.database.experiments().front().id, 2);
    bench.watcher().poll();
    bench.reader().waitUntilIdle();
    QCOMPARE(bench.watcher().runs().size(), std::size_t(2));
    QCOMPARE(errors.count(), 1);
  }

  void anExperimentsNameIsTheUsersAndTheStoredOneStays() {
    Desk desk;
    const Id experiment = desk.stored.addExperiment("Kick");
    QStringList names;
    const auto follow = [&](Workbench& bench) {
      connect(&bench.watcher(), &DatabaseWatcher::runsChanged, this,
              [&](const std::vector<ExperimentRecord>& all) { names << QString::fromStdString(all.front().name); });
    };
    {
      Workbench bench(desk.host, desk.options, desk.window);
      follow(bench);
      open(bench, desk);
      bench.nameExperiment(experiment, "Kick, worn knee");
      QCOMPARE(names.last(), QString("Kick, worn knee"));
      QCOMPARE(bench.nameOfExperiment(experiment), QString("Kick, worn knee"));
    }
    QCOMPARE(desk.stored.database.experiment(experiment).name, std::string("Kick"));
    names.clear();
    Workbench bench(desk.host, desk.options, desk.window);
    follow(bench);
    open(bench, desk);
    QCOMPARE(names.last(), QString("Kick, worn knee"));
    bench.nameExperiment(experiment, "");
    QCOMPARE(names.last(), QString("Kick"));
  }

  void aRunThatIsFinishedIsNotStartedAgain() {
    Desk desk;
    const Id run = desk.stored.addRun(desk.stored.addExperiment());
    desk.stored.database.setRunState(run, RunState::finished, "");
    Workbench bench(desk.host, desk.options, desk.window);
    RunController runs(bench);
    open(bench, desk);
    QSignalSpy informed(&bench, &Workbench::informed);
    runs.resume(run);
    bench.reader().waitUntilIdle();
    QVERIFY(informed.last().first().toString().contains("is finished"));
    QVERIFY(!bench.launcher().isAlive(run));
  }

  void aStopIsWrittenForTheProcessThatWorks() {
    Desk desk;
    const Id run = desk.stored.addRun(desk.stored.addExperiment());
    desk.active = {run};
    Workbench bench(desk.host, desk.options, desk.window);
    RunController runs(bench);
    open(bench, desk);
    runs.stop(run);
    QVERIFY(desk.stored.database.run(run).stopRequested);
  }

  void enteredValuesAreStoredAndCounted() {
    Desk desk;
    const Id run = desk.stored.addWaitingRun(desk.stored.addExperiment());
    Workbench bench(desk.host, desk.options, desk.window);
    RunController runs(bench);
    MeasurementSheet sheet;
    PolicyPage policies;
    Alarm alarm(nullptr, desk.options.settingsFile, [] {});
    IndividualsTable individuals;
    MeasureController measuring(bench, runs, {sheet, policies, alarm, individuals});
    QSignalSpy wanted(&measuring, &MeasureController::sheetWanted);
    QList<MeasuringCount> counts;
    connect(&measuring, &MeasureController::measuringChanged, this,
            [&](const MeasuringCount& count) { counts << count; });
    open(bench, desk);
    QCOMPARE(wanted.count(), 1);
    QVERIFY(measuring.isSheetWanted());
    QCOMPARE(alarm.state(), Alarm::State::ringing);
    QCOMPARE(counts.last().settled, 0);
    MeasurementRecord value;
    value.run = run;
    value.individual = desk.stored.database.measurementTasks(run).front().individual;
    value.value = 0.5;
    emit sheet.submitted({value});
    QCOMPARE(desk.stored.database.measurements(run).size(), std::size_t(1));
    QCOMPARE(counts.last().settled, 1);
    QCOMPARE(counts.last().wanted, 2);
  }

  void gridsAreReadFromTheDatabaseThatIsOpen() {
    Desk desk;
    desk.stored.addRun(desk.stored.addExperiment());
    Workbench bench(desk.host, desk.options, desk.window);
    RunController runs(bench);
    GridPage page("/bin/true");
    GridController grids(bench, runs, page);
    open(bench, desk);
    QSignalSpy docks(&bench, &Workbench::dockWanted), errors(&bench, &Workbench::reported);
    grids.show(0);
    QCOMPARE(docks.first().first().toString(), QString("grid"));
    QCOMPARE(errors.count(), 0);
    QVERIFY(grids.groups().empty());
  }

  void theSelectedRunMayTakeARepairedSimulatorUnlessItIsFinished() {
    Desk desk;
    const Id run = desk.stored.addWaitingRun(desk.stored.addExperiment());
    const Id rig = desk.stored.database.addRig({0, "xl330", "{}", "", ""}, SimulatorRecord{});
    Workbench bench(desk.host, desk.options, desk.window);
    GapPage page("/bin/true");
    ExperimentTree tree;
    SimulatorsPage versions;
    RigController rigs(bench, page, tree, versions);
    open(bench, desk);
    QCOMPARE(bench.run().id, run);
    QSignalSpy docks(&bench, &Workbench::dockWanted);
    rigs.select(rig, 0);
    QCOMPARE(bench.run().id, Id(0));
    QCOMPARE(docks.last().first().toString(), QString("simulators"));
  }

  void comparedRunsStandBesideThoseThatAreTicked() {
    Desk desk;
    const Id experiment = desk.stored.addExperiment();
    const Id first = desk.stored.addRun(experiment, 1), second = desk.stored.addRun(experiment, 2);
    desk.stored.addGenerations(first, 3);
    desk.stored.addGenerations(second, 3);
    Workbench bench(desk.host, desk.options, desk.window);
    ComparePage page;
    CompareController comparing(bench, page);
    open(bench, desk);
    comparing.compare({first});
    comparing.compare({second});
    bench.reader().waitUntilIdle();
    std::vector<Id> chosen = page.chosen();
    std::ranges::sort(chosen);
    QCOMPARE(chosen, (std::vector<Id>{first, second}));
  }
};

UI_TEST(TestControllers)
#include "test_controllers.moc"
