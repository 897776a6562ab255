// How long the window does not answer: `bench_window DATABASE [--seconds S] [--stacks MS]` opens a copy of the database
// (see bench_database), goes through its pages, then learns and analyses at full speed beside it, and prints the
// longest freeze of each part. With --stacks it says what the window did in freezes above MS. `bench_window DATABASE
// --pictures` instead counts the pictures of the 3D view in a second: six dogs that walk on the field of 2004, in a
// window of 1280 × 720, with and without shadows.
#include <sys/resource.h>

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QEventLoop>
#include <QTableView>
#include <QTemporaryDir>
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <thread>

#include "core/run/loop/back_to_reality.h"
#include "core/run/setup/prepared_experiment.h"
#include "core/spec/error.h"
#include "core/spec/experiment_spec.h"
#include "tests/bench/heartbeat.h"
#include "ui/charts/compare_page.h"
#include "ui/common/look/theme.h"
#include "ui/controllers/run_controller.h"
#include "ui/database/individuals_model.h"
#include "ui/database/individuals_table.h"
#include "ui/gap/analysis_process.h"
#include "ui/gap/gap_page.h"
#include "ui/live/live_page.h"
#include "ui/live/live_world.h"
#include "ui/main_window.h"

using namespace btr;
using namespace btr::ui;

namespace {

struct Options {
  QString database;
  double seconds = 20, stacks_ms = 0;
  bool pictures = false;
};

/// Counts what a widget paints.
struct PaintCounter : QObject {
  long paints = 0;
  bool eventFilter(QObject*, QEvent* event) override {
    if (event->type() == QEvent::Paint) ++paints;
    return false;
  }
};

double processorTime_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto of = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
  return of(usage.ru_utime) + of(usage.ru_stime);
}

class Bench {
 public:
  Bench(const Options& options, QApplication& application)
      : seconds_(options.seconds), theme_(application), copy_(folder_.filePath("copy.db")) {
    std::filesystem::copy_file(options.database.toStdString(), copy_.toStdString());
    windowOptions_.settingsFile = folder_.filePath("settings.ini");
    windowOptions_.program = BTR_PROGRAM;
    windowOptions_.isActive = isRunActive;
    if (options.stacks_ms > 0) witness_ = std::make_unique<bench::FreezeWitness>(heart_, options.stacks_ms);
    if (!options.pictures) std::printf("%-66s %10s %10s %10s\n", "part", "took ms", "freeze ms", "busy ms");
  }

  void all() {
    window_ = std::make_unique<MainWindow>(host_, theme_, windowOptions_);
    window_->resize(1600, 1000);
    window_->show();
    turn(1);
    part("opening the database", [&] { window_->openDatabase(copy_); });
    part("its first run, all pages read", [&] { settle(); });
    part("nothing to do", [&] { turn(2); });
    pages();
    learnFast();
    learn();
    analyse();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("Peak memory of the window's process %.0f MB.\n", 1024e-6 * static_cast<double>(usage.ru_maxrss));
    window_.reset();
  }

  void pictures() {
    window_ = std::make_unique<MainWindow>(host_, theme_, windowOptions_);
    window_->resize(1280, 720);
    window_->show();
    window_->openDatabase(copy_);
    window_->openScene(SOURCE_DIR "/resources/games/two-walkers-2004.json");
    auto* page = window_->findChild<LivePage*>();
    for (int wait = 0; wait < 300 && page->row().values.empty(); ++wait) turn(0.1);
    GameController walk;
    walk.plugin = "walk";
    walk.settings["duration_s"] = 600;
    for (const RobotSpec& robot : page->game().scene.robots) page->world().act(ControllerAct{robot.name, walk});
    page->process().play(true);
    turn(3);
    LiveView& view = page->view();
    for (const bool shadows : {true, false, true, false}) {
      for (QAction* action : view.viewActions())
        if (action->text().startsWith("Shadows") && action->isChecked() != shadows) action->trigger();
      turn(0.5);
      PaintCounter counter;
      view.installEventFilter(&counter);
      const double from = processorTime_s(), begin = bench::Heartbeat::wall_ms();
      turn(seconds_ / 4);
      const double took_s = 1e-3 * (bench::Heartbeat::wall_ms() - begin), used_s = processorTime_s() - from;
      view.removeEventFilter(&counter);
      std::printf("%d x %d, %-15s %6.1f pictures/s, %5.1f ms of processor time each, world at %.2f of real time\n",
                  view.width(), view.height(), shadows ? "shadows" : "no shadows", double(counter.paints) / took_s,
                  1e3 * used_s / double(std::max(1L, counter.paints)), page->row().realTimeFactor);
      std::fflush(stdout);
    }
    window_.reset();
  }

 private:
  void part(const char* name, const std::function<void()>& work) {
    if (witness_) std::fprintf(stderr, "PART %s\n", name);
    heart_.begin();
    const double begin = bench::Heartbeat::wall_ms();
    work();
    const bench::Heartbeat::Freeze longest = heart_.longest();
    std::printf("%-66s %10.0f %10.1f %10.1f\n", name, bench::Heartbeat::wall_ms() - begin, longest.pause_ms,
                longest.busy_ms);
    std::fflush(stdout);
  }
  void turn(double seconds) {
    QEventLoop loop;
    QTimer::singleShot(static_cast<int>(1e3 * seconds), &loop, &QEventLoop::quit);
    loop.exec();
  }
  void settle() {
    QCoreApplication::processEvents();
    window_->bench().reader().waitUntilIdle();
  }

