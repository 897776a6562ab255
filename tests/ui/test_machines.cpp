// Run, On several machines: jobs over ssh and of ranks are begun, followed, cancelled, resumed and collected through
// the real program. Machines are played by this one: what stands for ssh runs the command here.
#include <signal.h>

#include <QComboBox>
#include <QDialog>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSignalSpy>
#include <QStandardPaths>
#include <QTableWidget>
#include <QTemporaryDir>
#include <QTest>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/store/database.h"
#include "tests/ui/ui_tests.h"
#include "ui/cluster/job_status.h"
#include "ui/cluster/machines_dialog.h"
#include "ui/controllers/machines_controller.h"

using namespace btr;
using namespace btr::ui;
using nlohmann::json;

namespace {

constexpr int longest_ms = 120'000;

struct Bench {
  Bench() {
    const std::string source = SOURCE_DIR "/resources/experiments/kick-short.json";
    experiment = json::parse(readFile(source));
    experiment["scene"] = QDir(SOURCE_DIR "/resources/experiments")
                              .absoluteFilePath(QString::fromStdString(experiment["scene"]))
                              .toStdString();
    experiment["learner"]["settings"]["population"] = 6;
    experiment["adaptation"]["learner"]["settings"]["population"] = 4;
    experiment["adaptation"]["settings"]["generations"] = 1;
    order.database = folder.filePath("all.db");
    Database::open(order.database.toStdString(), Database::Mode::create);
    order.folder = folder.filePath("job");
    order.hosts = "lab1\n# the next one\nlab2\n";
    connectTold();
  }
  /// An experiment of so many generations, and a comparison of it alone with these seeds.
  void write(int generations, std::vector<int> seeds) {
    experiment["stages"]["first_generations"] = generations;
    experiment["stages"]["next_generations"] = 1;
    experiment["stages"]["total_generations"] = generations;
    experiment["stages"]["measured_individuals"] = 2;
    writeFile(file("kick.json").toStdString(), experiment.dump());
    const json comparison{{"format", "uchilsim-comparison-1"},
                          {"name", "c"},
                          {"seeds", seeds},
                          {"arms", json::array({{{"name", "a"}, {"experiment", "kick.json"}}})}};
    writeFile(file("c.json").toStdString(), comparison.dump());
    order.file = file("c.json");
  }
  QString file(const QString& name) const { return folder.filePath(name); }
  void connectTold() {
    QObject::connect(&controller, &MachinesController::told, &controller,
                     [this](const QString& sentence, bool isProblem) { (isProblem ? problems : told) << sentence; });
  }
  bool isOver() const { return controller.isKnown() && !controller.isGoing() && !controller.isAsked(); }

  QTemporaryDir folder;
  json experiment;
  MachinesOrder order;
  QStringList told, problems;
  MachinesController controller{BTR_PROGRAM};
};

/// Whether a process has been told to end and has not heard of it, as it is held.
bool isToldToEnd(pid_t process) {
  std::istringstream lines(readFile("/proc/" + std::to_string(process) + "/status"));
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("ShdPnd:")) return std::stoull(line.substr(7), nullptr, 16) >> (SIGTERM - 1) & 1;
  return false;
}

/// The process that works on an element, 0 while there is none.
pid_t workerOf(const QString& state) {
  return QFileInfo::exists(state) ? json::parse(readFile(state.toStdString())).value("process", 0) : 0;
}

/// What a process has begun, 0 for nothing.
pid_t childOf(pid_t process) {
  const std::string task = "/proc/" + std::to_string(process) + "/task/" + std::to_string(process) + "/children";
  return process > 0 ? std::atoi(readFile(task).c_str()) : 0;
}

bool has(const char* program) { return !QStandardPaths::findExecutable(program).isEmpty(); }

}  // namespace

class TestMachines : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase();
  void aStatusIsReadAndAnotherDocumentIsOneSentence();
  void whatCannotBeOrderedIsOneSentence();
  void aFolderThatIsNoJobIsOneSentence();
  void elementsOverSshAreDoneAndCollected();
  void aJobIsCancelledAndResumed();
  void aHostThatIsNotThereIsNamed();
  void elementsInSlurmsQueueAreDoneAndCollected();
  void aSlurmThatIsNotThereIsOneSentence();
  void ranksWorkOnAnExperiment();
  void whatKeepsRanksFromBeginningIsOneSentence();
  void theDialogShowsAJobAndFitsASmallScreen();

 private:
  QTemporaryDir machines_;
};

