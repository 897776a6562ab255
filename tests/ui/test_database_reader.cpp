// Questions to a database are answered from another thread; nobody waits in the window's.
#include <QSemaphore>
#include <QSignalSpy>
#include <QTest>
#include <QThread>
#include <atomic>

#include "core/spec/error.h"
#include "tests/ui/locked_database.h"
#include "tests/ui/stored_run.h"
#include "tests/ui/ui_tests.h"
#include "ui/common/database/database_reader.h"

using namespace btr;
using namespace btr::ui;

namespace {
std::size_t countRuns(const Database& database) { return database.runs().size(); }
}  // namespace

class TestDatabaseReader : public QObject {
  Q_OBJECT
 private slots:
  void theQueryRunsElsewhereAndTheAnswerComesHere() {
    StoredRun stored;
    stored.addRun(stored.addExperiment());
    DatabaseReader reader;
    reader.open(stored.qpath(), Database::Mode::readOnly);
    QCOMPARE(reader.path(), stored.qpath());
    QThread *asked = nullptr, *answered = nullptr;
    std::size_t runs = 0;
    reader.read(
        this, "runs", "the runs",
        [&](const Database& database) { return asked = QThread::currentThread(), countRuns(database); },
        [&](std::size_t count) {
          answered = QThread::currentThread();
          runs = count;
        });
    QCOMPARE(runs, std::size_t(0));
    QVERIFY(!reader.isIdle());
    reader.waitUntilIdle();
    QCOMPARE(runs, std::size_t(1));
    QVERIFY(asked != QThread::currentThread());
    QCOMPARE(answered, QThread::currentThread());
  }

  void whoMayWriteGetsTheConnectionThatMadeTheFile() {
    QTemporaryDir folder;
    DatabaseReader reader;
    auto writer = reader.open(folder.filePath("new.db"), Database::Mode::create);
    QVERIFY(writer);
    writer->addExperiment({0, "Kick", "{}", "", ""});
    std::size_t found = 0;
    reader.read(
        this, "x", "x", [](const Database& d) { return d.experiments().size(); }, [&](std::size_t n) { found = n; });
    reader.waitUntilIdle();
    QCOMPARE(found, std::size_t(1));
    QVERIFY(!reader.open(folder.filePath("new.db"), Database::Mode::readOnly));
  }

  // The first is being read while the second is asked: it would come later than what has replaced it.
  void aLateAnswerNeverReplacesANewerOne() {
    StoredRun stored;
    DatabaseReader reader;
    reader.open(stored.qpath(), Database::Mode::readOnly);
    QSemaphore begun, goOn;
    QList<int> answers;
    reader.read(
        this, "number", "x",
        [&](const Database&) {
          begun.release();
          goOn.acquire();
          return 1;
        },
        [&](int number) { answers << number; });
    begun.acquire();
    std::atomic<bool> wasRead = false;
    reader.read(
        this, "number", "x", [&](const Database&) { return wasRead = true, 2; }, [&](int n) { answers << n; });
    reader.read(
        this, "number", "x", [](const Database&) { return 3; }, [&](int n) { answers << n; });
    reader.read(
        this, "another", "x", [](const Database&) { return 4; }, [&](int n) { answers << n; });
    goOn.release();
    reader.waitUntilIdle();
    QCOMPARE(answers, (QList<int>{3, 4}));
    QVERIFY(!wasRead);  // nobody waited for it any more
  }

  void whoIsGoneIsNotAnswered() {
    StoredRun stored;
    DatabaseReader reader;
    reader.open(stored.qpath(), Database::Mode::readOnly);
    int answers = 0;
    auto receiver = std::make_unique<QObject>();
    reader.read(receiver.get(), "x", "x", countRuns, [&](std::size_t) { ++answers; });
    receiver.reset();
    reader.waitUntilIdle();
    QCOMPARE(answers, 0);
  }

  void whatIsAskedByAnAnswerIsWaitedForToo() {
    StoredRun stored;
    DatabaseReader reader;
    reader.open(stored.qpath(), Database::Mode::readOnly);
    bool second = false;
    reader.read(this, "first", "x", countRuns,
                [&](std::size_t) { reader.read(this, "second", "x", countRuns, [&](std::size_t) { second = true; }); });
    reader.waitUntilIdle();
    QVERIFY(second);
  }

