// The watcher reads what other connections write and tells it once.
#include <QSignalSpy>
#include <QTest>

#include "core/spec/error.h"
#include "tests/ui/stored_run.h"
#include "ui/common/database_watcher.h"

using namespace btr;
using namespace btr::ui;

class TestDatabaseWatcher : public QObject {
  Q_OBJECT
 private slots:
  void tellsEverythingOfTheFollowedRunAtFirst() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment());
    stored.addGenerations(run, 3);
    DatabaseWatcher watcher([](const std::string&, Id) { return false; });
    QSignalSpy runs(&watcher, &DatabaseWatcher::runsChanged), all(&watcher, &DatabaseWatcher::generationsReset),
        tasks(&watcher, &DatabaseWatcher::tasksChanged), simulators(&watcher, &DatabaseWatcher::simulatorsChanged);
    watcher.open(stored.qpath());
    QCOMPARE(runs.count(), 1);
    QCOMPARE(all.count(), 0);
    watcher.follow(run);
    QCOMPARE(all.count(), 1);
    QCOMPARE(all.first().last().value<std::vector<GenerationRecord>>().size(), 3u);
    QCOMPARE(tasks.count(), 1);
    QCOMPARE(simulators.count(), 1);
  }

  void noticesByItselfWhatAnotherConnectionWrites() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment());
    stored.addGenerations(run, 2);
    DatabaseWatcher watcher([](const std::string&, Id) { return false; }, 10);
    watcher.open(stored.qpath());
    watcher.follow(run);
    QSignalSpy added(&watcher, &DatabaseWatcher::generationsAdded), changed(&watcher, &DatabaseWatcher::runChanged);
    stored.addGenerations(run, 1);
    QVERIFY(added.wait(5000));
    const auto generations = added.first().last().value<std::vector<GenerationRecord>>();
    QCOMPARE(generations.size(), 1u);
    QCOMPARE(generations.front().number, 3);
    QCOMPARE(changed.last().first().value<RunRecord>().generation, 3);
  }

  void isSilentWhileNothingChanges() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment());
    DatabaseWatcher watcher([](const std::string&, Id) { return false; });
    watcher.open(stored.qpath());
    watcher.follow(run);
    QSignalSpy runs(&watcher, &DatabaseWatcher::runsChanged), changed(&watcher, &DatabaseWatcher::runChanged);
    watcher.poll();
    watcher.poll();
    QCOMPARE(runs.count(), 0);
    QCOMPARE(changed.count(), 0);
  }

  void tellsTasksAndGapsOnlyWhenTheyChange() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment());
    stored.addGenerations(run, 3);
    DatabaseWatcher watcher([](const std::string&, Id) { return false; });
    watcher.open(stored.qpath());
    watcher.follow(run);
    QSignalSpy tasks(&watcher, &DatabaseWatcher::tasksChanged), gaps(&watcher, &DatabaseWatcher::gapsChanged),
        versions(&watcher, &DatabaseWatcher::versionsChanged);
    stored.database.setProgress(run, "{}");
    watcher.poll();
    QCOMPARE(tasks.count(), 0);  // a sheet that is being typed into must not be filled anew
    const auto drawn = stored.addTasks(run);
    watcher.poll();
    QCOMPARE(tasks.count(), 1);
    const Id measurement = stored.measure(run, drawn.front().individual, 0.5);
    watcher.poll();
    QCOMPARE(tasks.count(), 2);
    stored.database.setMeasurementVoid(measurement, true, "fell");
    watcher.poll();
    QCOMPARE(tasks.count(), 3);
    stored.finishStage(run, {{"friction", 0.5}});
    watcher.poll();
    QCOMPARE(gaps.count(), 1);
    QCOMPARE(versions.count(), 1);
    QCOMPARE(versions.last().last().value<std::vector<SimulatorRecord>>().size(), 2u);
  }

  void noticesThatAProcessBeginsAndEndsWithoutAnyWrite() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment());
    bool works = false;
    DatabaseWatcher watcher([&](const std::string&, Id) { return works; });
    watcher.open(stored.qpath());
    watcher.follow(run);
    QSignalSpy active(&watcher, &DatabaseWatcher::activeChanged), changed(&watcher, &DatabaseWatcher::runChanged);
    works = true;
    watcher.poll();
    QCOMPARE(active.count(), 1);
    QCOMPARE(changed.last().last().toBool(), true);
    QCOMPARE(watcher.activeRuns(), std::set<Id>{run});
    works = false;
    watcher.poll();
    QCOMPARE(changed.last().last().toBool(), false);
    QVERIFY(watcher.activeRuns().empty());
  }

  void keepsTheOldDatabaseWhenAnotherCannotBeOpened() {
    StoredRun stored;
    stored.addRun(stored.addExperiment());
    DatabaseWatcher watcher([](const std::string&, Id) { return false; });
    watcher.open(stored.qpath());
    QVERIFY_THROWS_EXCEPTION(InputError, watcher.open(stored.folder.filePath("absent.db")));
    QCOMPARE(watcher.path(), stored.qpath());
    QCOMPARE(watcher.database().runs().size(), 1u);
  }
};

QTEST_MAIN(TestDatabaseWatcher)
#include "test_database_watcher.moc"