// "ssh -o X -o Y HOST COMMAND" runs the command here; a machine called "off" does not answer. Like sshd it names the
// shell of its user, which GNU parallel asks for.
void TestMachines::initTestCase() {
  const QString ssh = machines_.filePath("ssh");
  writeFile(ssh.toStdString(),
            "#!/bin/sh\nwhile [ \"${1#-}\" != \"$1\" ]; do case $1 in -o|-l|-p|-S|-i) shift;; esac; shift; done\n"
            "[ \"$1\" = off ] && { echo 'ssh: connect to host off: Connection refused' >&2; exit 255; }\n"
            "shift\n[ \"$1\" = -- ] && shift\ncd " +
                machines_.path().toStdString() + " && SHELL=/bin/sh && export SHELL && exec sh -c \"$*\"\n");
  QFile(ssh).setPermissions(QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
  qputenv("PARALLEL_SSH", ssh.toUtf8());
  qputenv("PARALLEL_HOME", machines_.path().toUtf8());
  qputenv("OMPI_MCA_plm_rsh_agent", ssh.toUtf8());
  qputenv("OMPI_ALLOW_RUN_AS_ROOT", "1");
  qputenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
}

void TestMachines::aStatusIsReadAndAnotherDocumentIsOneSentence() {
  const JobStatus status = arrayStatus(R"({"format": "uchilsim-array-status-1", "what": "grid", "into": "/a.db",
    "is_slurms": true, "is_worked_on_over_ssh": false, "share": 0.5, "seconds_left": 90, "trials_per_second": 12,
    "elements": [
      {"element": 1, "name": "one", "state": "done", "host": "lab1", "share": 1, "trials_per_second": 3, "note": ""},
      {"element": 2, "name": "two", "state": "failed", "host": "lab2", "share": 0, "note": "host lab2: disk full"},
      {"element": 3, "name": "three", "state": "not begun", "host": "", "share": 0, "note": ""}]})");
  QCOMPARE(status.what, QString("grid"));
  QCOMPARE(status.secondsLeft, 90.0);
  QCOMPARE(status.parts.size(), std::size_t(3));
  QCOMPARE(status.parts[1].note, QString("host lab2: disk full"));
  QCOMPARE(status.resumable(), 2);
  QVERIFY(!status.isGoing());
  const JobStatus ranks = placesStatus(R"({"format": "uchilsim-places-1", "stage": "L1", "share": 0.25,
    "hosts": [{"host": "lab1", "workers": 2, "pieces": 7, "trials": 70, "lost": 1, "worked_s": 14}]})",
                                       "places.json");
  QVERIFY(ranks.kind == JobStatus::Kind::ranks);
  QVERIFY(!status.areCases() && !ranks.areCases());
  QVERIFY(placesStatus(R"({"format": "uchilsim-places-1", "stage": "blind cases", "hosts": []})", "p").areCases());
  QCOMPARE(ranks.secondsLeft, -1.0);
  QCOMPARE(ranks.parts.front().lost, 1L);
  QCOMPARE(ranks.parts.front().trialsPerSecond, 10.0);
  for (const char* other : {"", "{}", "[1]", R"({"format": "uchilsim-array-status-9"})"})
    QVERIFY_THROWS_EXCEPTION(InputError, arrayStatus(other));
}

void TestMachines::whatCannotBeOrderedIsOneSentence() {
  Bench bench;
  bench.write(2, {1});
  QVERIFY(objectionTo(bench.order).isEmpty());
  const auto objection = [&](auto change) {
    MachinesOrder order = bench.order;
    change(order);
    return objectionTo(order);
  };
  QVERIFY(objection([](MachinesOrder& o) { o.file = ""; }).contains("Choose"));
  QVERIFY(objection([](MachinesOrder& o) { o.file = "/no/where.json"; }).contains("/no/where.json is not there"));
  QVERIFY(objection([](MachinesOrder& o) { o.file = o.database; }).contains("a comparison, a grid or an experiment"));
  QVERIFY(objection([&](MachinesOrder& o) { o.file = bench.file("kick.json"); }).contains("ranks of MPI"));
  QVERIFY(objection([](MachinesOrder& o) { o.database = ""; }).contains("database"));
  QVERIFY(objection([&](MachinesOrder& o) { o.folder = bench.folder.path(); }).contains("holds something"));
  QVERIFY(objection([](MachinesOrder& o) { o.folder = o.file; }).contains("is a file"));
  QVERIFY(objection([](MachinesOrder& o) { o.hosts = " \n# none\n"; }).contains("computers"));
  MachinesOrder ranks = bench.order;
  ranks.way = MachinesOrder::Way::ranks;
  ranks.file = bench.file("kick.json");
  ranks.hosts.clear();
  QVERIFY(objectionTo(ranks).isEmpty());
  bench.order.hosts.clear();
  QVERIFY(!bench.controller.start(bench.order));
  QCOMPARE(bench.problems.size(), 1);
  QVERIFY(bench.controller.folder().isEmpty());
}