  void whatCannotBeReadIsAMessage() {
    StoredRun stored;
    DatabaseReader reader;
    reader.open(stored.qpath(), Database::Mode::readOnly);
    QSignalSpy failed(&reader, &DatabaseReader::failed);
    const auto unknown = [](const Database& database) { return database.run(7); };
    const auto nobody = [](const RunRecord&) { QFAIL("there is no such run"); };
    reader.read(this, "a", "x", unknown, nobody);
    reader.waitUntilIdle();
    QCOMPARE(failed.count(), 1);
    QVERIFY(failed.first().first().toString().contains("test.db"));
    QString why;
    reader.read(this, "a", "x", unknown, nobody, [&](const QString& text) { why = text; });
    reader.waitUntilIdle();
    QCOMPARE(failed.count(), 1);
    QVERIFY(why.contains("run 7") || why.contains("7"));
    // And what an answer cannot be used for.
    reader.read(this, "a", "x", countRuns, [](std::size_t) { throw InputError("no such plugin"); });
    reader.waitUntilIdle();
    QCOMPARE(failed.last().first().toString(), QString("no such plugin"));
  }

  void aFileThatCannotBeOpenedLeavesTheOldOne() {
    StoredRun stored;
    stored.addRun(stored.addExperiment());
    DatabaseReader reader;
    reader.open(stored.qpath(), Database::Mode::readOnly);
    QVERIFY_THROWS_EXCEPTION(InputError, reader.open(stored.folder.filePath("absent.db"), Database::Mode::readOnly));
    QCOMPARE(reader.path(), stored.qpath());
    std::size_t runs = 0;
    reader.read(this, "x", "x", countRuns, [&](std::size_t count) { runs = count; });
    reader.waitUntilIdle();
    QCOMPARE(runs, std::size_t(1));
  }

  void whatTakesLongIsSaidUntilItIsThere() {
    StoredRun stored;
    DatabaseReader reader;
    reader.open(stored.qpath(), Database::Mode::readOnly);
    QSemaphore goOn;
    QList<QStringList> said;
    connect(&reader, &DatabaseReader::waiting, this, [&](const QStringList& what) {
      said << what;
      if (!what.isEmpty()) goOn.release();
    });
    reader.read(
        this, "x", "the runs", [&](const Database&) { return goOn.acquire(), 1; }, [](int) {});
    reader.waitUntilIdle();
    QCOMPARE(said, (QList<QStringList>{{"the runs"}, {}}));
  }

  // Another process keeps the file to itself: the window's events go on.
  void theEventLoopTurnsWhileTheDatabaseIsLocked() {
    LockedDatabase stored;
    DatabaseReader reader;
    reader.open(stored.qpath(), Database::Mode::readOnly);
    stored.lock();
    std::size_t runs = 0;
    reader.read(this, "x", "x", countRuns, [&](std::size_t count) { runs = count; });
    int turns = 0;
    QTimer timer;
    connect(&timer, &QTimer::timeout, this, [&] { ++turns; });
    timer.start(0);
    while (turns < 50) QCoreApplication::processEvents(QEventLoop::WaitForMoreEvents);
    QVERIFY(!reader.isIdle());
    stored.unlock();
    reader.waitUntilIdle();
    QCOMPARE(runs, stored.runs());
  }

  // The lock is still held when it is gone.
  void itEndsWhileAQuestionIsUnderWay() {
    LockedDatabase stored;
    int answers = 0;
    {
      DatabaseReader reader;
      reader.open(stored.qpath(), Database::Mode::readOnly);
      stored.lock();
      QSemaphore begun;
      const auto read = [&](const Database& database) { return begun.release(), countRuns(database); };
      reader.read(
          this, "a", "x", read, [&](std::size_t) { ++answers; }, [&](const QString&) { ++answers; });
      reader.read(
          this, "b", "x", read, [&](std::size_t) { ++answers; }, [&](const QString&) { ++answers; });
      begun.acquire();
    }
    QCoreApplication::processEvents();
    QCOMPARE(answers, 0);
  }
};

UI_TEST(TestDatabaseReader)
#include "test_database_reader.moc"
