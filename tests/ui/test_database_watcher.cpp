// The watcher reads what other connections write and tells it once.
#include <QSignalSpy>
#include <QTest>
#include <atomic>

#include "core/spec/error.h"
#include "tests/ui/stored_run.h"
#include "tests/ui/ui_tests.h"
#include "ui/common/database/database_watcher.h"

using namespace btr;
using namespace btr::ui;

namespace {

/// A watcher with its reader. Signals come once the reader has answered.
struct Watched {
  explicit Watched(
      const DatabaseWatcher::ActiveTest& isActive = [](const std::string&, Id) { return false; }, int interval_ms = 250)
      : watcher(reader, isActive, {}, interval_ms) {}
  void follow(Id run) {
    watcher.follow(run);
    reader.waitUntilIdle();
  }
  void poll() {
    watcher.poll();
    reader.waitUntilIdle();
  }
  DatabaseReader reader;
  DatabaseWatcher watcher;
};

}  // namespace

class TestDatabaseWatcher : public QObject {
  Q_OBJECT
 private slots:
  void tellsEverythingOfTheFollowedRunAtFirst() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment());
    stored.addGenerations(run, 3);
    Watched watched;
    DatabaseWatcher& watcher = watched.watcher;
    QSignalSpy runs(&watcher, &DatabaseWatcher::runsChanged), all(&watcher, &DatabaseWatcher::generationsReset),
        tasks(&watcher, &DatabaseWatcher::tasksChanged), simulators(&watcher, &DatabaseWatcher::simulatorsChanged);
    watcher.open(stored.qpath());
    QCOMPARE(runs.count(), 1);
    QCOMPARE(all.count(), 0);
    watched.follow(run);
    QCOMPARE(all.count(), 1);
    QCOMPARE(all.first().last().value<std::vector<GenerationRecord>>().size(), 3u);
    QCOMPARE(tasks.count(), 1);
    QCOMPARE(simulators.count(), 1);
  }

  void noticesByItselfWhatAnotherConnectionWrites() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment());
    stored.addGenerations(run, 2);
    Watched watched([](const std::string&, Id) { return false; }, 10);
    DatabaseWatcher& watcher = watched.watcher;
    watcher.open(stored.qpath());
    watched.follow(run);
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
    Watched watched;
    DatabaseWatcher& watcher = watched.watcher;
    watcher.open(stored.qpath());
    watched.follow(run);
    QSignalSpy runs(&watcher, &DatabaseWatcher::runsChanged), changed(&watcher, &DatabaseWatcher::runChanged);
    watched.poll();
    watched.poll();
    QCOMPARE(runs.count(), 0);
    QCOMPARE(changed.count(), 0);
  }

  void tellsTasksAndGapsOnlyWhenTheyChange() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment());
    stored.addGenerations(run, 3);
    Watched watched;
    DatabaseWatcher& watcher = watched.watcher;
    watcher.open(stored.qpath());
    watched.follow(run);
    QSignalSpy tasks(&watcher, &DatabaseWatcher::tasksChanged), gaps(&watcher, &DatabaseWatcher::gapsChanged),
        versions(&watcher, &DatabaseWatcher::versionsChanged);
    stored.database.setProgress(run, "{}");
    watched.poll();
    QCOMPARE(tasks.count(), 0);  // a sheet that is being typed into must not be filled anew
    const auto drawn = stored.addTasks(run);
    watched.poll();
    QCOMPARE(tasks.count(), 1);
    const Id measurement = stored.measure(run, drawn.front().individual, 0.5);
    watched.poll();
    QCOMPARE(tasks.count(), 2);
    stored.database.setMeasurementVoid(measurement, true, "fell");
    watched.poll();
    QCOMPARE(tasks.count(), 3);
    stored.finishStage(run, {{"friction", 0.5}});
    watched.poll();
    QCOMPARE(gaps.count(), 1);
    QCOMPARE(versions.count(), 1);
    QCOMPARE(versions.last().last().value<std::vector<SimulatorRecord>>().size(), 2u);
  }

  void noticesThatAProcessBeginsAndEndsWithoutAnyWrite() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment());
    std::atomic<bool> works = false;
    Watched watched([&](const std::string&, Id) { return works.load(); });
    DatabaseWatcher& watcher = watched.watcher;
    watcher.open(stored.qpath());
    watched.follow(run);
    QSignalSpy active(&watcher, &DatabaseWatcher::activeChanged), changed(&watcher, &DatabaseWatcher::runChanged);
    works = true;
    watched.poll();
    QCOMPARE(active.count(), 1);
    QCOMPARE(changed.last().last().toBool(), true);
    QCOMPARE(watcher.activeRuns(), std::set<Id>{run});
    works = false;
    watched.poll();
    QCOMPARE(changed.last().last().toBool(), false);
    QVERIFY(watcher.activeRuns().empty());
  }

  void aProcessOfOursCountsAtOnce() {
    StoredRun stored;
    const Id run = stored.addRun(stored.addExperiment());
    DatabaseReader reader;
    bool ours = false;
    DatabaseWatcher watcher(
        reader, [](const std::string&, Id) { return false; }, [&](Id) { return ours; });
    watcher.open(stored.qpath());
    ours = true;
    watcher.poll();
    QCOMPARE(watcher.activeRuns(), std::set<Id>{run});
  }

  void whoAsksForALookIsToldWhenItIsTaken() {
    StoredRun stored;
    const Id experiment = stored.addExperiment();
    Watched watched;
    watched.watcher.open(stored.qpath());
    watched.watcher.poll();
    // Stored while a look is under way, which may have come too early.
    stored.addRun(experiment);
    std::size_t seen = 0;
    watched.watcher.poll([&] { seen = watched.watcher.runs().size(); });
    watched.reader.waitUntilIdle();
    QCOMPARE(seen, std::size_t(1));
  }

  void ofTwoRunsThatAreFollowedTheSecondIsTold() {
    StoredRun stored;
    const Id experiment = stored.addExperiment();
    const Id first = stored.addRun(experiment, 1), second = stored.addRun(experiment, 2);
    Watched watched;
    watched.watcher.open(stored.qpath());
    QSignalSpy told(&watched.watcher, &DatabaseWatcher::followedRun);
    watched.watcher.follow(first);
    watched.watcher.follow(second);
    watched.reader.waitUntilIdle();
    QCOMPARE(told.count(), 1);
    QCOMPARE(told.first().first().value<RunRecord>().id, second);
  }

  void keepsTheOldDatabaseWhenAnotherCannotBeOpened() {
    StoredRun stored;
    stored.addRun(stored.addExperiment());
    Watched watched;
    DatabaseWatcher& watcher = watched.watcher;
    watcher.open(stored.qpath());
    QVERIFY_THROWS_EXCEPTION(InputError, watcher.open(stored.folder.filePath("absent.db")));
    QCOMPARE(watcher.path(), stored.qpath());
    QCOMPARE(watcher.runs().size(), 1u);
  }
};

UI_TEST(TestDatabaseWatcher)
#include "test_database_watcher.moc"