  void pages() {
    part("another run: form, charts, versions, 5000 individuals", [&] {
      window_->selectRun(window_->bench().watcher().runs().front().id);
      settle();
    });
    auto* table = window_->findChild<IndividualsTable*>();
    QTableView* view = nullptr;
    for (QTableView* found : table->findChildren<QTableView*>())
      if (found->model()->columnCount() == IndividualsModel::columns) view = found;
    part("its individuals sorted by fitness", [&] {
      view->sortByColumn(IndividualsModel::fitness, Qt::DescendingOrder);
      settle();
    });
    const QList<QCheckBox*> boxes = table->findChildren<QCheckBox*>();
    part("its individuals, each chromosome once", [&] {
      boxes.front()->setChecked(true);
      settle();
    });
    boxes.front()->setChecked(false);
    part("ten runs compared", [&] {
      std::vector<Id> ten;
      for (const RunRecord& run : window_->bench().watcher().runs())
        if (ten.size() < 10) ten.push_back(run.id);
      window_->compareRuns(ten);
      settle();
      turn(0.5);
    });
  }

  Id newRun(const char* experiment) {
    const ExperimentSpec spec = loadExperiment((std::string(SOURCE_DIR "/resources/experiments/") + experiment));
    Database database = Database::open(copy_.toStdString(), Database::Mode::readWrite);
    return startRun(database, *host_, spec, 4711);
  }

  // Twenty generations a second, more than any simulation gives.
  void learnFast() {
    const Id run = newRun("kick-short.json");
    window_->bench().watcher().poll();
    settle();
    window_->selectRun(run);
    settle();
    std::atomic<bool> over = false;
    std::thread writer([&] {
      Database database = Database::open(copy_.toStdString(), Database::Mode::readWrite);
      const GenerationRecord pattern = *database.lastGeneration(1);
      const Id simulator = database.latestSimulator(run).id;
      for (int number = 1; !over; ++number) {
        GenerationRecord generation = pattern;
        generation.run = run;
        generation.number = number;
        generation.simulator = simulator;
        for (IndividualRecord& individual : generation.individuals) {
          individual.id = individual.sameAs = individual.simulator = 0;
          individual.fitness += 0.01 * number;
        }
        database.addGeneration(generation);
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
      }
    });
    part("a run that stores 20 generations a second, followed", [&] { turn(seconds_); });
    over = true;
    writer.join();
    settle();
  }

  void learn() {
    const Id run = newRun("kick-stand-in.json");
    window_->bench().watcher().poll();
    settle();
    window_->selectRun(run);
    settle();
    part("learning at full speed (a kick, all processors)", [&] {
      window_->runs().resume(run);
      turn(seconds_);
    });
    window_->runs().stop(run);
    for (int wait = 0; wait < 100 && window_->bench().launcher().isAlive(run); ++wait) turn(0.1);
    settle();
  }

  void analyse() {
    window_->showPage("analysis");
    turn(1);
    const QString recordings = SOURCE_DIR "/resources/recordings/xl330-made/";
    AnalysisJob job;
    job.scene = SOURCE_DIR "/resources/scenes/xl330.json";
    job.recordings = {recordings + "made_kp200_sines.csv", recordings + "made_kp400_slow.csv"};
    job.heldOut = {recordings + "made_kp200_chirp.csv"};
    job.out = folder_.filePath("report");
    QString report;
    QObject::connect(&window_->gapPage().process(), &AnalysisProcess::finished, window_.get(),
                     [&](const QString& found) { report = found; });
    part("a gap analysis beside the window, all processors", [&] {
      window_->gapPage().process().start(job);
      for (int second = 0; second < 300 && report.isEmpty() && window_->gapPage().process().isRunning(); ++second)
        turn(1);
    });
    if (report.isEmpty()) return;
    part("its report opened", [&] {
      window_->openReport(report);
      settle();
      turn(0.5);
    });
  }

  const double seconds_;
  QTemporaryDir folder_;
  Theme theme_;
  const QString copy_;
  std::shared_ptr<const PluginHost> host_ = std::make_shared<const PluginHost>(PLUGIN_DIR);
  WindowOptions windowOptions_;
  bench::Heartbeat heart_;
  std::unique_ptr<bench::FreezeWitness> witness_;
  std::unique_ptr<MainWindow> window_;
};

}  // namespace

int main(int count, char** arguments) {
  QApplication application(count, arguments);
  Options options;
  const QStringList words = application.arguments();
  for (qsizetype k = 1; k < words.size(); ++k) {
    if (words[k] == "--seconds" && k + 1 < words.size())
      options.seconds = words[++k].toDouble();
    else if (words[k] == "--stacks" && k + 1 < words.size())
      options.stacks_ms = words[++k].toDouble();
    else if (words[k] == "--pictures")
      options.pictures = true;
    else
      options.database = words[k];
  }
  if (options.database.isEmpty()) {
    std::fprintf(stderr, "bench_window DATABASE [--seconds S] [--stacks MS] [--pictures]\n");
    return 2;
  }
  try {
    Bench bench(options, application);
    options.pictures ? bench.pictures() : bench.all();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