void TestMachines::aFolderThatIsNoJobIsOneSentence() {
  Bench bench;
  bench.controller.open(bench.folder.path());
  QTRY_COMPARE_WITH_TIMEOUT(bench.problems.size(), 1, longest_ms);
  QVERIFY2(bench.problems.first().contains("no job.json in it"), qPrintable(bench.problems.first()));
  QVERIFY(!bench.problems.first().contains('\n'));
  QVERIFY(!bench.controller.isKnown() && !bench.controller.isGoing());
}

void TestMachines::elementsOverSshAreDoneAndCollected() {
  if (!has("parallel") || !has("rsync")) QSKIP("parallel or rsync is not installed");
  Bench bench;
  bench.write(2, {1, 2, 3});
  QVERIFY(bench.controller.start(bench.order));
  QTRY_VERIFY_WITH_TIMEOUT(bench.isOver() && bench.controller.status().count("done") == 3, longest_ms);
  const JobStatus& status = bench.controller.status();
  QCOMPARE(status.share, 1.0);
  QCOMPARE(status.parts[2].name, QString("a, seed 3"));
  QVERIFY(!status.parts[2].host.isEmpty());
  QCOMPARE(status.into, bench.order.database);
  QSignalSpy collected(&bench.controller, &MachinesController::collected);
  bench.controller.collect();
  QVERIFY(collected.wait(longest_ms));
  QVERIFY2(bench.told.join('\n').contains("3 elements collected"), qPrintable(bench.told.join('\n')));
  QCOMPARE(bench.problems, QStringList());
  QCOMPARE(Database::open(bench.order.database.toStdString(), Database::Mode::readOnly).runs().size(), std::size_t(3));
}

void TestMachines::aJobIsCancelledAndResumed() {
  if (!has("parallel") || !has("rsync")) QSKIP("parallel or rsync is not installed");
  Bench bench;
  bench.write(20, {1, 2});
  bench.order.hosts = "lab1";
  QVERIFY(bench.controller.start(bench.order));
  // The first element is held in its work, so that it cannot end before it is cancelled.
  pid_t worker = 0, work = 0;
  QTRY_VERIFY_WITH_TIMEOUT((work = childOf(worker = workerOf(bench.order.folder + "/1.json"))) > 0, longest_ms);
  QCOMPARE(::kill(work, SIGSTOP), 0);
  QCOMPARE(::kill(worker, SIGSTOP), 0);
  QTRY_VERIFY_WITH_TIMEOUT(bench.controller.isKnown() && bench.controller.status().count("running") == 1, longest_ms);
  QVERIFY(bench.controller.isGoing());
  bench.controller.cancel();
  QTRY_VERIFY_WITH_TIMEOUT(isToldToEnd(worker), longest_ms);
  QCOMPARE(::kill(worker, SIGCONT), 0);
  QTRY_VERIFY_WITH_TIMEOUT(isToldToEnd(work), longest_ms);
  QCOMPARE(::kill(work, SIGCONT), 0);
  QTRY_VERIFY_WITH_TIMEOUT(bench.isOver() && bench.controller.status().count("running") == 0, longest_ms);
  QCOMPARE(bench.controller.status().resumable(), 2);
  QVERIFY(bench.controller.status().parts[0].share < 1);
  // Another window opens it, and goes on with what is missing.
  Bench other;
  other.controller.open(bench.order.folder);
  QTRY_VERIFY_WITH_TIMEOUT(other.isOver(), longest_ms);
  QCOMPARE(other.controller.hosts(), QString("1/lab1"));
  other.controller.resume(other.controller.hosts());
  QTRY_VERIFY_WITH_TIMEOUT(other.isOver() && other.controller.status().count("done") == 2, longest_ms);
  QCOMPARE(other.problems, QStringList());
}

