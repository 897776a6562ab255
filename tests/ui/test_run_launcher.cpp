// Storing, duplicating, exporting and importing through the real program, beside the window.
#include <QDir>
#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>

#include "core/store/database.h"
#include "tests/ui/ui_tests.h"
#include "ui/experiment/run_launcher.h"

using namespace btr;
using namespace btr::ui;

namespace {

constexpr int longest_ms = 60000;

struct Bench {
  Bench() : database(Database::open(path.toStdString(), Database::Mode::create)) {}
  Id stored(quint64 seed) {
    QSignalSpy spy(&launcher, &RunLauncher::stored);
    launcher.store(path, loadExperiment(SOURCE_DIR "/resources/experiments/kick-short.json"), seed, false);
    return spy.wait(longest_ms) ? spy.first().first().value<Id>() : 0;
  }
  QTemporaryDir folder;
  QString path = folder.filePath("runs.db");
  Database database;
  RunLauncher launcher{std::make_shared<const PluginHost>(PLUGIN_DIR), BTR_PROGRAM};
};

}  // namespace

class TestRunLauncher : public QObject {
  Q_OBJECT
 private slots:
  void storesARunOnceForTheSameExperimentAndSeed() {
    Bench bench;
    const Id run = bench.stored(3);
    QVERIFY(run > 0);
    QCOMPARE(bench.database.run(run).seed, std::uint64_t(3));
    QCOMPARE(bench.stored(3), run);
    QVERIFY(bench.stored(4) != run);
  }

  void duplicatesARunWithAnotherSeedFromTheDatabaseAlone() {
    Bench bench;
    const Id run = bench.stored(3);
    QSignalSpy spy(&bench.launcher, &RunLauncher::stored);
    bench.launcher.duplicate(bench.path, run, 9);
    QVERIFY(spy.wait(longest_ms));
    const RunRecord copy = bench.database.run(spy.first().first().value<Id>()), old = bench.database.run(run);
    QCOMPARE(copy.seed, std::uint64_t(9));
    QCOMPARE(copy.experiment, old.experiment);
    QCOMPARE(copy.sceneJson, old.sceneJson);
    QCOMPARE(copy.specSha256, old.specSha256);
    QCOMPARE(copy.files.size(), old.files.size());
    QVERIFY(bench.database.simulators(copy.id).front().simulator == bench.database.simulators(run).front().simulator);
  }

  void anEditedExperimentIsNamedWithWhatWasChanged() {
    Bench bench;
    bench.stored(3);
    QSignalSpy remarked(&bench.launcher, &RunLauncher::remarked), stored(&bench.launcher, &RunLauncher::stored);
    ExperimentSpec spec = loadExperiment(SOURCE_DIR "/resources/experiments/kick-short.json");
    spec.learner.settings["population"] = 12;
    bench.launcher.store(bench.path, spec, 3, false);
    QVERIFY(stored.wait(longest_ms));
    QCOMPARE(remarked.size(), 1);
    QVERIFY(remarked.first().first().toString().contains("learner.settings.population (30, now 12)"));
  }

  void aBackupHoldsWhatTheDatabaseHolds() {
    Bench bench;
    const Id run = bench.stored(3);
    QSignalSpy spy(&bench.launcher, &RunLauncher::backedUp);
    const QString file = bench.folder.filePath("copy.db");
    bench.launcher.backUp(bench.path, file);
    QVERIFY(spy.wait(longest_ms));
    QCOMPARE(Database::open(file.toStdString(), Database::Mode::readOnly).run(run).seed, std::uint64_t(3));
  }

  void aSceneThatIsNotThereIsAMessageAndStoresNothing() {
    Bench bench;
    ExperimentSpec spec = loadExperiment(SOURCE_DIR "/resources/experiments/kick-short.json");
    spec.scene = "absent.json";
    QSignalSpy failed(&bench.launcher, &RunLauncher::failed);
    bench.launcher.store(bench.path, spec, 1, false);
    QVERIFY(failed.wait(longest_ms));
    QVERIFY(failed.first().first().toString().contains("absent.json"));
    QVERIFY(bench.database.runs().empty());
  }

  void exportsATableAndSaysWhatIsWrongWithAnImport() {
    Bench bench;
    const Id run = bench.stored(1);
    const QString table = bench.folder.filePath("simulators.csv");
    QSignalSpy exported(&bench.launcher, &RunLauncher::exported), failed(&bench.launcher, &RunLauncher::failed);
    bench.launcher.exportCsv(bench.path, run, "simulators", table);
    QVERIFY(exported.wait(longest_ms));
    QFile file(table);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QCOMPARE(file.readAll().count('\n'), 2);  // names and version 0

    bench.launcher.importFitness(bench.path, run, bench.folder.filePath("absent.csv"));
    QVERIFY(failed.wait(longest_ms));
    QVERIFY2(failed.first().first().toString().contains("absent.csv"), qPrintable(failed.first().first().toString()));
  }

  void whatLearnsLetsTheWindowGoFirst() {
    const QTemporaryDir folder;
    const QString program = folder.filePath("btr"), said = folder.filePath("nice");
    QFile script(program);
    QVERIFY(script.open(QIODevice::WriteOnly));
    script.write("#!/bin/sh\nnice > " + said.toUtf8() + ".part\nmv " + said.toUtf8() + ".part " + said.toUtf8() + "\n");
    script.setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
    script.close();
    RunLauncher launcher{std::make_shared<const PluginHost>(PLUGIN_DIR), program};
    QVERIFY(launcher.work(folder.filePath("runs.db"), 1, 0));
    QTRY_VERIFY_WITH_TIMEOUT(QFile::exists(said), longest_ms);
    QFile file(said);
    QVERIFY(file.open(QIODevice::ReadOnly));
    QVERIFY(file.readAll().trimmed().toInt() >= 10);
  }

  void theLogOfAStartedRunGoesWithTheLauncher() {
    const auto logs = [] {
      return QDir::temp().entryList({QStringLiteral("uchilsim-%1-run-*.log").arg(QCoreApplication::applicationPid())});
    };
    QVERIFY(logs().isEmpty());
    {
      Bench bench;
      const Id run = bench.stored(1);
      QVERIFY(bench.launcher.work(bench.folder.filePath("absent.db"), run, 1));
      QTRY_VERIFY_WITH_TIMEOUT(!bench.launcher.isAlive(run), longest_ms);
      QVERIFY(bench.launcher.lastWords(run).contains("absent.db"));
      QCOMPARE(logs().size(), 1);
    }
    QVERIFY(logs().isEmpty());
  }
};

UI_TEST(TestRunLauncher)
#include "test_run_launcher.moc"