void TestMachines::aHostThatIsNotThereIsNamed() {
  if (!has("parallel") || !has("rsync")) QSKIP("parallel or rsync is not installed");
  Bench bench;
  bench.write(1, {1});
  bench.order.hosts = "off";
  QVERIFY(bench.controller.start(bench.order));
  QTRY_VERIFY_WITH_TIMEOUT(bench.isOver(), longest_ms);
  QCOMPARE(bench.problems.size(), 1);
  QVERIFY2(bench.problems.last().contains("no host that can be used"), qPrintable(bench.problems.last()));
  QCOMPARE(bench.controller.status().count("not begun"), 1);
}

// In a Slurm that tests/cluster/slurm_window.sh starts, and says so.
void TestMachines::elementsInSlurmsQueueAreDoneAndCollected() {
  if (!qEnvironmentVariableIsSet("UCHILSIM_TEST_SLURM")) QSKIP("no Slurm was started: tests/cluster/slurm_window.sh");
  Bench bench;
  bench.write(2, {1, 2});
  bench.order.way = MachinesOrder::Way::slurm;
  bench.order.hosts.clear();
  bench.order.options = "--partition=all --time=10";
  MachinesDialog dialog(bench.controller, [&] { return bench.order.database; });
  dialog.show();
  QVERIFY(bench.controller.start(bench.order));
  QTRY_VERIFY_WITH_TIMEOUT(bench.isOver() && bench.controller.status().count("done") == 2, longest_ms);
  QVERIFY2(bench.told.join('\n').contains("in Slurm's queue"), qPrintable(bench.told.join('\n')));
  const JobStatus& status = bench.controller.status();
  QVERIFY(status.isSlurms);
  QCOMPARE(status.share, 1.0);
  QVERIFY(!status.parts[1].host.isEmpty());
  QVERIFY(dialog.findChild<QLabel*>("machines.job")->text().contains("2 elements, 2 done, 0 running, 0 failed"));
  QSignalSpy collected(&bench.controller, &MachinesController::collected);
  bench.controller.collect();
  QVERIFY(collected.wait(longest_ms));
  QVERIFY2(bench.told.join('\n').contains("2 elements collected"), qPrintable(bench.told.join('\n')));
  QCOMPARE(bench.problems, QStringList());
  QCOMPARE(Database::open(bench.order.database.toStdString(), Database::Mode::readOnly).runs().size(), std::size_t(2));
}

void TestMachines::aSlurmThatIsNotThereIsOneSentence() {
  Bench bench;
  bench.write(1, {1});
  writeFile(bench.file("empty.conf").toStdString(), "");  // for one that is missing, sbatch waits a minute
  qputenv("SLURM_CONF", bench.file("empty.conf").toUtf8());
  bench.order.way = MachinesOrder::Way::slurm;
  QVERIFY(bench.controller.start(bench.order));
  QTRY_VERIFY_WITH_TIMEOUT(!bench.problems.isEmpty(), longest_ms);
  QVERIFY2(bench.problems.first().contains("sbatch"), qPrintable(bench.problems.first()));
  QVERIFY(!bench.problems.first().contains('\n'));
}

void TestMachines::ranksWorkOnAnExperiment() {
  if (!has("mpirun")) QSKIP("mpirun is not installed");
  Bench bench;
  bench.write(3, {1});
  bench.order.way = MachinesOrder::Way::ranks;
  bench.order.file = bench.file("kick.json");
  bench.order.hosts.clear();
  QVERIFY(bench.controller.start(bench.order));
  QTRY_VERIFY_WITH_TIMEOUT(bench.isOver(), longest_ms);
  QVERIFY2(bench.problems.isEmpty(), qPrintable(bench.problems.join('\n')));
  const JobStatus& status = bench.controller.status();
  QVERIFY(status.kind == JobStatus::Kind::ranks);
  QCOMPARE(status.share, 1.0);
  QCOMPARE(status.parts.size(), std::size_t(1));  // both on this machine
  QCOMPARE(status.parts.front().workers, 2);
  QVERIFY(status.parts.front().trials > 0);
  QCOMPARE(Database::open(bench.order.database.toStdString(), Database::Mode::readOnly).runs().front().generation, 3);
}

void TestMachines::whatKeepsRanksFromBeginningIsOneSentence() {
  if (!has("mpirun")) QSKIP("mpirun is not installed");
  Bench bench;
  bench.write(3, {1});
  bench.order.way = MachinesOrder::Way::ranks;
  bench.order.file = bench.file("kick.json");
  bench.order.hosts = "2/off";
  QVERIFY(bench.controller.start(bench.order));
  QTRY_VERIFY_WITH_TIMEOUT(!bench.controller.isGoing() && !bench.problems.isEmpty(), longest_ms);
  for (const QString& problem : bench.problems)
    QVERIFY2(!problem.contains('\n') && !problem.contains("----"), qPrintable(problem));
  QVERIFY2(bench.problems.first().contains("off"), qPrintable(bench.problems.first()));
  QVERIFY(!bench.controller.isKnown());
}

void TestMachines::theDialogShowsAJobAndFitsASmallScreen() {
  Bench bench;
  bench.write(1, {1});
  MachinesDialog dialog(bench.controller, [&] { return bench.order.database; });
  dialog.show();
  const auto button = [&](const char* name) { return dialog.findChild<QPushButton*>(name); };
  auto* message = dialog.findChild<QLabel*>("machines.message");
  for (int way = 0; way < 3; ++way) {
    dialog.findChild<QComboBox*>("machines.way")->setCurrentIndex(way);
    const QSize least = dialog.minimumSizeHint();
    QVERIFY2(least.width() <= 1200 && least.height() <= 660,
             qPrintable(QString("%1 x %2").arg(least.width()).arg(least.height())));
    for (const QPushButton* each : dialog.findChildren<QPushButton*>()) {
      QVERIFY2(each->width() >= each->sizeHint().width(), qPrintable(each->text()));
      QVERIFY2(each->focusPolicy() & Qt::TabFocus, qPrintable(each->text()));
    }
  }
  // An underlined letter leads to a field; no label shows its "&".
  for (const QLabel* each : dialog.findChildren<QLabel*>())
    QVERIFY2(each->buddy() || !each->text().contains('&'), qPrintable(each->text()));
  for (const char* name : {"machines.cancel", "machines.resume", "machines.collect"})
    QVERIFY(!button(name)->isEnabled());
  button("machines.start")->click();
  QVERIFY(message->isVisible() && message->text().contains("Choose"));
  dialog.setFile(bench.order.file);
  QCOMPARE(dialog.findChild<QLineEdit*>("machines.folder")->text(), bench.file("c-job"));

  // A job that nobody works on: one element is done, the other is said to run.
  QDir().mkpath(bench.order.folder);
  const json job{{"format", "uchilsim-array-1"},
                 {"what", "compare"},
                 {"into", bench.order.database.toStdString()},
                 {"program", "/bin/true"},
                 {"workers", 1},
                 {"elements", json::array({{{"name", "a, seed 1"}, {"arguments", json::array()}},
                                           {{"name", "a, seed 2"}, {"arguments", json::array()}}})},
                 {"build", json::array()},
                 {"queue_ids", json::array()}};
  writeFile((bench.order.folder + "/job.json").toStdString(), job.dump());
  writeFile((bench.order.folder + "/1.json").toStdString(),
            R"({"state": "done", "host": "lab1", "share": 1, "note": ""})");
  writeFile(
      (bench.order.folder + "/2.json").toStdString(),
      R"({"state": "failed", "host": "lab2", "share": 0.5, "note": "host lab2: element.db: cannot be written: No space left on device"})");
  bench.controller.open(bench.order.folder);
  QTRY_VERIFY_WITH_TIMEOUT(bench.controller.isKnown(), longest_ms);
  const auto* parts = dialog.findChild<QTableWidget*>("machines.parts");
  QCOMPARE(parts->rowCount(), 2);
  QCOMPARE(parts->item(0, 1)->text(), QString("done"));
  QCOMPARE(parts->item(1, 2)->text(), QString("50.0 %"));
  QVERIFY(parts->item(1, 5)->text().contains("No space left"));
  QVERIFY(dialog.findChild<QLabel*>("machines.job")->text().contains("2 elements, 1 done, 0 running, 1 failed"));
  QVERIFY(!button("machines.cancel")->isEnabled());
  QVERIFY(button("machines.resume")->isEnabled() && button("machines.collect")->isEnabled());

  // A blind trial counts cases.
  QCOMPARE(parts->horizontalHeaderItem(4)->text(), QString("Trials/s"));
  json trial = job;
  trial["what"] = "gap prove";
  writeFile((bench.order.folder + "/job.json").toStdString(), trial.dump());
  bench.controller.open(bench.order.folder);
  QTRY_COMPARE_WITH_TIMEOUT(parts->horizontalHeaderItem(4)->text(), QString("Cases/h"), longest_ms);
}

UI_TEST(TestMachines)
#include "test_machines.moc"
